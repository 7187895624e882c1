//! Limits, targets, wheels and surroundings that cannot be: exit code 2, and the field is named. What is wrong with one
//! field by itself (its type, its length, its range) is in the library's tests.

use serde_json::{Value, json};

use crate::program::{folder_with, root, solve};

/// A shipped scenario with its system inline.
fn shipped(name: &str) -> Value {
    let read = |path: &str| -> Value {
        let text = std::fs::read_to_string(root().join("scenarios").join(path)).expect("it ships");
        serde_json::from_str(&text).expect("JSON")
    };
    let mut scenario = read(&format!("{name}.json"));
    let system = scenario["system"].as_str().expect("a path").trim_start_matches("../").to_owned();
    scenario["system"] = read(&system);
    scenario
}

fn arm() -> Value {
    shipped("slew_4dof")
}

fn sliding() -> Value {
    shipped("real/slew_stanford")
}

fn detumble() -> Value {
    shipped("detumble_4dof")
}

/// Each scenario with some values changed is refused for the field, by a message that says so much.
#[track_caller]
fn assert_all_refused(scenario: &Value, cases: &[(Value, &str, &str)]) {
    for (changes, field, part) in cases {
        let mut changed = scenario.clone();
        for (pointer, value) in changes.as_object().expect("values by pointer") {
            let (parent, key) = pointer.rsplit_once('/').expect("a pointer");
            match changed.pointer_mut(parent).expect(pointer) {
                Value::Array(array) => {
                    array[key.parse::<usize>().expect("an index")] = value.clone()
                }
                object => object[key] = value.clone(),
            }
        }
        let folder = folder_with(&changed);
        let run = solve(folder.path());
        let message = run.stderr.lines().next().unwrap_or_default();
        let about = message.strip_prefix(&format!("error: scenario.json: {field}: "));
        assert!(run.code == 2 && about.is_some(), "{changes}: {} {}", run.code, run.stderr);
        assert!(about.is_some_and(|about| about.contains(part)), "no \"{part}\" in: {message}");
        assert!(!folder.path().join("out").exists());
    }
}

#[test]
fn the_least_above_the_most() {
    assert_all_refused(
        &arm(),
        &[
            (
                json!({ "/system/links/1/angle_min_deg": 91 }),
                "system.links[1].angle_min_deg",
                "at most",
            ),
            (
                json!({ "/horizon/duration_s": { "min": 61, "max": 60 } }),
                "horizon.duration_s.min",
                "found 61, expected a number below max, 60",
            ),
        ],
    );
    assert_all_refused(
        &sliding(),
        &[
            (
                json!({ "/system/bodies/2/joint/travel_min_m": 2 }),
                "system.bodies[2].joint.travel_min_m",
                "found 2, expected at most travel_max_m, 1.27",
            ),
            (
                json!({ "/system/bodies/0/joint/angle_max_deg": -171 }),
                "system.bodies[0].joint.angle_min_deg",
                "found -170, expected at most angle_max_deg, -171",
            ),
        ],
    );
}

#[test]
fn postures_outside_limits_or_in_collision() {
    let radius = json!({ "/system/links/3/radius_m": 0.3, "/system/links/1/radius_m": 0.3 });
    let boxed = json!([{ "box": { "center_m": [0, 0, 1.5], "size_m": [1, 1, 1] } }]);
    assert_all_refused(
        &arm(),
        &[
            (
                json!({ "/initial/joint_angles_deg": [0, 0, 51, 0] }),
                "initial.joint_angles_deg[2]",
                "found 51, expected -50 to 50, the limits of joint 3",
            ),
            (
                json!({ "/final": { "joint_angles_deg": [null, null, -51, null] } }),
                "final.joint_angles_deg[2]",
                "-50 to 50",
            ),
            (
                json!({ "/system/links/1/angle_min_deg": 0, "/system/links/1/angle_max_deg": 0,
                        "/final": { "joint_angles_deg": [null, 10, null, null] } }),
                "final.joint_angles_deg[1]",
                "found 10, expected 0, the angle at which joint 2 is locked",
            ),
            (
                json!({ "/initial/joint_angles_deg": [0, 90, 50, 35] }),
                "initial.joint_angles_deg",
                "found a start with link 4 0.436551 m from the base's center of mass",
            ),
            (
                json!({ "/final": { "joint_angles_deg": [0, 90, 50, 35] } }),
                "final.joint_angles_deg",
                "found an end with link 4 and body 0.436551 m apart, expected at least 0.443013 m",
            ),
            (radius, "initial.joint_angles_deg", "found a start with link 2"),
            (
                json!({ "/system/base/keep_out": boxed }),
                "system.links[0].body_exempt",
                "found true",
            ),
        ],
    );
    assert_all_refused(
        &sliding(),
        &[
            (
                json!({ "/initial/joint_travels_m": [0.2] }),
                "initial.joint_travels_m[0]",
                "found 0.2, expected 0.3048 to 1.27, the limits of boom_joint",
            ),
            (
                json!({ "/final": { "joint_travels_m": [1.3] } }),
                "final.joint_travels_m[0]",
                "found 1.3, expected 0.3048 to 1.27, the limits of boom_joint",
            ),
        ],
    );
}

#[test]
fn shapes_that_are_none() {
    let sphere = json!({ "center_m": [0, 0, 0], "radius_m": 0.1 });
    let capsule = json!({ "from_m": [0, 0, 0], "to_m": [0, 0, 1], "radius_m": 0.1 });
    assert_all_refused(
        &arm(),
        &[
            (
                json!({ "/system/links/3/shapes": [{}] }),
                "system.links[3].shapes[0]",
                "found no shape",
            ),
            (
                json!({ "/system/links/3/shapes": [{ "sphere": sphere, "capsule": capsule }] }),
                "system.links[3].shapes[0]",
                "found 2 shapes",
            ),
            (
                json!({ "/system/links/3/shapes": [{ "sphere": sphere }], "/system/links/3/radius_m": 0.1 }),
                "system.links[3].shapes",
                "found both radius_m and shapes",
            ),
            (
                json!({ "/system/ignored_pairs": [["links[9]", "payload"]] }),
                "system.ignored_pairs[0][0]",
                "found \"links[9]\"",
            ),
        ],
    );
}

#[test]
fn cones_around_the_start_the_target_or_a_stop() {
    let cone = |direction: Value, side: &str, angle_deg: f64| {
        json!({ "/pointing": [{
            "name": "Sun", "boresight_body": [0, 0, 1], "direction_inertial": direction, side: angle_deg
        }] })
    };
    let table = |times: Value, vectors: Value| {
        json!({ "/pointing": [{
            "name": "Sun", "boresight_body": [0, 0, 1],
            "direction_table": { "t_s": times, "vectors": vectors }, "keep_out_deg": 5
        }] })
    };
    let mut by_way = cone(json!([0, -1, 1]), "keep_out_deg", 10.0);
    by_way["/maneuver/waypoints"] = json!([{ "axis": [1, 0, 0], "angle_deg": 45 }]);
    // The body's z axis after 90° about y.
    let mut target = cone(json!([1, 0, 0]), "keep_out_deg", 5.0);
    target["/maneuver/axis"] = json!([0, 1, 0]);
    target["/maneuver/angle_deg"] = json!(90);
    let x = json!([1, 0, 0]);
    assert_all_refused(
        &arm(),
        &[
            (
                cone(json!([0, 0, 1]), "keep_out_deg", 5.0),
                "pointing[0].keep_out_deg",
                "found a start 0\u{b0}",
            ),
            (
                cone(x.clone(), "keep_in_deg", 5.0),
                "pointing[0].keep_in_deg",
                "found a start 90\u{b0}",
            ),
            (
                cone(json!([0, 0, 1]), "keep_in_deg", 5.0),
                "pointing[0].keep_in_deg",
                "found a target 14.6946\u{b0}",
            ),
            (target, "pointing[0].keep_out_deg", "found a target "),
            (by_way, "pointing[0].keep_out_deg", "found a waypoint "),
            (
                table(json!([0, 10]), json!([x, x])),
                "pointing[0].direction_table.t_s[1]",
                "covers the maneuver",
            ),
            (
                table(json!([0, 20, 10]), json!([x, x, x])),
                "pointing[0].direction_table.t_s[2]",
                "more than 20",
            ),
            (
                table(json!([0, 40]), json!([x, [-1, 0, 0]])),
                "pointing[0].direction_table.vectors[1]",
                "found a direction 180\u{b0} from the one before",
            ),
        ],
    );
}

#[test]
fn limits_below_what_the_start_needs() {
    assert_all_refused(
        &detumble(),
        &[
            (
                json!({ "/system/base/angular_rate_max_deg_s": 2 }),
                "initial.angular_rate_deg_s",
                "expected at most base.angular_rate_max_deg_s, 2",
            ),
            (
                json!({ "/system/links/0/acceleration_max_deg_s2": 0.001,
                        "/system/links/1/acceleration_max_deg_s2": 0.001,
                        "/system/links/2/acceleration_max_deg_s2": 0.001,
                        "/system/links/3/acceleration_max_deg_s2": 0.001,
                        "/system/links/1/torque_max_n_m": 0.001 }),
                "system.links[1].torque_max_n_m",
                "joint 2 needs as much at the start",
            ),
        ],
    );
}

#[test]
fn drives_that_lack_a_part() {
    let drive = |drive: Value| json!({ "/system/links/1/drive": drive });
    assert_all_refused(
        &arm(),
        &[
            (
                drive(json!({ "torque_constant_n_m_a": 0.1 })),
                "system.links[1].drive.resistance_ohm",
                "missing, expected the resistance of the windings",
            ),
            (
                drive(json!({ "resistance_ohm": 1 })),
                "system.links[1].drive.torque_constant_n_m_a",
                "missing, expected the motor's torque an ampere",
            ),
        ],
    );
}

#[test]
fn targets_and_times_that_do_not_go_together() {
    let stop = |more: Value| {
        let mut stop = json!({ "axis": [0, 0, 1], "angle_deg": 5 });
        stop.as_object_mut().expect("an object").extend(more.as_object().expect("fields").clone());
        json!([stop])
    };
    assert_all_refused(
        &arm(),
        &[
            (
                json!({ "/maneuver/target_attitude": [1, 0, 0, 0] }),
                "maneuver.target_attitude",
                "found an attitude beside axis and angle_deg",
            ),
            (
                json!({ "/maneuver/waypoints": stop(json!({ "dwell_s": 31 })) }),
                "maneuver.waypoints",
                "found waypoints that take 31 s, expected at most horizon.duration_s, 30",
            ),
            (
                json!({ "/maneuver/waypoints": stop(json!({})), "/horizon/duration_s": { "min": 5, "max": 60 } }),
                "horizon.duration_s",
                "maneuver.waypoints do not go with a free duration",
            ),
            (
                json!({ "/maneuver/waypoints": [{ "dwell_s": 1 }] }),
                "maneuver.waypoints[0].axis",
                "missing",
            ),
        ],
    );
}

#[test]
fn wheels_that_cannot_be() {
    let wheel = |more: Value| {
        let mut wheel =
            json!({ "axis": [0, 0, 1], "momentum_max_n_m_s": 1, "torque_max_n_m": 0.1 });
        wheel.as_object_mut().expect("an object").extend(more.as_object().expect("fields").clone());
        json!([wheel])
    };
    let end = |momenta: Value| json!({ "wheel_momenta_n_m_s": momenta });
    let good = wheel(json!({}));
    let failed = wheel(json!({ "failed": true }));
    assert_all_refused(
        &arm(),
        &[
            (
                json!({ "/wheels": wheel(json!({ "axis": [0, 0, 0] })) }),
                "wheels[0].axis",
                "not zero",
            ),
            (
                json!({ "/wheels": wheel(json!({ "initial_momentum_n_m_s": -1.1 })) }),
                "wheels[0].initial_momentum_n_m_s",
                "found -1.1, expected a number from -1 to 1",
            ),
            (
                json!({ "/wheels": good, "/final": end(json!([1.1])) }),
                "final.wheel_momenta_n_m_s[0]",
                "found 1.1, expected a number from -1 to 1",
            ),
            (
                json!({ "/wheels": good, "/final": end(json!([0, 0])) }),
                "final.wheel_momenta_n_m_s",
                "found an array of 2, expected an array of 1, one a wheel",
            ),
            (
                json!({ "/wheels": failed, "/final": end(json!([0.1])) }),
                "final.wheel_momenta_n_m_s[0]",
                "the wheel has failed and keeps its momentum",
            ),
            (json!({ "/final": end(json!([0])) }), "final.wheel_momenta_n_m_s", "an array of 0"),
            (json!({ "/weights": { "wheel_torque": 1 } }), "weights.wheel_torque", "no wheels"),
            (json!({ "/weights": { "wheel_momentum": 1 } }), "weights.wheel_momentum", "no wheels"),
        ],
    );
}

#[test]
fn surroundings_that_cannot_be() {
    let gradient = |more: Value| {
        let mut gradient = json!({ "altitude_km": 400 });
        let fields = more.as_object().expect("fields").clone();
        gradient.as_object_mut().expect("an object").extend(fields);
        json!({ "/environment": { "gravity_gradient": gradient } })
    };
    let elements =
        json!({ "inclination_deg": 1, "right_ascension_deg": 1, "argument_of_latitude_deg": 1 });
    assert_all_refused(
        &arm(),
        &[
            (
                gradient(json!({ "orbit_attitude": [1, 0, 0, 0], "elements": elements })),
                "environment.gravity_gradient.elements",
                "found both orbit_attitude and elements",
            ),
            (
                gradient(json!({ "orbit_attitude": [1, 1, 0, 0] })),
                "environment.gravity_gradient.orbit_attitude",
                "a unit quaternion",
            ),
            (
                json!({ "/initial/angular_rate_deg_s": [1, 0, 0] }),
                "initial.angular_rate_deg_s",
                "no angular momentum, since a slew ends at rest",
            ),
        ],
    );
}
