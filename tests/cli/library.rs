//! A folder of solved maneuvers as a source of starts.

use serde_json::{Value, json};

use crate::program::{Run, files_in, folder_with, righting, small_detumble, small_slew};

fn solve(folder: &std::path::Path, scenario: &Value, more: &[&str]) -> Run {
    std::fs::write(folder.join("scenario.json"), scenario.to_string()).expect("writable");
    righting(folder, &[&["solve", "scenario.json", "--json"], more].concat())
}

fn turned_by(angle_deg: f64) -> Value {
    let mut scenario = small_slew();
    scenario["maneuver"]["angle_deg"] = json!(angle_deg);
    scenario
}

fn notes(run: &Run) -> String {
    run.json()["notes"].to_string()
}

#[test]
fn the_nearest_maneuver_is_a_start_and_the_rest_is_named() {
    let folder = folder_with(&json!({}));
    let at = folder.path();
    let library = ["--library", "library"];
    // Each plan joins the library by its folder; the first one finds none and makes it.
    let empty = "library library is empty: a plan joins it by --out library/NAME";
    for (angle_deg, note) in [(2.0, empty), (4.0, "maneuver 2_deg was a start too")] {
        let out = format!("library/{angle_deg}_deg");
        let run = solve(at, &turned_by(angle_deg), &[&library[..], &["--out", &out]].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
        assert!(notes(&run).contains(note), "{}", notes(&run));
    }
    std::fs::create_dir(at.join("library/half")).expect("writable");
    let mut other = turned_by(3.0);
    other["system"]["links"][1]["a_m"] = json!(1.1);
    assert_eq!(solve(at, &other, &["--out", "library/other"]).code, 0);

    let cold = solve(at, &turned_by(3.8), &["--out", "cold"]);
    let warm = solve(at, &turned_by(3.8), &[&library[..], &["--out", "warm"]].concat());
    assert_eq!((cold.code, warm.code), (0, 0), "{}", warm.stderr);
    assert!(notes(&warm).contains("library maneuver 4_deg was a start too"), "{}", notes(&warm));
    let objective = |run: &Run| run.json()["objective"].as_f64().expect("a number");
    assert!(objective(&warm) <= objective(&cold) * (1.0 + 1e-6));
    let warnings: Vec<&str> = warm.stderr.lines().collect();
    assert_eq!(
        warnings,
        [
            "warning: library: skipped half: solution.json: cannot be read: no such file",
            "warning: library: skipped other: is of another arm",
        ]
    );

    let run = solve(at, &small_detumble(), &[&library[..], &["--out", "spin"]].concat());
    assert!(notes(&run).contains("holds no maneuver of this type"), "{}", notes(&run));
}

#[test]
fn a_library_is_a_folder_and_the_only_source() {
    let folder = folder_with(&json!({}));
    let run = |more: &[&str]| solve(folder.path(), &small_slew(), more);
    std::fs::write(folder.path().join("taken"), "").expect("writable");
    let refused = run(&["--out", "out", "--library", "taken/below"]);
    refused.assert_refused("taken/below: cannot be written: not a directory");
    assert!(!folder.path().join("out").exists());
    // One that is outside the plans is made too, and stays empty.
    let made = run(&["--out", "out", "--library", "deep/er"]);
    assert!(notes(&made).contains("library deep/er is empty"), "{}", notes(&made));
    assert_eq!(files_in(&folder.path().join("deep/er")), [""; 0]);
    let both = run(&["--out", "out", "--library", ".", "--warm-start", "."]);
    assert_eq!(both.code, 2);
    assert!(both.stderr.contains("cannot be used with"), "{}", both.stderr);
}
