//! Spot checks of bad input through the program; the library's tests hold the long list.

use serde_json::{Value, json};

use crate::program::{folder_with, righting, small_slew, solve};

/// Refused before anything is written.
fn assert_refused(scenario: &Value, part: &str) {
    let folder = folder_with(scenario);
    let run = solve(folder.path());
    run.assert_refused(part);
    assert_eq!(run.stdout, "");
    assert!(!folder.path().join("out").exists());
}

#[test]
fn the_message_names_the_field_and_what_is_allowed() {
    let wrong = |path: &str, value: Value| {
        let mut scenario = small_slew();
        *scenario.pointer_mut(path).expect("a field of the scenario") = value;
        scenario
    };
    for (path, value, part) in [
        ("/horizon/steps", json!(0), "horizon.steps: found 0, expected a whole number from 1"),
        ("/horizon/steps", json!(1e9), "horizon.steps: "),
        ("/horizon/steps", json!(2.5), "horizon.steps: found 2.5, expected a whole number from 1"),
        (
            "/horizon/duration_s",
            json!(-1),
            "horizon.duration_s: found -1, expected a number above 0",
        ),
        ("/horizon/duration_s", json!("long"), "horizon.duration_s: "),
        ("/maneuver/axis", json!([0, 0, 0]), "maneuver.axis: "),
        ("/maneuver/angle_deg", json!(1e308), "maneuver.angle_deg: "),
        ("/maneuver/type", json!("spin"), "maneuver.type: "),
        (
            "/system/base/mass_kg",
            json!(-300),
            "system.base.mass_kg: found -300, expected a number above 0",
        ),
        ("/system/links", json!([]), "system.links: "),
        ("/system/links/1/mass_kg", json!(null), "system.links[1].mass_kg: "),
        ("/system/links/1/angle_max_deg", json!(-91), "system.links[1].angle_m"),
        ("/initial/joint_angles_deg", json!([0, 120]), "initial.joint_angles_deg[1]: "),
        ("/initial/joint_angles_deg", json!([0]), "initial.joint_angles_deg"),
        ("/system", json!("absent.json"), "absent.json: cannot be read: no such file"),
        ("/system", json!("."), "(.: found a directory, expected a system file)"),
    ] {
        assert_refused(&wrong(path, value), part);
    }
}

#[test]
fn a_misspelt_field_is_met_with_the_right_one() {
    let mut scenario = small_slew();
    scenario["horizon"]["durations_s"] = json!(3);
    assert_refused(&scenario, "did you mean `duration_s`?");
}

#[test]
fn what_is_not_a_scenario_is_refused() {
    let folder = folder_with(&small_slew());
    let path = folder.path().join("scenario.json");
    for broken in ["", "{", "[]", "null", "{\"name\": NaN}", "\u{feff}", "{\"name\": \"a\"}"] {
        std::fs::write(&path, broken).expect("writable");
        solve(folder.path()).assert_refused("scenario.json");
    }
    std::fs::write(&path, [0xff, 0xfe, 0x00]).expect("writable");
    solve(folder.path()).assert_refused("not UTF-8");
    std::fs::remove_file(&path).expect("there");
    solve(folder.path()).assert_refused("scenario.json: cannot be read: no such file");
    std::fs::create_dir(&path).expect("room");
    solve(folder.path())
        .assert_refused("scenario.json: found a directory, expected a scenario file");
}

#[test]
fn with_json_a_refusal_is_an_object_too() {
    let folder = folder_with(&json!({}));
    let run = righting(folder.path(), &["solve", "scenario.json", "--out", "out", "--json"]);
    run.assert_refused("missing");
    assert_eq!(run.json()["exit_code"], 2);
    assert!(run.json()["error"].as_str().is_some_and(|error| error.contains("missing")));
}

#[test]
fn a_folder_that_cannot_take_results_is_refused_before_solving() {
    let folder = folder_with(&small_slew());
    let at = |out: &str| righting(folder.path(), &["solve", "scenario.json", "--out", out]);
    std::fs::write(folder.path().join("file"), "kept").expect("writable");
    at("file").assert_refused("file: cannot hold results: a file is in its place");
    at("file/below").assert_refused("a file is in its place");
    assert_eq!(std::fs::read(folder.path().join("file")).expect("there"), b"kept");

    std::fs::create_dir_all(folder.path().join("held/trajectory.csv")).expect("room");
    at("held").assert_refused("trajectory.csv is a directory");
    std::fs::create_dir_all(folder.path().join("taken/joints.png")).expect("writable");
    at("taken").assert_refused("joints.png is a directory");

    // Not even root may write here.
    #[cfg(target_os = "linux")]
    {
        at("/proc").assert_refused("/proc: cannot hold results");
        at("/proc/absent").assert_refused("/proc/absent: cannot hold results");
    }
}
