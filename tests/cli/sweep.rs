//! Sweeps: what is recorded, whatever happens on the way.

use std::path::Path;

use righting_sweep::Sweep;
use serde_json::{Value, json};

use crate::program::{Run, files_in, righting, root, small_slew};

/// A cheap sweep of `count` angles about two axes.
pub fn small_sweep(count: usize) -> Value {
    let mut scenario = small_slew();
    scenario["solver"] = json!({ "guess": "constant" });
    json!({
        "name": "small",
        "scenario": scenario,
        "vary": [
            { "field": "maneuver.axis", "values": [[1, 0, 0], [0, 1, 0]] },
            { "field": "maneuver.angle_deg", "name": "angle", "grid": { "from": 1, "to": 5, "count": count } }
        ]
    })
}

pub fn folder_with_sweep(sweep: &Value) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("sweep.json"), sweep.to_string()).expect("writable");
    folder
}

/// Runs the sweep of a folder into `out` beneath it.
pub fn sweep(folder: &Path, out: &str, more: &[&str]) -> Run {
    righting(folder, &[&["sweep", "sweep.json", "--out", out], more].concat())
}

/// The table without its last two columns, which say how it was computed.
pub fn results(folder: &Path, out: &str) -> Vec<String> {
    let path = folder.join(out).join("results.csv");
    let text = std::fs::read_to_string(path).expect("a table");
    let result = |line: &str| line.rsplitn(3, ',').last().expect("columns").to_owned();
    text.lines().map(result).collect()
}

#[test]
fn every_case_is_planned_verified_recorded_and_summed_up() {
    let folder = folder_with_sweep(&small_sweep(3));
    let run = sweep(folder.path(), "out", &["--jobs", "2", "--json"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let summary = run.json();
    for field in ["cases", "recorded", "succeeded"] {
        assert_eq!(summary[field], 6, "{field}");
    }
    assert_eq!(summary["statuses"], json!({ "solved": 6 }));
    assert!(summary["attitude_error"]["max"].as_f64().is_some_and(|error| error <= 1e-3));
    let files = files_in(&folder.path().join("out"));
    let expected = [
        "records",
        "results.csv",
        "slew_limits.csv",
        "slews.html",
        "slews.svg",
        "summary.json",
        "sweep.json",
    ];
    assert_eq!(files, expected);
    let limits = std::fs::read_to_string(folder.path().join("out/slew_limits.csv"))
        .expect("how far slews go");
    assert_eq!(
        limits,
        "maneuver.axis_x,maneuver.axis_y,maneuver.axis_z,tried,succeeded,max_angle_deg,all_up_to_deg\n\
         1,0,0,3,3,5,5\n0,1,0,3,3,5,5\n"
    );
    let table = results(folder.path(), "out");
    assert_eq!(
        table[0],
        "case_id,maneuver.axis_x,maneuver.axis_y,maneuver.axis_z,angle,status,verified,\
         attitude_error,final_rate_deg_s,joint_rate_deg_s,objective,iterations,reason"
    );
    assert_eq!(table.len(), 1 + 6);
    assert!(table[6].contains(",0,1,0,5,solved,true,"), "{}", table[6]);

    let shown = righting(folder.path(), &["sweep", "show", "out"]);
    assert_eq!(shown.code, 0);
    assert!(shown.stdout.contains("6 of 6 cases recorded"), "{}", shown.stdout);
}

#[test]
fn the_results_do_not_depend_on_the_number_of_workers_or_shards() {
    let folder = folder_with_sweep(&small_sweep(4));
    assert_eq!(sweep(folder.path(), "one", &["--jobs", "1"]).code, 0);
    assert_eq!(sweep(folder.path(), "three", &["--jobs", "3"]).code, 0);
    let planned = righting(folder.path(), &["sweep", "plan", "sweep.json", "--out", "shards"]);
    assert_eq!(planned.code, 0, "{}", planned.stderr);
    for shard in ["3/3", "1/3", "2/3", "1/3"] {
        let run = ["sweep", "run", "shards", "--shard", shard, "--jobs", "1"];
        assert_eq!(righting(folder.path(), &run).code, 0);
    }
    let merged = righting(folder.path(), &["sweep", "merge", "shards", "--json"]);
    // A shard that is run again does nothing.
    assert_eq!(merged.json()["recorded"], 8);
    let one = results(folder.path(), "one");
    assert_eq!(one.len(), 1 + 8);
    assert_eq!(results(folder.path(), "three"), one);
    assert_eq!(results(folder.path(), "shards"), one);
}

#[test]
fn records_are_gone_on_with_only_when_asked() {
    let folder = folder_with_sweep(&small_sweep(2));
    assert_eq!(sweep(folder.path(), "out", &[]).code, 0);
    let run = sweep(folder.path(), "out", &[]);
    run.assert_refused("4 records of an earlier run");
    assert!(run.stderr.contains("--resume"), "{}", run.stderr);
    // The sweep grows: what it has stays.
    std::fs::write(folder.path().join("sweep.json"), small_sweep(3).to_string()).expect("writable");
    let run = sweep(folder.path(), "out", &["--resume"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, "4 cases are recorded already, 2 to go\n"));
    assert_eq!(results(folder.path(), "out").len(), 1 + 6);
}

#[test]
fn arms_are_compared_in_one_sweep_by_their_names() {
    let study = root().join("scenarios/sweeps/three_arms.json");
    let mut study: Value =
        serde_json::from_str(&std::fs::read_to_string(study).expect("shipped")).expect("JSON");
    study["scenario"]["horizon"] = json!({ "duration_s": 60, "steps": 60 });
    study["vary"] = json!([study["vary"][0], { "field": "maneuver.angle_deg", "values": [20] }]);
    let folder = folder_with_sweep(&study);
    std::os::unix::fs::symlink(root().join("scenarios"), folder.path().join("scenarios"))
        .expect("a link");
    let text = study.to_string().replace("../systems", "scenarios/systems");
    std::fs::write(folder.path().join("sweep.json"), text).expect("writable");
    let run = sweep(folder.path(), "out", &["--json"]);
    assert_eq!((run.code, run.json()["succeeded"].as_u64()), (0, Some(3)), "{}", run.stderr);
    let table = results(folder.path(), "out");
    for (row, arm) in table[1..].iter().zip(["single_link_2dof", "xlink_4dof", "canadarm2"]) {
        assert!(
            row.contains(&format!(",{arm},\"[0,0")) && row.contains(",20,solved,true,"),
            "{row}"
        );
    }
    // Another machine needs nothing but the folder of the sweep.
    std::fs::remove_file(folder.path().join("scenarios")).expect("removable");
    let merged = righting(folder.path(), &["sweep", "merge", "out", "--json"]);
    assert_eq!(merged.json()["recorded"], 3, "{}", merged.stderr);
}

#[test]
fn cases_that_fail_are_results_grouped_by_cause() {
    let mut failing = small_sweep(2);
    failing["vary"] = json!([{ "zip": [
        { "field": "solver.max_iterations", "values": [1, 100, 101] },
        { "field": "system.base.mass_kg", "values": [300, -1, 301] }
    ] }]);
    let folder = folder_with_sweep(&failing);
    let run = sweep(folder.path(), "out", &["--json"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let summary = run.json();
    assert_eq!(summary["succeeded"], 1);
    let mut causes: Vec<&str> = summary["failures"]
        .as_array()
        .expect("groups")
        .iter()
        .map(|group| group["cause"].as_str().expect("a cause"))
        .collect();
    causes.sort_unstable();
    assert_eq!(causes, ["iteration_limit", "refused: system.base.mass_kg"]);
    let shown = righting(folder.path(), &["sweep", "show", "out"]).stdout;
    assert!(shown.contains("found -1, expected"), "{shown}");
}

#[test]
fn a_plan_flown_open_loop_ends_elsewhere_when_the_masses_differ() {
    let mut flown = small_sweep(2);
    flown["evaluation"] = json!("open_loop");
    flown["scenario"]["weights"] = json!({ "control": 0.001 });
    flown["vary"] = json!([{ "field": "system.links[1].mass_kg", "name": "factor",
                             "relative": true, "values": [0.8, 1, 1.25] }]);
    let folder = folder_with_sweep(&flown);
    assert_eq!(sweep(folder.path(), "out", &[]).code, 0);
    let table = results(folder.path(), "out");
    let cells: Vec<Vec<&str>> = table[1..].iter().map(|row| row.split(',').collect()).collect();
    let errors: Vec<f64> = cells.iter().map(|row| row[4].parse().expect("a number")).collect();
    assert!(cells.iter().all(|row| row[2] == "flown"), "{table:?}");
    // With the masses of the plan the flight is the plan.
    assert!(errors[1] < 1e-4 && cells[1][3] == "true", "{table:?}");
    // The base turns by less than in proportion to the arm's mass, which it also has to turn: of 2
    // degrees less than a fifth is missing, less than a quarter too much.
    let off_deg = |error: f64| 2.0 * error.asin().to_degrees();
    assert!((0.1..0.4).contains(&off_deg(errors[0])) && cells[0][3] == "false", "{table:?}");
    assert!((0.1..0.5).contains(&off_deg(errors[2])) && cells[2][3] == "false", "{table:?}");
}

#[test]
fn a_job_array_has_a_task_a_shard() {
    let folder = folder_with_sweep(&small_sweep(2));
    let plan = ["sweep", "plan", "sweep.json", "--out", "it's here"];
    assert_eq!(righting(folder.path(), &plan).code, 0);
    let slurm = ["sweep", "slurm", "it's here", "--shards", "7", "--jobs", "2", "--time", "1:00"];
    let run = righting(folder.path(), &slurm);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(run.stdout.contains("4 cases in 7 shards"), "{}", run.stdout);
    let script = folder.path().join("it's here/sweep.sbatch");
    let text = std::fs::read_to_string(&script).expect("a script");
    for part in ["#SBATCH --array=1-7\n", "--cpus-per-task=2\n", "--time=1:00\n", "signal=B:TERM"] {
        assert!(text.contains(part), "no {part} in {text}");
    }
    // A task of the array, as Slurm would start it.
    let mut task = std::process::Command::new("bash");
    task.arg(&script).env("SLURM_ARRAY_TASK_ID", "3").stdin(std::process::Stdio::null());
    assert!(task.status().expect("bash").success());
    let records = files_in(&folder.path().join("it's here/records"));
    assert_eq!(records, ["3-of-7.jsonl"]);
    let injected = ["sweep", "slurm", "it's here", "--shards", "7", "--time", "1\nrm"];
    assert_eq!(righting(folder.path(), &injected).code, 2);
}

#[test]
fn shipped_sweeps_and_the_documented_one_are_accepted() {
    let folder = root().join("scenarios/sweeps");
    let names = files_in(&folder);
    assert!(names.len() >= 4, "{names:?}");
    for name in &names {
        let sweep = Sweep::read(&folder.join(name)).expect(name);
        assert_eq!(format!("{}.json", sweep.name()), *name);
    }
    let document = std::fs::read_to_string(root().join("docs/sweeps.md")).expect("a document");
    let example = document.split("```json\n").nth(1).and_then(|rest| rest.split("```").next());
    let sweep = Sweep::parse(example.expect("an example"), &folder.join("example.json"));
    assert_eq!(sweep.expect("accepted").len(), 25 * 9 * 20);
}

#[test]
fn bad_input_is_refused_before_anything_is_made() {
    let mut wrong = small_sweep(2);
    wrong["vary"][1]["field"] = json!("maneuver.angel_deg");
    let folder = folder_with_sweep(&wrong);
    sweep(folder.path(), "out", &[]).assert_refused("error: sweep.json: vary[1]: maneuver.angel_deg of the first case: unknown field: did you mean `angle_deg`?\n  hint: `righting schema sweep` prints the format with every field\n");
    righting(folder.path(), &["sweep", "absent.json", "--out", "out"])
        .assert_refused("no such file");
    assert!(!folder.path().join("out").exists());
    for arguments in [
        &["sweep"][..],
        &["sweep", "sweep.json"],
        &["sweep", "run", "out", "--shard", "3/2"],
        &["sweep", "sweep.json", "--out", "out", "--jobs", "0"],
    ] {
        assert_eq!(righting(folder.path(), arguments).code, 2, "{arguments:?}");
    }
    let shard = righting(folder.path(), &["sweep", "run", "out", "--shard", "3/2"]);
    let expected = "error: invalid value '3/2' for '--shard <I/N>': expected i/n with i from 1 to n \
                    and n up to 1000000\n";
    assert!(shard.stderr.starts_with(expected), "{}", shard.stderr);
    for part in ["run", "merge", "show"] {
        righting(folder.path(), &["sweep", part, "nowhere"]).assert_refused("nowhere/sweep.json");
    }
}
