//! Whatever is wrong with a scenario, the message is one line that names the file, the field by its
//! JSON path, what was found and what is expected; and nothing panics.

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

use righting_scenario::{Error, Scenario, SystemDescription};
use righting_test_support::{path_of, scenarios};
use serde_json::{Value, json};

const FILE: &str = "plan.json";

/// A good scenario with its system inline.
fn good() -> Value {
    let read = |file: PathBuf| -> Value {
        serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
    };
    let mut scenario = read(scenarios().join("slew_4dof.json"));
    scenario["system"] = read(scenarios().join("systems/xlink_4dof.json"));
    scenario
}

/// The complaint about a scenario, without the file's name.
fn complaint(text: &str) -> String {
    let checked = catch_unwind(|| Scenario::parse(text, Path::new(FILE)));
    let error = checked.expect("no input panics").expect_err(text);
    let message = error.to_string();
    assert!(!message.contains('\n'), "one line: {message}");
    let about = message.strip_prefix("plan.json: ").unwrap_or_else(|| panic!("{message}"));
    about.to_owned()
}

fn assert_complains(text: &str, path: &str, keyword: &str) {
    let message = complaint(text);
    let rest = message.strip_prefix(&format!("{path}: "));
    let rest = rest.unwrap_or_else(|| panic!("`{message}` is not about `{path}`"));
    assert!(rest.contains(keyword), "`{message}` does not say `{keyword}`");
}

fn with(pointer: &str, value: Value) -> Value {
    let mut scenario = good();
    if pointer.starts_with("/horizon/duration_s/") {
        scenario["horizon"]["duration_s"] = json!({ "min": 5, "max": 60 });
    }
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match scenario.pointer_mut(parent).unwrap() {
        Value::Object(object) => {
            object.insert(key.to_owned(), value);
        }
        Value::Array(array) => array[key.parse::<usize>().unwrap()] = value,
        other => panic!("{parent} is {other}"),
    }
    scenario
}

fn without(pointer: &str) -> Value {
    let mut scenario = good();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    scenario.pointer_mut(parent).unwrap().as_object_mut().unwrap().remove(key).unwrap();
    scenario
}

/// Pointers of everything below `value`, objects and arrays too.
fn pointers(value: &Value, at: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                found.push(format!("{at}/{key}"));
                pointers(value, &format!("{at}/{key}"), found);
            }
        }
        Value::Array(array) => {
            for (index, value) in array.iter().enumerate() {
                found.push(format!("{at}/{index}"));
                pointers(value, &format!("{at}/{index}"), found);
            }
        }
        _ => {}
    }
}

#[test]
fn the_unchanged_scenario_is_good() {
    Scenario::parse(&good().to_string(), Path::new(FILE)).unwrap();
}

#[test]
fn a_value_of_the_wrong_type_is_refused_wherever_it_stands() {
    let good = good();
    let mut all = Vec::new();
    pointers(&good, "", &mut all);
    let mut refused = 0;
    for pointer in &all {
        let old = good.pointer(pointer).unwrap();
        for new in [json!("seven"), json!(7), json!(true), json!([]), json!({ "seven": 7 })] {
            let is_same_type = std::mem::discriminant(&new) == std::mem::discriminant(old);
            // A system may be a path, a missing joint limit any number.
            let is_alternative = pointer == "/system" && new.is_string()
                || pointer == "/horizon/duration_s" && new.is_object()
                || old.is_null() && new.is_number()
                || pointer == "/solver/guess" && new.is_object();
            if is_same_type || is_alternative {
                continue;
            }
            let text = with(pointer, new.clone()).to_string();
            let message = complaint(&text);
            let path = path_of(pointer);
            // An object of the wrong shape is refused for the field that it should not have.
            let is_about = message.starts_with(&format!("{path}: found {new}, expected "))
                || new.is_object() && message.starts_with(&format!("{path}.seven: unknown field"));
            assert!(is_about, "{pointer} = {new}: {message}");
            refused += 1;
        }
    }
    assert!(refused > 300, "{refused}");
}

#[test]
fn a_missing_field_is_named() {
    for pointer in [
        "/name",
        "/system",
        "/initial",
        "/maneuver",
        "/horizon",
        "/initial/joint_angles_deg",
        "/maneuver/type",
        "/maneuver/axis",
        "/maneuver/angle_deg",
        "/horizon/duration_s",
        "/horizon/steps",
        "/system/name",
        "/system/base",
        "/system/mount",
        "/system/links",
        "/system/base/mass_kg",
        "/system/base/cube_side_m",
        "/system/mount/position_m",
        "/system/links/2/mass_kg",
        "/system/links/2/a_m",
        "/system/links/2/alpha_deg",
        "/system/links/2/d_m",
        "/system/links/2/theta_deg",
        "/system/links/2/rate_max_deg_s",
        "/system/links/2/acceleration_max_deg_s2",
    ] {
        assert_complains(&without(pointer).to_string(), &path_of(pointer), "missing");
    }
    let text = with("/horizon/duration_s", json!({ "min": 5 })).to_string();
    assert_complains(&text, "horizon.duration_s.max", "missing");
}

#[test]
fn an_unknown_field_is_named_with_the_nearest_one() {
    for (pointer, nearest) in [
        ("/nam", "name"),
        ("/sistem", "system"),
        ("/manoeuvre", "maneuver"),
        ("/weight", "weights"),
        ("/initial/joint_angles", "joint_angles_deg"),
        ("/initial/angular_rate_rad_s", "angular_rate_deg_s"),
        ("/initial/atitude", "attitude"),
        ("/maneuver/angle", "angle_deg"),
        ("/maneuver/Type", "type"),
        ("/horizon/duration", "duration_s"),
        ("/horizon/step", "steps"),
        ("/weights/controls", "control"),
        ("/weights/angular_rates", "angular_rate"),
        ("/collision/clearance", "clearance_m"),
        ("/solver/formulaton", "formulation"),
        ("/solver/max_iteration", "max_iterations"),
        ("/solver/linear-solver", "linear_solver"),
        ("/system/dh_conventions", "dh_convention"),
        ("/system/base/mass", "mass_kg"),
        ("/system/base/cube_side", "cube_side_m"),
        ("/system/mount/position", "position_m"),
        ("/system/links/1/alpha", "alpha_deg"),
        ("/system/links/1/angle_max", "angle_max_deg"),
        ("/system/links/1/body_exemt", "body_exempt"),
        ("/system/links/1/center_of_mass", "center_of_mass_m"),
        ("/system/links/1/inertia_frame", "inertial_frame"),
        ("/system/project_inertia", "project_inertias"),
    ] {
        let text = with(pointer, json!(1)).to_string();
        assert_complains(&text, &path_of(pointer), &format!("did you mean `{nearest}`?"));
    }
    let text = with("/horizon/qqq", json!(1)).to_string();
    assert_complains(&text, "horizon.qqq", "unknown field, expected one of duration_s, steps");
}

#[test]
fn a_value_out_of_range_is_refused_with_the_range() {
    for (pointer, value, keyword) in [
        ("/name", json!(""), "a name"),
        ("/name", json!("  "), "a name"),
        ("/horizon/steps", json!(0), "found 0, expected a whole number from 1 to 100000"),
        ("/horizon/steps", json!(-5), "found -5, expected a whole number from 1"),
        ("/horizon/steps", json!(2.5), "found 2.5, expected a whole number"),
        ("/horizon/steps", json!(1_000_000_000), "found 1e9, expected a whole number from 1 to"),
        ("/horizon/duration_s", json!(0), "above 0"),
        ("/horizon/duration_s", json!(-30.0), "above 0"),
        ("/horizon/duration_s", json!(1e308), "found 1e308, expected a number above 0 and up to"),
        ("/horizon/duration_s/min", json!(60), "found 60, expected a number below max, 60"),
        ("/horizon/duration_s/min", json!(0), "above 0"),
        ("/horizon/duration_s/max", json!(-5), "found -5, expected a number above 0"),
        ("/horizon/duration_s/longest", json!(5), "unknown field"),
        ("/weights/time", json!(1), "found 1, expected none where the duration is given"),
        ("/maneuver/axis", json!([0, 0, 0]), "a vector that is not zero"),
        ("/maneuver/axis", json!([1, 0]), "an array of 3"),
        ("/maneuver/axis", json!([1, 0, 0, 0]), "an array of 3"),
        ("/maneuver/axis/1", json!(1e308), "found 1e308, expected"),
        ("/maneuver/angle_deg", json!(181), "from -180 to 180"),
        ("/maneuver/type", json!("slue"), "did you mean \"slew\"?"),
        ("/maneuver/type", json!("spin"), "\"slew\" or \"detumble\""),
        ("/weights/control", json!(-0.01), "found -0.01, expected a number from 0"),
        ("/weights/attitude", json!(1e308), "found 1e308, expected"),
        ("/weights/position", json!(-1), "a number from 0"),
        ("/weights/velocity", json!(-1), "a number from 0"),
        ("/weights/angular_rate", json!(-1), "a number from 0"),
        ("/weights/joint_angle", json!(-1), "a number from 0"),
        ("/weights/joint_rate", json!(-1), "a number from 0"),
        ("/collision/clearance_m", json!(-0.01), "a number from 0"),
        ("/collision/clearance_m", json!(1e308), "a number from 0"),
        ("/solver/formulation", json!("Full"), "did you mean \"full\"?"),
        (
            "/solver/linear_solver",
            json!("ma57"),
            "found \"ma57\", expected \"auto\", \"mumps\" or \"stage\"",
        ),
        ("/solver/guess", json!("random"), "\"constant\" or \"auto\""),
        ("/solver/max_iterations", json!(0), "a whole number from 1"),
        ("/solver/max_iterations", json!(1e9), "a whole number from 1"),
        ("/solver/tolerance", json!(0), "a number from"),
        ("/solver/tolerance", json!(1), "a number from"),
        ("/initial/joint_angles_deg", json!([0, 0, 0]), "an array of 4, one a joint"),
        ("/initial/joint_angles_deg", json!([0, 0, 0, 0, 0]), "an array of 4, one a joint"),
        ("/initial/joint_angles_deg/1", json!(91), "-90 to 90, the limits of joint 2"),
        ("/initial/joint_angles_deg/2", json!(-50.002), "-50 to 50, the limits of joint 3"),
        ("/initial/joint_angles_deg/0", json!(1e308), "found 1e308, expected"),
        ("/initial/joint_rates_deg_s", json!([0]), "an array of 4, one a joint"),
        ("/initial/angular_rate_deg_s", json!([0, 0]), "an array of 3"),
        ("/initial/angular_rate_deg_s/2", json!(1e308), "found 1e308, expected"),
        ("/initial/angular_rate_deg_s", json!([0, 0, 1]), "a slew ends at rest"),
        ("/initial/attitude", json!([1, 0, 0]), "an array of 4"),
        ("/initial/attitude", json!([1, 1, 0, 0]), "a unit quaternion w, x, y, z"),
        ("/initial/attitude", json!([0, 0, 0, 0]), "a unit quaternion w, x, y, z"),
        ("/system/name", json!(""), "a name"),
        ("/system/base/mass_kg", json!(0), "above 0"),
        ("/system/base/mass_kg", json!(-300), "found -300, expected a number above 0"),
        ("/system/base/mass_kg", json!(1e308), "found 1e308, expected"),
        ("/system/base/cube_side_m", json!(0), "above 0"),
        ("/system/base/cube_side_m", json!(-0.5), "above 0"),
        ("/system/base/keep_out_radius_m", json!(-1), "a number from 0"),
        ("/system/mount/position_m/2", json!(1e308), "found 1e308, expected"),
        ("/system/mount/rotation", json!([1, 0, 0, 1]), "a unit quaternion w, x, y, z"),
        ("/system/dh_convention", json!("craig"), "\"standard\" or \"modified\""),
        ("/system/links", json!([]), "1 to 32 links"),
        ("/system/links/3/mass_kg", json!(-6), "found -6, expected a number from 0"),
        ("/system/links/3/mass_kg", json!(1e308), "found 1e308, expected"),
        ("/system/links/3/a_m", json!(1e308), "found 1e308, expected"),
        ("/system/links/3/alpha_deg", json!(361), "from -360 to 360"),
        ("/system/links/3/d_m", json!(-1e308), "found -1e308, expected"),
        ("/system/links/3/theta_deg", json!(1e9), "from -360 to 360"),
        ("/system/links/3/angle_min_deg", json!(35.5), "at most angle_max_deg, 35"),
        ("/system/links/3/angle_min_deg", json!(90), "at most angle_max_deg, 35"),
        ("/system/links/3/angle_max_deg", json!(1e308), "found 1e308, expected"),
        ("/system/links/3/rate_max_deg_s", json!(0), "above 0"),
        ("/system/links/3/rate_max_deg_s", json!(-17.2), "above 0"),
        ("/system/links/3/acceleration_max_deg_s2", json!(0), "above 0"),
        ("/system/links/3/jerk_max_deg_s3", json!(0), "above 0"),
        ("/system/links/3/jerk_max_deg_s3", json!(-5), "found -5, expected a number above 0"),
        ("/system/links/3/jerk_max_deg_s3", json!(1e308), "found 1e308, expected"),
        ("/system/links/3/jerk_max_deg_s3", json!([5, 5]), "expected a number"),
        ("/system/links/3/torque_max_n_m", json!(0), "above 0"),
        ("/system/links/3/torque_max_n_m", json!(-5), "found -5, expected a number above 0"),
        ("/system/links/3/torque_max_n_m", json!(1e308), "found 1e308, expected"),
        ("/system/mount/force_max_n", json!(0), "above 0"),
        ("/system/mount/moment_max_n_m", json!(-1), "found -1, expected a number above 0"),
        ("/system/base/angular_rate_max_deg_s", json!(0), "above 0"),
        ("/system/base/angular_rate_max_deg_s", json!([1, 1, 1]), "expected a number"),
        ("/system/links/3/center_of_mass_m", json!([0, 0]), "an array of 3"),
        ("/system/links/3/inertia_kg_m2", json!([[1, 0, 0], [0, 1, 0]]), "an array of 3"),
        (
            "/system/links/3/inertial_frame",
            json!("Own"),
            "found \"Own\", expected \"own\" or \"previous\"; did you mean \"own\"?",
        ),
        ("/system/links/3/inertial_frame", json!(3), "expected \"own\" or \"previous\""),
        ("/system/project_inertias", json!("yes"), "found \"yes\", expected true or false"),
        ("/system/project_inertias", json!(1), "found 1, expected true or false"),
        ("/system/payload", json!({ "mass_kg": -1 }), ""),
    ] {
        let path = match path_of(pointer).as_str() {
            "system.payload" => "system.payload.mass_kg".to_owned(),
            path => path.to_owned(),
        };
        assert_complains(&with(pointer, value).to_string(), &path, keyword);
    }
}

/// Values by pointer.
type Changes = Vec<(&'static str, Value)>;

#[test]
fn fields_that_contradict_each_other_are_refused() {
    let identity = json!([[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
    let cases: Vec<(Changes, &str, &str)> = vec![
        (vec![("/maneuver/type", json!("detumble"))], "maneuver.axis", "none for a detumble"),
        (
            vec![("/maneuver", json!({ "type": "detumble", "angle_deg": 20 }))],
            "maneuver.angle_deg",
            "none for a detumble",
        ),
        (
            vec![("/maneuver", json!({ "type": "detumble" }))],
            "initial.angular_rate_deg_s",
            "not zero",
        ),
        (
            vec![
                ("/maneuver", json!({ "type": "detumble" })),
                ("/initial", json!({ "joint_angles_deg": [0, 0, 0, 0] })),
            ],
            "initial.angular_rate_deg_s",
            "missing, expected the angular rate that a detumble takes out",
        ),
        (
            vec![("/initial/joint_rates_deg_s", json!([0, 0, 18, 0]))],
            "initial.joint_rates_deg_s[2]",
            "at most 17.2 in magnitude, the limit of joint 3",
        ),
        (
            vec![
                ("/maneuver", json!({ "type": "detumble" })),
                ("/initial/angular_rate_deg_s", json!([0, 3, 4])),
                ("/system/base/angular_rate_max_deg_s", json!(4.9)),
            ],
            "initial.angular_rate_deg_s",
            "found 5 deg/s in all, expected at most base.angular_rate_max_deg_s, 4.9",
        ),
        (
            vec![
                ("/maneuver", json!({ "type": "detumble" })),
                ("/initial/angular_rate_deg_s", json!([80, 10, 10])),
                ("/initial/joint_angles_deg", json!([0, 60, 0, 0])),
                ("/system/links/1/torque_max_n_m", json!(0.1)),
                ("/system/links/1/acceleration_max_deg_s2", json!(0.1)),
            ],
            "system.links[1].torque_max_n_m",
            "joint 2 needs as much at the start",
        ),
        (
            vec![("/initial/joint_rates_deg_s", json!([0, 5, 0, 0]))],
            "initial.angular_rate_deg_s",
            "no angular momentum",
        ),
        (
            vec![("/system/base/inertia_kg_m2", identity.clone())],
            "system.base.inertia_kg_m2",
            "found both cube_side_m and inertia_kg_m2, expected one of them",
        ),
        (
            vec![("/system/base", json!({ "mass_kg": 300, "inertia_kg_m2": identity }))],
            "system.base.keep_out_radius_m",
            "missing",
        ),
        (
            vec![("/system/links/2/inertia_kg_m2", json!([[1, 0, 0], [0, 1, 0], [0, 0, -1]]))],
            "system.links[2].inertia_kg_m2",
            "zero or more",
        ),
        (
            vec![("/system/links/2/inertia_kg_m2", json!([[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]))],
            "system.links[2].inertia_kg_m2[0][1]",
            "symmetric",
        ),
        (
            vec![("/system/links/2/inertia_kg_m2", json!([[1, 0, 0], [0, 1, 0], [0, 0, 5]]))],
            "system.links[2].inertia_kg_m2",
            "at most the sum of the other two",
        ),
        (
            vec![
                ("/system/links/2/mass_kg", json!(0)),
                ("/system/links/2/inertia_kg_m2", identity.clone()),
            ],
            "system.links[2].inertia_kg_m2",
            "without mass",
        ),
        (
            vec![(
                "/system/base",
                json!({ "mass_kg": 300, "keep_out_radius_m": 0.4,
                        "inertia_kg_m2": [[1, 0, 0], [0, 0, 0], [0, 0, 1]] }),
            )],
            "system.base.inertia_kg_m2",
            "more than zero",
        ),
        (
            vec![(
                "/system/payload",
                json!({ "mass_kg": 5, "inertia_kg_m2": [[1, 0, 0], [0, 1, 0], [0, 0, 9]] }),
            )],
            "system.payload.inertia_kg_m2",
            "at most the sum",
        ),
        (
            vec![("/system/links/1/body_exempt", json!(true))],
            "system.links[1].body_exempt",
            "outside the keep-out sphere",
        ),
        (
            vec![("/system/links/0/body_exempt", json!(false))],
            "initial.joint_angles_deg",
            "found a start with link 1 0.25 m from the base's center of mass, expected at least \
             0.443013 m, keep-out radius and clearance (or set system.links[0].body_exempt)",
        ),
        (
            vec![("/initial/joint_angles_deg", json!([0, 90, 50, 35]))],
            "initial.joint_angles_deg",
            "found a start with link 4 0.436551 m from the base's center of mass",
        ),
        (
            vec![
                ("/system/links/2/angle_max_deg", json!(170)),
                ("/initial/joint_angles_deg", json!([0, 0, 170, 0])),
                ("/collision/clearance_m", json!(0.05)),
            ],
            "initial.joint_angles_deg",
            "found a start with link 4 0.271835 m from the base's center of mass, links 1 and 3 0.043412 \
             m apart, links 1 and 4 0.0435779 m apart, links 2 and 4 0.043412 m apart, expected at least \
             0.483013 m, keep-out radius and clearance, and between links the clearance, 0.05 m (or set \
             system.links[3].body_exempt, and collision.clearance_m to 0.0434)",
        ),
        (
            vec![
                ("/system/links/2/angle_max_deg", json!(170)),
                ("/initial/joint_angles_deg", json!([0, 0, 170, 0])),
                ("/collision/clearance_m", json!(0.05)),
                ("/system/base/keep_out_radius_m", json!(0.22)),
            ],
            "initial.joint_angles_deg",
            "found a start with links 1 and 3 0.043412 m apart, links 1 and 4 0.0435779 m apart, links 2 \
             and 4 0.043412 m apart, expected at least the clearance, 0.05 m (or set \
             collision.clearance_m to 0.0434)",
        ),
        (vec![("/solver/guess", json!({ "starts": 0 }))], "solver.guess.starts", "from 1 to 1000"),
        (vec![("/solver/guess", json!({ "starts": -1 }))], "solver.guess.starts", "a whole number"),
        (vec![("/solver/guess", json!({ "seed": 1 }))], "solver.guess.starts", "missing"),
        (
            vec![("/solver/guess", json!({ "starts": 4, "sede": 1 }))],
            "solver.guess.sede",
            "did you mean `seed`?",
        ),
        (vec![("/system", json!(""))], "system", "the path of a system file"),
        (vec![("/system", json!("none.json"))], "system", "no such file"),
        (vec![("/system", json!("/"))], "system", "(/: found a directory, expected a system file)"),
    ];
    for (changes, path, keyword) in cases {
        let mut scenario = good();
        for (pointer, value) in changes {
            let (parent, key) = pointer.rsplit_once('/').unwrap();
            scenario.pointer_mut(parent).unwrap()[key] = value;
        }
        assert_complains(&scenario.to_string(), path, keyword);
    }
}

#[test]
fn text_that_is_not_json_is_refused_with_line_and_column() {
    let good = serde_json::to_string_pretty(&good()).unwrap();
    for (from, to, place, keyword) in [
        ("\"duration_s\": 30.0", "\"duration_s\": NaN", "horizon.duration_s: line ", "not JSON"),
        ("\"duration_s\": 30.0", "\"duration_s\": Infinity", "horizon.duration_s: line ", "JSON"),
        ("\"duration_s\": 30.0", "\"duration_s\": -inf", "horizon.duration_s: line ", "not JSON"),
        ("\"duration_s\": 30.0", "\"duration_s\": 1e999", "horizon.duration_s: line ", "range"),
        ("\"duration_s\": 30.0", "\"duration_s\": 030", "horizon", "not JSON"),
        ("\"duration_s\": 30.0", "\"duration_s\": 0x1E", "horizon", "not JSON"),
        ("\"duration_s\": 30.0", "\"duration_s\": '30'", "horizon.duration_s: line ", "not JSON"),
        ("\"duration_s\": 30.0,", "\"duration_s\": 30.0", "horizon", "not JSON"),
        ("\"duration_s\"", "duration_s", "horizon", "not JSON"),
        (
            "\"duration_s\": 30.0",
            "\"duration_s\": 30.0, \"duration_s\": 60.0",
            "horizon.duration_s: ",
            "duplicate field",
        ),
    ] {
        assert!(good.contains(from));
        let message = complaint(&good.replacen(from, to, 1));
        assert!(message.starts_with(place), "{to}: {message}");
        assert!(message.contains(keyword), "{to}: {message}");
    }
    for text in ["", " ", "{", "[]", "null", "7", "\"plan\"", "{}", "\u{feff}{}", "{\"name\": 1}"] {
        complaint(text);
    }
    assert!(complaint(&format!("{good} {{}}")).contains("trailing characters"));
    let comma = complaint(&good.replacen("\n}", ",\n}", 1));
    assert!(comma.starts_with("line ") && comma.ends_with("not JSON: trailing comma"), "{comma}");
    assert!(complaint(&"[".repeat(100_000)).contains("recursion limit"));
    assert!(complaint(&"{\"a\":".repeat(100_000)).contains("recursion limit"));
}

#[test]
fn files_that_are_not_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let message = |file: &Path| {
        let error = Scenario::read(file).unwrap_err();
        let message = error.to_string();
        let place = format!("{}: ", file.display());
        message.strip_prefix(&place).expect("the message starts with the file").to_owned()
    };
    assert_eq!(message(&folder.path().join("none.json")), "cannot be read: no such file");
    assert_eq!(message(folder.path()), "found a directory, expected a scenario file");

    let binary = folder.path().join("binary.json");
    fs::write(&binary, [0xff, 0xfe, 0x00, 0x80]).unwrap();
    assert_eq!(message(&binary), "cannot be read: not UTF-8 text");

    let huge = folder.path().join("huge.json");
    fs::File::create(&huge).unwrap().set_len(65 << 20).unwrap();
    assert_eq!(message(&huge), "found 68157440 bytes, expected at most 67108864");
}

#[test]
fn a_fault_in_a_system_file_names_that_file() {
    let folder = tempfile::tempdir().unwrap();
    let system_file = folder.path().join("arm.json");
    let scenario_file = folder.path().join("plan.json");
    let scenario = with("/system", json!("arm.json"));
    fs::write(&scenario_file, scenario.to_string()).unwrap();
    let mut system = good()["system"].clone();
    let write = |system: &Value| fs::write(&system_file, system.to_string()).unwrap();

    write(&system);
    let read = Scenario::read(&scenario_file).unwrap();
    assert_eq!(read.system(), &SystemDescription::read(&system_file).unwrap());

    system["links"][3]["mass_kg"] = json!(-6);
    write(&system);
    let message = Scenario::read(&scenario_file).unwrap_err().to_string();
    let place =
        format!("{}: links[3].mass_kg: found -6, expected a number from 0", system_file.display());
    assert!(message.starts_with(&place), "{message}");

    system["links"][3]["mass_kg"] = json!(6);
    system["links"][2]["body_exempt"] = json!(true);
    write(&system);
    let message = Scenario::read(&scenario_file).unwrap_err().to_string();
    let place =
        format!("{}: links[2].body_exempt: found true, expected false", system_file.display());
    assert!(message.starts_with(&place), "{message}");

    fs::write(&system_file, "{ \"name\": ").unwrap();
    let error = Scenario::read(&scenario_file).unwrap_err();
    assert!(matches!(&error, Error::NotJson { file, .. } if *file == system_file), "{error}");
}

/// Damage at random places: whatever comes out is a scenario or a complaint.
#[test]
fn damaged_text_never_panics() {
    let good = serde_json::to_string_pretty(&good()).unwrap().into_bytes();
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    let alphabet = b"0123456789-+.eE\"{}[],: ntfalsru\\";
    let mut refused = 0;
    for _ in 0..3000 {
        let mut text = good.clone();
        for _ in 0..=random(3) {
            let at = random(text.len());
            match random(4) {
                0 => text[at] = alphabet[random(alphabet.len())],
                1 => text.insert(at, alphabet[random(alphabet.len())]),
                2 => drop(text.remove(at)),
                _ => text.truncate(at.max(1)),
            }
        }
        let text = String::from_utf8(text).unwrap();
        let checked = catch_unwind(|| Scenario::parse(&text, Path::new(FILE)));
        match checked.unwrap_or_else(|_| panic!("a panic from:\n{text}")) {
            Ok(_) => {}
            Err(error) => {
                assert!(!error.to_string().contains('\n'));
                refused += 1;
            }
        }
    }
    assert!(refused > 1500, "{refused}");
}
