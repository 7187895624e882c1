//! What an arm can do at all, and maneuvers that no motion makes.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::program::{Run, files_in, folder_with, righting, small_detumble, small_slew, solve};
use righting_test_support::json_schema::violation;

/// The small slew by an arm with two parallel joints in the base's plane of symmetry.
fn planar() -> Value {
    let mut scenario = small_slew();
    scenario["system"]["name"] = json!("planar");
    scenario["system"]["mount"]["position_m"] = json!([0.25, 0.0, 0.0]);
    for link in scenario["system"]["links"].as_array_mut().expect("links") {
        link["mass_kg"] = json!(10.0);
        link["a_m"] = json!(1.0);
        link["alpha_deg"] = json!(0.0);
        link["theta_deg"] = json!(0.0);
        link["body_exempt"] = json!(false);
    }
    scenario["system"]["base"]["keep_out_radius_m"] = json!(0.2);
    let tilt = 62.0_f64.to_radians();
    scenario["maneuver"]["axis"] = json!([tilt.sin(), 0.0, tilt.cos()]);
    scenario
}

fn explain(folder: &Path, more: &[&str]) -> Run {
    righting(folder, &[&["explain", "scenario.json"], more].concat())
}

const PARALLEL: &str = "this arm's joints are parallel: it turns the base about [0, 0, 1] only";

#[test]
fn an_arm_with_parallel_joints_is_explained() {
    let folder = folder_with(&planar());
    let run = explain(folder.path(), &["--out", "out"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for sentence in [
        "planar: 2 joints\n",
        "This arm's joints are parallel: it turns the base about [0, 0, 1] only.\n",
        "(root mean square) about [0, 0, 1].\n",
        "small: slew of 2\u{b0} about [0.883, 0, 0.469] in 20 s\n",
        "Impossible: this arm's joints are parallel: it turns the base about [0, 0, 1] only; the axis asked \
         is 62.0\u{b0} from it.\n",
        "out/explain.json\n",
    ] {
        assert!(run.stdout.contains(sentence), "no \"{sentence}\" in {}", run.stdout);
    }
    assert_eq!(files_in(&folder.path().join("out")), ["explain.json", "explain.svg"]);

    let found = explain(folder.path(), &["--json"]).json();
    let written = fs::read_to_string(folder.path().join("out/explain.json")).expect("written");
    assert_eq!(serde_json::from_str::<Value>(&written).expect("JSON"), found);
    let schema = righting(folder.path(), &["schema", "explain"]).json();
    assert_eq!(violation(&schema, &found), None);
    assert_eq!(found["schema"], "righting.explain/1");
    assert_eq!((&found["rank"], &found["only_axis"]), (&json!(1), &json!([0.0, 0.0, 1.0])));
    let maneuver = &found["maneuver"];
    assert_eq!(maneuver["possible"], false);
    assert_eq!(maneuver["possible_axes"], json!([[0.0, 0.0, 1.0]]));
    assert!((maneuver["off_axis_deg"].as_f64().expect("an angle") - 62.0).abs() < 1e-9);
    assert_eq!(maneuver.get("estimated_s"), None);
}

#[test]
fn a_system_a_scenario_and_a_plan_s_folder_are_explained_alike() {
    let folder = folder_with(&small_slew());
    let at = folder.path();
    let scenario = explain(at, &["--json"]).json();
    assert_eq!(scenario["rank"], 3);
    assert_eq!(scenario["maneuver"]["possible"], true);
    let estimated = scenario["maneuver"]["estimated_s"].as_f64().expect("an estimate");
    let least = scenario["maneuver"]["least_s"].as_f64().expect("a bound");
    assert!(0.0 < least && least < estimated, "{least} {estimated}");

    assert_eq!(solve(at).code, 0);
    assert_eq!(righting(at, &["explain", "out", "--json"]).json(), scenario);

    fs::write(at.join("system.json"), small_slew()["system"].to_string()).expect("writable");
    let system = righting(at, &["explain", "system.json", "--json"]).json();
    assert_eq!(system["singular_values"], scenario["singular_values"]);
    assert_eq!((system.get("maneuver"), system.get("scenario")), (None, None));

    righting(at, &["explain", "absent.json"]).assert_refused("no such file");
    fs::create_dir(at.join("empty")).expect("a folder");
    righting(at, &["explain", "empty"]).assert_refused("solution.json");
    let message = "found a solution file, expected a system or scenario file";
    righting(at, &["explain", "out/solution.json"]).assert_refused(message);
}

#[test]
fn a_detumble_is_explained_by_what_stopping_the_arm_leaves() {
    let folder = folder_with(&small_detumble());
    let found = explain(folder.path(), &["--json"]).json();
    let [stopped, bound] = ["stopped_deg_s", "bound_deg_s"]
        .map(|field| found["maneuver"][field].as_f64().expect("a rate"));
    assert!((stopped - 5.0).abs() < 1e-9 && bound < stopped, "{stopped} {bound}");
    assert!(explain(folder.path(), &[]).stdout.contains("Stopping the arm leaves 5 \u{b0}/s."));
    assert_eq!(solve(folder.path()).code, 0);
    let solution = fs::read_to_string(folder.path().join("out/solution.json")).expect("written");
    let solution: Value = serde_json::from_str(&solution).expect("JSON");
    assert_eq!(solution["stopped_deg_s"], stopped);
}

#[test]
fn an_impossible_slew_ends_before_the_search() {
    let folder = folder_with(&small_slew());
    let at = folder.path();
    assert_eq!(solve(at).code, 0);
    fs::write(at.join("scenario.json"), planar().to_string()).expect("writable");
    let message = format!("error: impossible: {PARALLEL}; the axis asked is 62.0\u{b0} from it\n");
    let hint = "  hint: `righting explain` says what this arm can do\n";
    let run = solve(at);
    assert_eq!((run.code, run.stderr), (3, format!("{message}{hint}")));
    // The plan of the other scenario does not stay in its place.
    assert_eq!(files_in(&at.join("out")), [""; 0]);
    for what in ["duration", "angle"] {
        let run = righting(at, &["reach", "scenario.json", "--what", what]);
        assert_eq!(run.code, 3);
        assert!(run.stderr.ends_with(&format!("{message}{hint}")), "{}", run.stderr);
    }
    let run = righting(at, &["solve", "scenario.json", "--out", "out", "--json"]);
    assert_eq!(run.json()["exit_code"], 3);
    assert!(run.json()["error"].as_str().is_some_and(|error| error.contains(PARALLEL)));
    assert_eq!(explain(at, &[]).code, 0, "what the hint names works");

    let mut nothing = planar();
    nothing["maneuver"]["angle_deg"] = json!(0.0);
    fs::write(at.join("scenario.json"), nothing.to_string()).expect("writable");
    assert_eq!(solve(at).code, 0, "doing nothing is always possible");
}

#[test]
fn a_detumble_that_cannot_improve_says_so() {
    let mut straight = planar();
    straight["initial"] =
        json!({ "joint_angles_deg": [0.0, 0.0], "angular_rate_deg_s": [0.0, 0.0, 2.0] });
    straight["maneuver"] = json!({ "type": "detumble" });
    let folder = folder_with(&straight);
    let run = solve(folder.path());
    assert_eq!(run.code, 3);
    let reason = "error: impossible: the posture already has the largest inertia within reach; ";
    assert!(run.stderr.starts_with(reason), "{}", run.stderr);

    // The joints' motion carries momentum: the base turns slowly at first and cannot stay so slow.
    straight["initial"]["joint_angles_deg"] = json!([0.0, 60.0]);
    straight["initial"]["joint_rates_deg_s"] = json!([15.0, 5.0]);
    straight["horizon"] = json!({ "duration_s": 30.0, "steps": 120 });
    fs::write(folder.path().join("scenario.json"), straight.to_string()).expect("writable");
    let run = righting(folder.path(), &["solve", "scenario.json", "--out", "out", "--json"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let solution = run.json();
    let left = solution["terminal"]["angular_rate_deg_s"].as_f64().expect("a rate");
    let stopped = solution["stopped_deg_s"].as_f64().expect("a rate");
    let reduction = solution["reduction_percent"].as_f64().expect("a share");
    assert!(2.0 < left && left < stopped, "{left} {stopped}");
    assert!((reduction - 100.0 * (1.0 - left / stopped)).abs() < 1e-9);
}

#[test]
fn a_sweep_names_what_is_impossible_as_a_cause() {
    let folder = folder_with(&planar());
    let axes = json!([[1, 0, 0], [1, 0, 1], [0, 0, 1]]);
    let vary = json!([{ "field": "maneuver.axis", "values": axes }]);
    let sweep = json!({ "name": "axes", "scenario": "scenario.json", "vary": vary });
    fs::write(folder.path().join("sweep.json"), sweep.to_string()).expect("writable");
    let run = righting(folder.path(), &["sweep", "sweep.json", "--out", "out", "--json"]);
    let summary = run.json();
    assert_eq!(summary["statuses"]["impossible"], 2, "{summary}");
    assert_eq!(summary["failures"][0]["cause"], format!("impossible: {PARALLEL}"));
    assert_eq!(summary["failures"][0]["count"], 2);
    assert_eq!(summary["succeeded"], 1, "{summary}");
}
