//! Solving: what is written, printed and returned.

use serde_json::{Value, json};

use crate::program::{files_in, folder_with, righting, small_detumble, small_slew, solve};

const ALL_FILES: [&str; 8] = [
    "attitude.svg",
    "convergence.svg",
    "joints.svg",
    "momentum.svg",
    "power.svg",
    "report.html",
    "solution.json",
    "trajectory.csv",
];

fn read_json(path: &std::path::Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).expect("readable")).expect("JSON")
}

#[test]
fn a_slew_is_planned_proven_written_and_summed_up() {
    let folder = folder_with(&small_slew());
    let run = solve(folder.path());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    assert_eq!(files_in(&folder.path().join("out")), ALL_FILES);
    for part in ["slew of 2° about [1, 0, 0] in 20 s, 40 steps", "Verified", "out/attitude.svg"] {
        assert!(run.stdout.contains(part), "no \"{part}\" in {}", run.stdout);
    }

    let solution = read_json(&folder.path().join("out/solution.json"));
    assert_eq!(solution["schema"], "righting.solution/1");
    assert_eq!(solution["status"], "solved");
    assert_eq!(solution["verification"]["passed"], true);
    assert!(solution["terminal"]["attitude_error"].as_f64().is_some_and(|error| error <= 1e-3));
    let timing = |name: &str| solution["timing_s"][name].as_f64().expect("a time");
    let parts = ["load", "trace", "guess", "solve", "verify"].map(timing);
    assert!(parts.iter().all(|&part| part >= 0.0));
    assert!(parts.iter().sum::<f64>() <= timing("total"));

    let table =
        std::fs::read_to_string(folder.path().join("out/trajectory.csv")).expect("readable");
    assert_eq!(table.lines().count(), 1 + 41);
    assert!(table.starts_with("t_s,rx_m,ry_m,rz_m,qw,qx,qy,qz,vx_m_s"));
}

#[test]
fn what_was_accepted_with_an_assumption_is_said_first() {
    let mut scenario = small_slew();
    scenario["initial"]["attitude"] = json!([0.6, 0.8001, 0.0, 0.0]);
    scenario["system"]["links"][1]["angle_max_deg"] = json!(29.9996);
    let folder = folder_with(&scenario);
    let run = righting(folder.path(), &["solve", "scenario.json", "--out", "out", "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let solution = run.json();
    let notes = [
        "system.links[1].angle_max_deg: 30 instead of 29.9996: joint 2 starts there, past its limit by \
         rounding only",
        "initial.attitude: its norm is 1.00008: taken as a unit quaternion, for rounding",
    ];
    assert_eq!(solution["notes"], json!(notes));
    // The files alone pass by the same numbers.
    assert_eq!(solution["scenario"]["system"]["links"][1]["angle_max_deg"], 30.0);
    assert_eq!(righting(folder.path(), &["verify", "out"]).code, 0);
}

#[test]
fn a_detumble_says_how_much_it_took_out_and_how_much_it_could() {
    let folder = folder_with(&small_detumble());
    let run = righting(folder.path(), &["solve", "scenario.json", "--out", "out", "--json"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let solution = run.json();
    let left = solution["terminal"]["angular_rate_deg_s"].as_f64().expect("a rate");
    let bound = solution["bound_deg_s"].as_f64().expect("a bound");
    let reduction = solution["reduction_percent"].as_f64().expect("a share");
    // The bound is that of an arm at rest; this one may still move a little.
    assert!(0.0 < bound && 0.98 * bound < left && left < 5.0, "{bound} {left}");
    assert!((reduction - 100.0 * (1.0 - left / 5.0)).abs() < 1e-6, "{reduction}");
}

#[test]
fn json_is_the_solution_with_its_files_and_nothing_else() {
    let folder = folder_with(&small_slew());
    let run = righting(folder.path(), &["solve", "scenario.json", "--out", "deep/er", "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let mut printed = run.json();
    let files = printed.as_object_mut().expect("an object").remove("files").expect("files");
    for name in ["trajectory", "solution", "attitude", "joints", "report"] {
        let path = files[name].as_str().expect("a path");
        assert!(folder.path().join(path).is_file(), "{path}");
    }
    assert_eq!(printed, read_json(&folder.path().join("deep/er/solution.json")));
}

#[test]
fn two_runs_write_the_same_trajectory() {
    let folder = folder_with(&small_slew());
    let table = || {
        assert_eq!(solve(folder.path()).code, 0);
        std::fs::read(folder.path().join("out/trajectory.csv")).expect("readable")
    };
    assert_eq!(table(), table());
}

#[test]
fn without_a_plan_there_are_no_plan_files_and_the_outcome_says_why() {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    let mut hopeless = small_slew();
    hopeless["solver"] = json!({ "max_iterations": 1, "guess": "constant" });
    std::fs::write(folder.path().join("scenario.json"), hopeless.to_string()).expect("writable");
    let run = righting(folder.path(), &["solve", "scenario.json", "--out", "out", "--json"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert!(run.stderr.starts_with("error: no acceptable plan: stopped at the iteration limit\n"));
    assert!(run.stderr.contains("hint: raise solver.max_iterations"), "{}", run.stderr);
    // The earlier plan is gone: it is not what this scenario asked for.
    assert_eq!(files_in(&folder.path().join("out")), ["solution.json"]);
    assert_eq!(run.json()["status"], "iteration_limit");
    assert_eq!(run.json()["verification"]["passed"], false);
    assert_eq!(run.json()["files"]["trajectory"], Value::Null);
}

#[test]
fn results_are_readable_by_whom_the_user_lets_read() {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let folder = folder_with(&small_slew());
        assert_eq!(solve(folder.path()).code, 0);
        let ordinary = folder.path().join("ordinary");
        std::fs::write(&ordinary, "").expect("writable");
        let mode = |path: &std::path::Path| {
            std::fs::metadata(path).expect("there").permissions().mode() & 0o777
        };
        for name in ALL_FILES {
            assert_eq!(mode(&folder.path().join("out").join(name)), mode(&ordinary), "{name}");
        }
    }
}

#[test]
fn what_is_printed_can_be_pasted_into_a_program() {
    let folder = folder_with(&small_detumble());
    let run = solve(folder.path());
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("detumble from [0, 0, -5] \u{b0}/s"), "{}", run.stdout);
    for command in ["verify", "power"] {
        let again = righting(folder.path(), &[command, "out"]);
        assert!(again.stdout.contains("[0, 0, -5]"), "{}", again.stdout);
        assert!(!again.stdout.contains('\u{2212}'), "{}", again.stdout);
    }
    assert!(!run.stdout.contains('\u{2212}'), "{}", run.stdout);
    // A figure is looked at: there the minus is as wide as the plus.
    let figure = std::fs::read_to_string(folder.path().join("out/joints.svg")).expect("readable");
    assert!(figure.contains("detumble from [0, 0, \u{2212}5]"), "{figure}");
}
