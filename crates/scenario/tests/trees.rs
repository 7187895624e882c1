//! Systems of bodies on joints: what is taken, what is refused and by which field, and what is called what.

use std::path::Path;

use righting_scenario::file::JointPlace;
use righting_scenario::{Error, Scenario, SystemDescription};
use righting_test_support::scenarios;
use serde_json::{Value, json};

/// A base with two arms, the bodies in an order that no tree has.
fn two_arms() -> Value {
    let body = |name: &str, parent: &str, kind: &str, position: [f64; 3]| {
        let mut joint = json!({ "type": kind, "position_m": position });
        if kind != "fixed" {
            joint["rate_max_deg_s"] = json!(10);
            joint["acceleration_max_deg_s2"] = json!(5);
        }
        json!({ "name": name, "parent": parent, "joint": joint, "mass_kg": 2 })
    };
    json!({
        "name": "two arms",
        "base": {
            "name": "bus", "mass_kg": 100, "keep_out_radius_m": 0.1,
            "inertia_kg_m2": [[9, 0, 0], [0, 8, 0], [0, 0, 7]], "center_of_mass_m": [0.1, 0, 0]
        },
        "bodies": [
            body("left_hand", "left_arm", "fixed", [0.0, 0.0, 0.5]),
            body("left_arm", "bus", "revolute", [0.0, 1.0, 0.0]),
            body("right_arm", "bus", "continuous", [0.0, -1.0, 0.0]),
        ]
    })
}

fn scenario(system: &Value) -> Result<Scenario, Error> {
    let scenario = json!({
        "name": "turn",
        "system": system,
        "initial": { "joint_angles_deg": [10, 20] },
        "maneuver": { "type": "slew", "axis": [0, 0, 1], "angle_deg": 5 },
        "horizon": { "duration_s": 30, "steps": 30 }
    });
    Scenario::parse(&scenario.to_string(), Path::new("turn.json"))
}

/// A joint that slides, with some of its fields changed; null takes one away.
fn slide(change: Value) -> Value {
    let mut joint = json!({
        "type": "prismatic", "travel_min_m": 0.5, "travel_max_m": 1.5, "speed_max_m_s": 0.2,
        "acceleration_max_m_s2": 0.1, "force_max_n": 40, "axis": [0, 0, 2]
    });
    for (name, value) in change.as_object().unwrap() {
        joint[name] = value.clone();
    }
    joint
}

#[test]
fn joints_are_in_the_order_of_the_bodies_that_move() {
    let scenario = scenario(&two_arms()).unwrap();
    let system = scenario.system();
    assert_eq!((system.joint_count(), system.model.part_count()), (2, 3));
    assert_eq!(
        [0, 1].map(|joint| system.names.joint(joint)),
        ["left_arm_joint", "right_arm_joint"]
    );
    let places = scenario.resolved_system().joints().into_iter().map(|row| row.place);
    assert_eq!(places.collect::<Vec<_>>(), [JointPlace::Body(1), JointPlace::Body(2)]);
    assert_eq!(system.model.total_mass(), 106.0);
    let posture = system.model.kinematics(&scenario.initial().joint_angles_rad);
    assert_eq!(posture.joint_origins[1].as_slice(), [0.0, -1.0, 0.0]);
    assert_eq!(posture.frames[1].origin.as_slice(), [0.0, 1.0, 0.5]);
    // What a resolved file says is the same system.
    let again = scenario.varied(|_| ()).unwrap();
    assert_eq!(again.system(), system);
    assert_eq!(again.resolved().sha256(), scenario.resolved().sha256());
}

#[test]
fn the_shipped_twin_is_the_arm_in_rows() {
    let [rows, bodies] = ["xlink_4dof", "xlink_4dof_bodies"].map(|name| {
        SystemDescription::read(&scenarios().join(format!("systems/{name}.json"))).unwrap()
    });
    let q = [0.3, -0.4, 0.5, 0.2];
    let qdot = [0.1, -0.2, 0.3, 0.5];
    let [of_rows, of_bodies] = [&rows, &bodies].map(|system| {
        let model = &system.model;
        let h = model.h_tilde(&q, &qdot);
        (model.locked_inertia(&q), h, model.center_of_mass(&q))
    });
    assert!((of_rows.0 - of_bodies.0).norm() < 1e-13 * of_rows.0.norm());
    assert!((of_rows.1 - of_bodies.1).norm() < 1e-14 && (of_rows.2 - of_bodies.2).norm() < 1e-15);
    assert_eq!(rows.joint_limits, bodies.joint_limits);
}

#[test]
fn what_is_wrong_is_named() {
    type Case = (fn(&mut Value), &'static str);
    let cases: [Case; 29] = [
        (
            |s| s["bodies"][0]["parent"] = json!("left_leg"),
            "bodies[0].parent: found \"left_leg\", expected the name of another body, or of the base, \"bus\"",
        ),
        (
            |s| s["bodies"][1]["parent"] = json!("left_hand"),
            "bodies[0].parent: found \"left_arm\", expected a body that leads to the base, \"bus\"",
        ),
        (
            |s| s["bodies"][2]["name"] = json!("left_arm"),
            "bodies[2].name: found \"left_arm\", expected a name of its own: the body at system.bodies[1].name",
        ),
        (
            |s| s["bodies"][2]["name"] = json!("bus"),
            "bodies[2].name: found \"bus\", expected a name of its own: the body at system.base.name",
        ),
        (|s| s["bodies"][2]["name"] = json!(" "), "bodies[2].name: found \"\", expected a name"),
        (
            |s| {
                s["bodies"][1]["joint"]["name"] = json!("hinge");
                s["bodies"][2]["joint"]["name"] = json!("hinge");
            },
            "bodies[2].joint.name: found \"hinge\", expected a name of its own: the joint at",
        ),
        (
            |s| s["bodies"][1]["joint"]["type"] = json!("prismatic"),
            "bodies[1].joint.rate_max_deg_s: found 10, expected none for a prismatic joint",
        ),
        (
            |s| s["bodies"][1]["joint"]["travel_max_m"] = json!(1),
            "bodies[1].joint.travel_max_m: found 1, expected none for a revolute joint",
        ),
        (
            |s| s["bodies"][1]["joint"] = slide(json!({ "travel_min_m": null })),
            "bodies[1].joint.travel_min_m: missing, expected where the joint's travel ends, m",
        ),
        (
            |s| s["bodies"][1]["joint"] = slide(json!({ "travel_min_m": 2 })),
            "bodies[1].joint.travel_min_m: found 2, expected at most travel_max_m, 1.5",
        ),
        (
            |s| s["bodies"][1]["joint"] = slide(json!({ "speed_max_m_s": null })),
            "bodies[1].joint.speed_max_m_s: missing, expected the largest speed, m/s",
        ),
        (
            |s| s["bodies"][1]["joint"] = slide(json!({ "drive": { "gear_ratio": 100 } })),
            "bodies[1].joint.drive: found a drive, expected none for a prismatic joint",
        ),
        (
            |s| s["bodies"][1]["joint"]["type"] = json!("ball"),
            "bodies[1].joint.type: found \"ball\", expected",
        ),
        (
            |s| s["bodies"][1]["joint"]["axis"] = json!([0, 0, 0]),
            "bodies[1].joint.axis: found [0, 0, 0], expected a vector that is not zero",
        ),
        (
            |s| s["bodies"][0]["joint"]["axis"] = json!([0, 0, 1]),
            "bodies[0].joint.axis: found an axis, expected none for a fixed joint",
        ),
        (
            |s| s["bodies"][0]["joint"]["rate_max_deg_s"] = json!(1),
            "bodies[0].joint.rate_max_deg_s: found 1, expected none for a fixed joint",
        ),
        (
            |s| s["bodies"][2]["joint"]["angle_max_deg"] = json!(90),
            "bodies[2].joint.angle_max_deg: found 90, expected none for a continuous joint",
        ),
        (
            |s| s["bodies"][1]["joint"]["rate_max_deg_s"] = json!(null),
            "bodies[1].joint.rate_max_deg_s: missing, expected the largest rate, deg/s",
        ),
        (
            |s| s["bodies"][1]["joint"]["angle_min_deg"] = json!(15),
            "initial.joint_angles_deg[0]: found 10, expected 15 to inf",
        ),
        (
            |s| {
                s["bodies"][1]["joint"]["rpy_deg"] = json!([0, 0, 90]);
                s["bodies"][1]["joint"]["rotation"] = json!([1, 0, 0, 0]);
            },
            "bodies[1].joint.rotation: found both rpy_deg and rotation, expected one of them",
        ),
        (
            |s| s["bodies"][1]["joint"]["rotation"] = json!([1, 1, 0, 0]),
            "bodies[1].joint.rotation: found [1, 1, 0, 0], expected a unit quaternion",
        ),
        (
            |s| s["bodies"][1]["mass_kg"] = json!(-1),
            "bodies[1].mass_kg: found -1, expected a number from 0",
        ),
        (
            |s| s["bodies"][1]["inertia_kg_m2"] = json!([[1, 0, 0], [0, 1, 0], [0, 0, 5]]),
            "bodies[1].inertia_kg_m2: found principal moments 1, 1 and 5, expected the largest",
        ),
        (
            |s| s["mount"] = json!({ "position_m": [0, 0, 1] }),
            "bodies: found both mount and bodies, expected either bodies, or links on a mount",
        ),
        (
            |s| s["bodies"] = json!([]),
            "bodies: found 0 bodies, expected an array of 1 to 1000 bodies",
        ),
        (
            |s| {
                for body in [1, 2] {
                    s["bodies"][body]["joint"] = json!({ "type": "fixed" });
                }
            },
            "bodies: found 0 joints that move, expected 1 to 32 joints that move",
        ),
        (
            |s| s["base"] = json!({ "mass_kg": 1, "cube_side_m": 1, "center_of_mass_m": [0, 0, 1], "name": "bus" }),
            "base.center_of_mass_m: found both cube_side_m and center_of_mass_m, expected one of them",
        ),
        (
            |s| s["ignored_pairs"] = json!([["bodies[3]", "bodies[0]"]]),
            "ignored_pairs[0][0]: found \"bodies[3]\", expected",
        ),
        (
            |s| drop(s.as_object_mut().unwrap().remove("bodies")),
            "links: missing, expected the rows",
        ),
    ];
    for (change, expected) in cases {
        let mut system = two_arms();
        change(&mut system);
        let refused = scenario(&system).expect_err(expected).to_string();
        let about = refused.strip_prefix("turn.json: ").unwrap_or_else(|| panic!("{refused}"));
        let about = about.strip_prefix("system.").unwrap_or(about);
        assert!(about.starts_with(expected), "{about}\n  instead of {expected}");
    }
}

#[test]
fn neighbours_are_told_by_the_tree() {
    let mut system = two_arms();
    let capsule =
        json!([{ "capsule": { "from_m": [0, 0, 0], "to_m": [0, 0, 0.4], "radius_m": 0.05 } }]);
    for body in 0..3 {
        system["bodies"][body]["shapes"] = capsule.clone();
    }
    let between = |system: &Value| -> Vec<String> {
        let scenario = scenario(system).unwrap();
        let names = &scenario.system().names;
        scenario.collision().pairs.iter().map(|pair| names.between(&pair.between)).collect()
    };
    // The hand is fixed to its arm; everything keeps off the sphere about the body frame's origin.
    assert_eq!(
        between(&system),
        [
            "left_hand shape 1 and body",
            "left_arm shape 1 and body",
            "right_arm shape 1 and body",
            "left_hand shape 1 and right_arm shape 1",
            "left_arm shape 1 and right_arm shape 1",
        ]
    );
}

/// What is fixed to the base is a part of it, and shares a joint with what turns on the base.
#[test]
fn fixed_bodies_are_parts_of_the_base() {
    let mut system = two_arms();
    let sphere = json!([{ "sphere": { "center_m": [0, 0, 0], "radius_m": 0.05 } }]);
    system["bodies"][0]["shapes"] = sphere.clone();
    system["bodies"][0]["parent"] = json!("bus");
    system["bodies"][2]["shapes"] = sphere;
    let scenario = scenario(&system).unwrap();
    let names = &scenario.system().names;
    let pairs = scenario.collision().pairs.iter().map(|pair| names.between(&pair.between));
    assert_eq!(pairs.collect::<Vec<_>>(), ["right_arm shape 1 and body"]);
    assert_eq!(scenario.system().model.base_body().mass_kg, 102.0);
}
