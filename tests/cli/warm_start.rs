//! An earlier plan as a start.

use serde_json::{Value, json};

use crate::program::{Run, folder_with, righting, small_slew, solve};

/// Solves another scenario from the plan in `out`.
fn solve_from_earlier(folder: &std::path::Path, scenario: &Value) -> Run {
    std::fs::write(folder.join("next.json"), scenario.to_string()).expect("writable");
    let line = ["solve", "next.json", "--out", "next", "--warm-start", "out", "--json"];
    righting(folder, &line)
}

fn planned() -> tempfile::TempDir {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    folder
}

#[test]
fn an_earlier_plan_of_the_same_arm_is_a_start() {
    let folder = planned();
    let mut next = small_slew();
    next["maneuver"]["angle_deg"] = json!(2.5);
    next["system"]["links"][1]["mass_kg"] = json!(24.0);
    let run = solve_from_earlier(folder.path(), &next);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(run.json()["notes"], Value::Null);
    // A motion without the plan's other files does.
    std::fs::remove_file(folder.path().join("out/solution.json")).expect("there");
    let run = solve_from_earlier(folder.path(), &next);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
}

#[test]
fn an_arm_with_more_joints_is_bad_input() {
    let folder = planned();
    let mut next = small_slew();
    let mut link = next["system"]["links"][1].clone();
    link["body_exempt"] = json!(false);
    next["system"]["links"].as_array_mut().expect("an array").push(link);
    next["initial"]["joint_angles_deg"] = json!([0, 30, 0]);
    let run = solve_from_earlier(folder.path(), &next);
    let message = "out: found a plan of 2 joints, expected 3";
    assert_eq!(
        (run.code, run.stderr),
        (
            2,
            format!(
                "error: {message}\n  hint: a warm start is an earlier plan of the scenario's arm\n"
            )
        )
    );
    assert_eq!(run.stdout, format!("{{\n  \"error\": \"{message}\",\n  \"exit_code\": 2\n}}\n"));
    assert!(!folder.path().join("next").exists());
}

#[test]
fn another_arm_with_as_many_joints_is_noted() {
    let folder = planned();
    let mut next = small_slew();
    next["system"]["links"][1]["a_m"] = json!(1.1);
    let run = solve_from_earlier(folder.path(), &next);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let note = "the warm start out is of another arm: its Denavit-Hartenberg rows or its mount \
                differ";
    assert_eq!(run.json()["notes"], json!([note]));
}

#[test]
fn what_cannot_be_read_of_an_earlier_plan_is_said() {
    let folder = planned();
    let out = folder.path().join("out");
    std::fs::write(out.join("solution.json"), "{}").expect("writable");
    let run = solve_from_earlier(folder.path(), &small_slew());
    let warning = "warning: the arm of the warm start is unknown: out/solution.json: schema: \
                   missing: it has no default\n";
    assert_eq!((run.code, run.stderr.as_str()), (0, warning));
    std::fs::remove_file(out.join("trajectory.csv")).expect("there");
    let run = solve_from_earlier(folder.path(), &small_slew());
    assert_eq!(
        (run.code, run.stderr.as_str()),
        (2, "error: out/trajectory.csv: cannot be read: no such file\n")
    );
}
