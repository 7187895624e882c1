//! A result folder is checked as a whole: trajectory, scenario and what the solution claims.

use std::fs;
use std::path::Path;

use righting_results::solution::solution_schema;
use righting_results::{SOLUTION_FILE, Solution, TRAJECTORY_FILE};
use righting_scenario::Error;
use righting_test_support::json_schema::violation;
use righting_test_support::{shipped, solution_of, true_slew, varied};
use righting_verifier::verify_directory;
use serde_json::{Value, json};
use tempfile::TempDir;

/// A folder as a solve writes it.
fn folder() -> TempDir {
    let coarse = varied(&shipped("slew_4dof"), |file| file.horizon.steps = 60.0);
    let (scenario, trajectory) = true_slew(&coarse);
    let solution = solution_of(&scenario, &trajectory);
    let folder = tempfile::tempdir().unwrap();
    solution.write_json(&folder.path().join(SOLUTION_FILE)).unwrap();
    trajectory
        .write_csv(&scenario.system().model.joint_kinds(), &folder.path().join(TRAJECTORY_FILE))
        .unwrap();
    folder
}

fn failures(folder: &Path) -> Vec<String> {
    let verification = verify_directory(folder).unwrap().solution.verification;
    assert_eq!(verification.passed, verification.failures().count() == 0);
    verification.failures().map(|check| check.name.clone()).collect()
}

/// Changes a value of `solution.json`.
fn edit(folder: &Path, pointer: &str, value: Value) {
    let file = folder.join(SOLUTION_FILE);
    let mut solution: Value = serde_json::from_str(&fs::read_to_string(&file).unwrap()).unwrap();
    *solution.pointer_mut(pointer).unwrap() = value;
    fs::write(file, solution.to_string()).unwrap();
}

#[test]
fn an_honest_folder_passes() {
    let folder = folder();
    let verified = verify_directory(folder.path()).unwrap();
    let now = &verified.solution.verification;
    assert!(now.passed, "{:?}", failures(folder.path()));
    assert_eq!(verified.scenario.name(), "slew_4dof");
    // What was found when it was solved is found again: the files lose no bit.
    let then = Solution::read_json(&folder.path().join(SOLUTION_FILE)).unwrap().verification;
    assert_eq!(now.checks[..then.checks.len()], then.checks);
    assert_eq!(now.attitude_mismatch, then.attitude_mismatch);
    assert!(verified.solution.constraint_violation.is_nan(), "not a number is null and back");
    let text = fs::read_to_string(folder.path().join(SOLUTION_FILE)).unwrap();
    let mut written: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(violation(&solution_schema(), &written), None);
    written["verification"]["checks"][0]["limit"] = json!("wide");
    assert!(violation(&solution_schema(), &written).is_some());
}

#[test]
fn what_the_solution_claims_is_checked() {
    for (pointer, value, name) in [
        ("/scenario_sha256", json!("0".repeat(64)), "scenario changed since it was solved"),
        ("/scenario/solver/tolerance", json!(1e-7), "scenario changed since it was solved"),
        ("/objective", json!(1e-6), "objective mismatch"),
        ("/objective", Value::Null, "objective mismatch"),
        ("/terminal/attitude_error", json!(1e-5), "terminal mismatch"),
        ("/terminal/joint_rate_deg_s", json!(0.5), "terminal mismatch"),
    ] {
        let folder = folder();
        edit(folder.path(), pointer, value);
        assert_eq!(failures(folder.path()), [name], "{pointer}");
    }
    let folder = folder();
    edit(folder.path(), "/scenario/maneuver/angle_deg", json!(20.0));
    let names = failures(folder.path());
    assert!(names.contains(&"attitude error at the end".to_owned()), "{names:?}");
    assert!(names.contains(&"scenario changed since it was solved".to_owned()), "{names:?}");
}

#[test]
fn a_tampered_table_is_caught() {
    let folder = folder();
    let file = folder.path().join(TRAJECTORY_FILE);
    let text = fs::read_to_string(&file).unwrap();
    let mut rows: Vec<String> = text.lines().map(str::to_owned).collect();
    let column = rows[0].split(',').position(|name| name == "q2_rad").unwrap();
    let mut cells: Vec<String> = rows[30].split(',').map(str::to_owned).collect();
    cells[column] = (cells[column].parse::<f64>().unwrap() + 1e-5).to_string();
    rows[30] = cells.join(",");
    fs::write(&file, rows.join("\n")).unwrap();
    assert!(failures(folder.path()).contains(&"joint angle mismatch".to_owned()));
}

#[test]
fn a_folder_that_cannot_be_read_is_an_error_that_says_where() {
    let complaint = |folder: &Path| verify_directory(folder).unwrap_err().to_string();
    let empty = tempfile::tempdir().unwrap();
    assert!(complaint(empty.path()).ends_with("solution.json: cannot be read: no such file"));

    for (pointer, value, place) in [
        (
            "/schema",
            json!("righting.solution/2"),
            "schema: found \"righting.solution/2\", expected",
        ),
        ("/status", json!("done"), "status: found \"done\", expected \"solved\", \"acceptable\","),
        ("/iterations", json!(-1), "iterations: found -1, expected a whole number"),
        ("/terminal/attitude_error", json!("0"), "terminal.attitude_error: found \"0\", expected"),
        ("/scenario/horizon/steps", json!(0), "scenario.horizon.steps: found 0, expected"),
        (
            "/scenario/system/links/2/mass_kg",
            json!(-1),
            "scenario.system.links[2].mass_kg: found -1, expected",
        ),
    ] {
        let folder = folder();
        edit(folder.path(), pointer, value);
        let message = complaint(folder.path());
        let file = folder.path().join(SOLUTION_FILE);
        let about = message.strip_prefix(&format!("{}: ", file.display())).unwrap();
        assert!(about.starts_with(place), "{message}");
    }

    let folder = folder();
    fs::remove_file(folder.path().join(TRAJECTORY_FILE)).unwrap();
    assert!(matches!(verify_directory(folder.path()), Err(Error::Read { .. })));
}
