//! How short, or how far, a maneuver can be.

use serde_json::{Value, json};

use crate::program::{Run, files_in, folder_with, righting, small_detumble, small_slew};
use righting_test_support::json_schema::violation;

fn reach(folder: &std::path::Path, more: &[&str]) -> Run {
    righting(folder, &[&["reach", "scenario.json"], more].concat())
}

#[test]
fn the_shortest_duration_is_told_with_all_that_was_tried() {
    let folder = folder_with(&small_slew());
    let run = reach(folder.path(), &["--resolution", "5", "--step-by-step", "--out", "out"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.starts_with("20 s succeeds\n15 s succeeds\n"), "{}", run.stderr);
    assert!(run.stderr.contains(" s fails: "), "{}", run.stderr);
    assert_eq!(files_in(&folder.path().join("out")), ["plan", "reach.json", "reach.svg"]);
    let written = std::fs::read_to_string(folder.path().join("out/reach.json")).expect("written");
    let found: Value = serde_json::from_str(&written).expect("JSON");
    assert_eq!(found["schema"], "righting.reach/1");
    let [pass, fail] = ["first_succeeding", "last_failing"]
        .map(|end| found["bracket"][end].as_f64().expect("a duration"));
    assert_eq!(found["smallest_duration_s"], pass);
    assert_eq!(found.get("largest_angle_deg"), None);
    assert!(fail < pass && pass - fail <= 0.05 * pass, "{fail} {pass}");
    let answer = format!("shortest duration {pass} s; {fail} s fails");
    assert!(run.stdout.contains(&answer), "no \"{answer}\" in {}", run.stdout);
    for tried in found["tries"].as_array().expect("tries") {
        let duration = tried["duration_s"].as_f64().expect("a duration");
        assert_eq!(tried["succeeded"], duration >= pass, "{tried}");
    }

    let schema = righting(folder.path(), &["schema", "reach"]).json();
    assert_eq!(violation(&schema, &found), None);

    // The plan at the edge is an ordinary result, of the scenario with that duration.
    let plan = righting(folder.path(), &["verify", "out/plan", "--json"]);
    assert_eq!(plan.code, 0, "{}", plan.stderr);
    let solution = std::fs::read_to_string(folder.path().join("out/plan/solution.json"));
    let solution: Value = serde_json::from_str(&solution.expect("written")).expect("JSON");
    assert_eq!(solution["scenario"]["horizon"]["duration_s"], pass);

    let again = reach(folder.path(), &["--resolution", "5", "--step-by-step", "--json"]);
    assert_eq!(again.json(), found);

    // One plan that chooses its duration says where to look, and the answer is the same.
    let fastest = reach(folder.path(), &["--resolution", "5", "--json"]).json();
    assert_eq!(violation(&schema, &fastest), None);
    let edge = fastest["smallest_duration_s"].as_f64().expect("a duration");
    assert!((edge / pass - 1.0).abs() < 0.1, "{edge} {pass}");
    let tries = |found: &Value| found["tries"].as_array().map_or(0, Vec::len);
    assert_eq!(fastest["tries"][0]["start"], "fastest");
    assert!(tries(&fastest) < tries(&found), "{fastest}");
}

#[test]
fn the_largest_angle_and_a_detumble_s_time_have_answers_too() {
    let folder = folder_with(&small_slew());
    let run = reach(folder.path(), &["--what", "angle", "--resolution", "5", "--json"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let found = run.json();
    assert!(found["largest_angle_deg"].as_f64().is_some_and(|angle| angle > 2.0), "{found}");
    assert_eq!(found.get("smallest_duration_s"), None);

    let folder = folder_with(&small_detumble());
    let run = reach(folder.path(), &["--resolution", "10", "--within", "5"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stdout.contains("above bound"), "{}", run.stdout);
    reach(folder.path(), &["--what", "angle"]).assert_refused("no angle to vary");
    let folder = folder_with(&small_slew());
    reach(folder.path(), &["--within", "5"]).assert_refused("--within: only a detumble");
}

#[test]
fn what_nothing_makes_possible_is_said() {
    let mut hopeless = small_slew();
    hopeless["solver"] = json!({ "max_iterations": 1, "guess": "constant" });
    let folder = folder_with(&hopeless);
    let run = reach(folder.path(), &["--json"]);
    assert_eq!(run.code, 3, "{}", run.stderr);
    let last = "error: no acceptable plan: not even in 320 s\n";
    assert!(run.stderr.contains(last), "{}", run.stderr);
    assert_eq!(run.json()["smallest_duration_s"], Value::Null);
    assert_eq!(run.json()["bracket"]["last_failing"], 320.0);
}

#[test]
fn options_are_checked() {
    let folder = folder_with(&small_slew());
    for (arguments, part) in [
        (&["--resolution", "0"][..], ": expected a number from 0.01 to 50\n"),
        (&["--within", "nan"], ": expected a number from 0 to 1000\n"),
        (&["--starts", "1001"], "0..=1000"),
        (&["--what", "mass"], "duration, angle"),
        (&["--control-weight", "-1"], "weights.control: found -1, expected a number from 0"),
    ] {
        let run = reach(folder.path(), arguments);
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.stderr.contains(part), "{arguments:?}: {}", run.stderr);
    }
}

#[test]
#[cfg(unix)]
fn an_interrupted_search_prints_what_it_knows() {
    use std::io::{BufRead, BufReader};
    use std::process::Stdio;

    use crate::program::command;

    let mut long = small_slew();
    long["horizon"]["steps"] = json!(4000);
    long["weights"] = json!({ "control": 1e-4 });
    let folder = folder_with(&long);
    let mut child = command(folder.path())
        .args(["reach", "scenario.json", "--resolution", "0.01", "--step-by-step", "--out", "out"])
        .arg("--json")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stderr = BufReader::new(child.stderr.take().expect("piped"));
    let mut first = String::new();
    stderr.read_line(&mut first).expect("readable");
    assert_eq!(first, "20 s succeeds\n");
    let pid = rustix::process::Pid::from_child(&child);
    rustix::process::kill_process(pid, rustix::process::Signal::INT).expect("it is running");
    let run = Run::from(child.wait_with_output().expect("it ends"));
    assert_eq!(run.code, 130);
    let found = run.json();
    assert_eq!(found["interrupted"], true);
    assert_eq!(found["tries"][0]["duration_s"], 20.0);
    assert!(found["smallest_duration_s"].as_f64().is_some_and(|duration| duration <= 20.0));
    let last = stderr.lines().last().expect("more lines").expect("readable");
    assert_eq!(last, "error: interrupted");
}
