//! Checking a plan from its files alone.

use std::path::Path;

use serde_json::Value;

use crate::program::{folder_with, righting, small_slew, solve};

/// A solved slew in `out`.
fn solved() -> tempfile::TempDir {
    let folder = folder_with(&small_slew());
    assert_eq!(solve(folder.path()).code, 0);
    folder
}

/// Changes the cells of one row of the trajectory.
pub fn tamper(folder: &Path, row: usize, change: impl Fn(&[String], &mut Vec<String>)) {
    let path = folder.join("out/trajectory.csv");
    let text = std::fs::read_to_string(&path).expect("readable");
    let mut lines: Vec<Vec<String>> =
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
    let header = lines[0].clone();
    change(&header, &mut lines[row]);
    let lines: Vec<String> = lines.iter().map(|cells| cells.join(",")).collect();
    std::fs::write(path, lines.join("\n") + "\n").expect("writable");
}

fn column(header: &[String], name: &str) -> usize {
    header.iter().position(|cell| cell == name).expect("a column of the table")
}

/// Adds to a number of the row.
pub fn add(name: &'static str, amount: f64) -> impl Fn(&[String], &mut Vec<String>) {
    move |header, row| {
        let cell = &mut row[column(header, name)];
        *cell = format!("{:.16e}", cell.parse::<f64>().expect("a number") + amount);
    }
}

#[test]
fn a_plan_as_written_passes() {
    let folder = solved();
    let run = righting(folder.path(), &["verify", "out"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{}", run.stdout);
    assert!(run.stdout.contains("Verified"), "{}", run.stdout);
    let json = righting(folder.path(), &["verify", "out", "--json"]).json();
    let path = folder.path().join("out/solution.json");
    let solution: Value =
        serde_json::from_str(&std::fs::read_to_string(path).expect("readable")).expect("JSON");
    // Once more with what solution.json claims: the same findings on the trajectory.
    let (again, then) = (&json["verification"], &solution["verification"]);
    assert_eq!(again["passed"], true);
    assert_eq!(again["momentum_drift"], then["momentum_drift"]);
    let [again, then] = [again, then].map(|found| found["checks"].as_array().expect("checks"));
    assert!(again.len() > then.len());
    assert_eq!(again[..then.len()], then[..]);
}

#[test]
fn a_tampered_plan_is_caught_and_the_reason_given() {
    type Change = Box<dyn Fn(&[String], &mut Vec<String>)>;
    let changes: [(&str, usize, Change); 5] = [
        ("a joint angle", 20, Box::new(add("q2_rad", 0.01))),
        ("a control", 10, Box::new(add("u1_rad_s2", 0.01))),
        ("the attitude at the end", 41, Box::new(add("qx", 0.01))),
        ("a time", 15, Box::new(add("t_s", 0.1))),
        (
            "the order of the quaternion",
            30,
            Box::new(|header, row| row[column(header, "qw")..][..4].rotate_left(1)),
        ),
    ];
    for (what, row, change) in changes {
        let folder = solved();
        tamper(folder.path(), row, change);
        let run = righting(folder.path(), &["verify", "out"]);
        assert_eq!(run.code, 4, "{what}: {}{}", run.stdout, run.stderr);
        assert!(run.stderr.starts_with("error: the plan failed its verification: "), "{what}");
        assert!(run.stdout.contains("NOT VERIFIED"), "{what}: {}", run.stdout);
        let json = righting(folder.path(), &["verify", "out", "--json"]).json();
        assert_eq!(json["verification"]["passed"], false, "{what}");
    }
}

#[test]
fn what_is_not_a_plan_is_refused() {
    let folder = solved();
    let out = folder.path().join("out");
    righting(folder.path(), &["verify", "absent"]).assert_refused("no such file");
    righting(folder.path(), &["verify", "scenario.json"]).assert_refused("scenario.json");

    std::fs::rename(out.join("trajectory.csv"), out.join("kept")).expect("movable");
    righting(folder.path(), &["verify", "out"]).assert_refused("trajectory.csv: cannot be read");
    std::fs::create_dir(out.join("trajectory.csv")).expect("room");
    righting(folder.path(), &["verify", "out"])
        .assert_refused("out/trajectory.csv: found a directory, expected a trajectory table");
    std::fs::remove_dir(out.join("trajectory.csv")).expect("empty");
    let table = std::fs::read_to_string(out.join("kept")).expect("readable");
    let head = table.lines().next().expect("a header");
    let columns = "expected 14 columns, 4 for each joint and power_w";
    for (broken, message) in [
        ("", "line 1: found an empty file, expected a header and rows"),
        ("t_s\n", &*format!("line 1: found 1 columns, {columns}")),
        ("1,2,3\n4,5,6\n", &format!("line 1: found 3 columns, {columns}")),
        (head, "line 1: found 0 rows, expected at least 2"),
        (&table.replace("qw,qx", "qx,qw"), "line 1: found column `qx`, expected `qw`"),
        (&format!("{head}\n1,2\n3,4\n"), "line 2: found 2 cells, expected 23"),
        (
            &table.replacen("\n0.0000000000000000e0", "\nsoon", 1),
            "line 2, column t_s: found `soon`, expected a finite number",
        ),
    ] {
        std::fs::write(out.join("trajectory.csv"), broken).expect("writable");
        let run = righting(folder.path(), &["verify", "out"]);
        let message = format!("error: out/trajectory.csv: {message}\n");
        assert_eq!((run.code, run.stderr), (2, message));
    }
    std::fs::rename(out.join("kept"), out.join("trajectory.csv")).expect("movable");
    assert_eq!(righting(folder.path(), &["verify", "out"]).code, 0);

    let whole = std::fs::read_to_string(out.join("solution.json")).expect("readable");
    let later = whole.replace("righting.solution/1", "righting.solution/2");
    for (broken, message) in [
        ("", "line 1, column 0: not JSON: EOF while parsing a value"),
        ("{}", "schema: missing: it has no default"),
        ("[]", "found [], expected an object"),
        ("{\"schema\": 7}", "schema: found 7, expected a string"),
        (&later, "schema: found \"righting.solution/2\", expected \"righting.solution/1\""),
    ] {
        std::fs::write(out.join("solution.json"), broken).expect("writable");
        let run = righting(folder.path(), &["verify", "out"]);
        let line = run.stderr.lines().next().unwrap_or_default();
        assert_eq!((run.code, line), (2, &*format!("error: out/solution.json: {message}")));
    }
}
