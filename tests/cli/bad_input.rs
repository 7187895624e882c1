//! Spot checks of bad input through the program; the library's tests hold the long list.

use serde_json::{Value, json};

use crate::program::{Run, folder_with, righting, small_slew, solve};

/// Refused for a field before anything is written, with exactly this message about it.
fn assert_refused(scenario: &Value, message: &str) {
    let folder = folder_with(scenario);
    let run = solve(folder.path());
    assert_says(&run, &format!("scenario.json: {message}"));
    assert_eq!(run.stdout, "");
    assert!(!folder.path().join("out").exists());
}

fn assert_says(run: &Run, message: &str) {
    let hint = "  hint: `righting schema` prints the format with every field\n";
    assert_eq!((run.code, run.stderr.as_str()), (2, &*format!("error: {message}\n{hint}")));
}

#[test]
fn the_message_names_the_field_and_what_is_expected() {
    let wrong = |path: &str, value: Value| {
        let mut scenario = small_slew();
        *scenario.pointer_mut(path).expect("a field of the scenario") = value;
        scenario
    };
    for (path, value, message) in [
        (
            "/horizon/steps",
            json!(0),
            "horizon.steps: found 0, expected a whole number from 1 to 100000",
        ),
        (
            "/horizon/steps",
            json!(1e9),
            "horizon.steps: found 1e9, expected a whole number from 1 to 100000",
        ),
        (
            "/horizon/steps",
            json!(2.5),
            "horizon.steps: found 2.5, expected a whole number from 1 to 100000",
        ),
        (
            "/horizon/duration_s",
            json!(-1),
            "horizon.duration_s: found -1, expected a number above 0 and up to 1e8",
        ),
        (
            "/horizon/duration_s",
            json!("long"),
            "horizon.duration_s: found \"long\", expected a number, or an object with `min` and `max`",
        ),
        (
            "/horizon",
            json!([20, 40]),
            "horizon: found [20,40], expected an object with `duration_s` and `steps`",
        ),
        (
            "/maneuver/axis",
            json!([0, 0, 0]),
            "maneuver.axis: found [0, 0, 0], expected a vector that is not zero",
        ),
        ("/maneuver/axis", json!([1, 0]), "maneuver.axis: found [1,0], expected an array of 3"),
        (
            "/maneuver/angle_deg",
            json!(1e308),
            "maneuver.angle_deg: found 1e308, expected a number from -180 to 180",
        ),
        (
            "/maneuver/type",
            json!("spin"),
            "maneuver.type: found \"spin\", expected \"slew\" or \"detumble\"",
        ),
        (
            "/system/base/mass_kg",
            json!(-300),
            "system.base.mass_kg: found -300, expected a number above 0 and up to 1e15",
        ),
        ("/system/links", json!([]), "system.links: found [], expected an array of 1 to 32 links"),
        (
            "/system/links/1/mass_kg",
            json!(null),
            "system.links[1].mass_kg: found null, expected a number",
        ),
        (
            "/system/links/1/angle_max_deg",
            json!(-91),
            "system.links[1].angle_min_deg: found -90, expected at most angle_max_deg, -91",
        ),
        (
            "/initial/joint_angles_deg",
            json!([0, 120]),
            "initial.joint_angles_deg[1]: found 120, expected -90 to 90, the limits of joint 2",
        ),
        (
            "/initial/joint_angles_deg",
            json!([0]),
            "initial.joint_angles_deg: found an array of 1, expected an array of 2, one a joint",
        ),
        (
            "/system",
            json!("absent.json"),
            "system: found \"absent.json\", expected the path of a system file (absent.json: cannot be read: no such file)",
        ),
        (
            "/system",
            json!("."),
            "system: found \".\", expected the path of a system file (.: found a directory, expected a system file)",
        ),
    ] {
        assert_refused(&wrong(path, value), message);
    }
}

#[test]
fn settings_of_the_solver_are_met_with_what_there_is() {
    for (field, value, message) in [
        (
            "formulation",
            json!("Full"),
            "found \"Full\", expected \"full\" or \"reduced\"; did you mean \"full\"?",
        ),
        (
            "linear_solver",
            json!("ma57"),
            "found \"ma57\", expected \"auto\", \"mumps\" or \"stage\"",
        ),
        ("guess", json!("random"), "found \"random\", expected \"constant\" or \"auto\""),
        ("guess", json!(4), "found 4, expected \"constant\", \"auto\" or an object with `starts`"),
        ("max_iterations", json!(0), "found 0, expected a whole number from 1 to 1000000"),
        ("tolerance", json!(1), "found 1, expected a number from 1e-14 to 0.01"),
    ] {
        let mut scenario = small_slew();
        scenario["solver"] = json!({ field: value });
        assert_refused(&scenario, &format!("solver.{field}: {message}"));
    }
}

#[test]
fn what_is_missing_unknown_or_twice_is_named() {
    let without = |pointer: &str, field: &str| {
        let mut scenario = small_slew();
        let object = scenario.pointer_mut(pointer).expect("an object");
        object.as_object_mut().expect("an object").remove(field).expect("the field");
        scenario
    };
    assert_refused(&without("/horizon", "steps"), "horizon.steps: missing: it has no default");
    let message = "maneuver.axis: missing, expected the axis of the slew";
    assert_refused(&without("/maneuver", "axis"), message);
    let message = "system.base.cube_side_m: missing, expected the side of a cube, or inertia_kg_m2 \
                   with keep_out_radius_m or keep_out";
    assert_refused(&without("/system/base", "cube_side_m"), message);
    let mut scenario = small_slew();
    scenario["horizon"]["qqq"] = json!(3);
    let message = "horizon.qqq: unknown field, expected one of duration_s, steps";
    assert_refused(&scenario, message);

    let folder = folder_with(&json!({}));
    let text = small_slew().to_string().replacen('{', "{\"name\": \"first\", ", 1);
    std::fs::write(folder.path().join("scenario.json"), text).expect("writable");
    assert_says(&solve(folder.path()), "scenario.json: name: duplicate field, expected once");
}

#[test]
fn a_misspelt_field_is_met_with_the_right_one() {
    let mut scenario = small_slew();
    scenario["horizon"]["durations_s"] = json!(3);
    assert_refused(&scenario, "horizon.durations_s: unknown field: did you mean `duration_s`?");
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

#[test]
fn targets_and_cones_that_cannot_be_are_refused_by_name() {
    let with = |field: &str, value: Value| {
        let mut scenario = small_slew();
        scenario[field] = value;
        scenario
    };
    let end = |angles_deg: Value| with("final", json!({ "joint_angles_deg": angles_deg }));
    let cone = |sun: Value, keep_out_deg: f64| {
        let tracker = json!({
            "name": "tracker", "boresight_body": [0, 0, 1],
            "direction_inertial": sun, "keep_out_deg": keep_out_deg
        });
        with("pointing", json!([tracker]))
    };
    let attitude = json!({ "type": "slew", "target_attitude": [1, 1, 0, 0] });
    for (scenario, message) in [
        (
            with("maneuver", attitude),
            "maneuver.target_attitude: found [1, 1, 0, 0], expected a unit quaternion w, x, y, z (this one's norm \
             is 1.4142135623730951)",
        ),
        (
            end(json!([null])),
            "final.joint_angles_deg: found an array of 1, expected an array of 2, one a joint",
        ),
        (
            end(json!([null, 91])),
            "final.joint_angles_deg[1]: found 91, expected -90 to 90, the limits of joint 2",
        ),
        (
            cone(json!([0, 0, 0]), 30.0),
            "pointing[0].direction_inertial: found [0, 0, 0], expected a vector that is not zero",
        ),
        (
            cone(json!([0, 1, 1]), -30.0),
            "pointing[0].keep_out_deg: found -30, expected a number above 0 and up to 180",
        ),
        (
            cone(json!([0, 1, 1]), 50.0),
            "pointing[0].keep_out_deg: found a start 45\u{b0} from the direction of \"tracker\", expected at least \
             50\u{b0}",
        ),
    ] {
        assert_refused(&scenario, message);
    }
}
