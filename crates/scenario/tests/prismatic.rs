//! Joints that slide: what a scenario says of them, in their own fields and units.

use std::path::Path;

use righting_multibody::Units;
use righting_scenario::file::JointKind;
use righting_scenario::{Error, Scenario};
use serde_json::{Value, json};

/// A base with a joint that slides between two that turn.
fn scenario(change: impl FnOnce(&mut Value)) -> Result<Scenario, Error> {
    let turning = |name: &str, parent: &str| {
        json!({
            "name": name, "parent": parent, "mass_kg": 2,
            "joint": { "type": "revolute", "position_m": [0, 0, 1], "rate_max_deg_s": 10,
                       "acceleration_max_deg_s2": 5, "angle_min_deg": -90, "angle_max_deg": 90 }
        })
    };
    let mut scenario = json!({
        "name": "slide",
        "system": {
            "name": "sliding",
            "base": {
                "name": "bus", "mass_kg": 100, "keep_out_radius_m": 0.1,
                "inertia_kg_m2": [[9, 0, 0], [0, 8, 0], [0, 0, 7]]
            },
            "bodies": [
                turning("shoulder", "bus"),
                {
                    "name": "boom", "parent": "shoulder", "mass_kg": 4,
                    "joint": { "type": "prismatic", "axis": [2, 0, 0], "travel_min_m": 0.5, "travel_max_m": 1.5,
                               "speed_max_m_s": 0.2, "acceleration_max_m_s2": 0.1, "force_max_n": 40 }
                },
                turning("wrist", "boom"),
            ]
        },
        "initial": { "joint_angles_deg": [10, 20], "joint_travels_m": [0.75] },
        "maneuver": { "type": "slew", "axis": [0, 0, 1], "angle_deg": 5 },
        "horizon": { "duration_s": 30, "steps": 30 }
    });
    change(&mut scenario);
    Scenario::parse(&scenario.to_string(), Path::new("slide.json"))
}

#[test]
fn travels_stand_between_angles_in_their_own_unit() {
    let scenario = scenario(|file| {
        file["initial"]["joint_speeds_m_s"] = json!([0.1]);
        file["maneuver"] = json!({ "type": "detumble" });
        file["final"] = json!({ "joint_travels_m": [1.25] });
    })
    .unwrap();
    let (system, initial) = (scenario.system(), scenario.initial());
    let kinds = [JointKind::Revolute, JointKind::Prismatic, JointKind::Revolute];
    assert_eq!(system.model.joint_kinds(), kinds);
    let [ten, twenty] = [10.0_f64, 20.0].map(f64::to_radians);
    assert_eq!(initial.joint_angles_rad, [ten, 0.75, twenty]);
    assert_eq!(initial.joint_rates_rad_s, [0.0, 0.1, 0.0]);
    assert_eq!(scenario.end_angles_rad(), [None, Some(1.25), None]);
    let limits = system.joint_limits[1];
    let found = [limits.angle_min_rad, limits.angle_max_rad, limits.rate_max_rad_s];
    assert_eq!(found, [0.5, 1.5, 0.2]);
    assert_eq!((limits.acceleration_max_rad_s2, limits.torque_max_n_m), (0.1, 40.0));
    // The boom is where it has slid to, from the joint on the shoulder.
    let posture = system.model.kinematics(&initial.joint_angles_rad);
    let boom = posture.frames[2].origin;
    let expected = [0.75 * ten.cos(), 0.75 * ten.sin(), 1.0];
    assert!((boom - nalgebra::Vector3::from(expected)).norm() < 1e-15, "{boom}");
    // The wrist's joint is 1 m above the shoulder's: travels count by that size.
    let size_m = system.model.size_m();
    assert_eq!((size_m, system.radians_a_unit()), (2.0, vec![1.0, 0.5, 1.0]));
    let again = scenario.varied(|_| ()).unwrap();
    assert_eq!(again.resolved().sha256(), scenario.resolved().sha256());
}

#[test]
fn lengths_of_joints_are_measured_too() {
    let scenario = scenario(|_| ()).unwrap();
    let units = Units { length_m: 2.0, mass_kg: 5.0, time_s: 3.0 };
    let measured = scenario.in_units(&units, 1.0).unwrap();
    let limits = measured.system().joint_limits[1];
    assert_eq!((limits.angle_min_rad, limits.angle_max_rad), (0.25, 0.75));
    assert_eq!(measured.initial().joint_angles_rad[1], 0.375);
    assert!((limits.rate_max_rad_s - 0.2 * 3.0 / 2.0).abs() < 1e-15);
    assert!((limits.acceleration_max_rad_s2 - 0.1 * 9.0 / 2.0).abs() < 1e-15);
    // A newton is a kilogram metre a second squared.
    assert!((limits.torque_max_n_m - 40.0 * 9.0 / (5.0 * 2.0)).abs() < 1e-12);
    assert_eq!(measured.system().radians_a_unit()[1], 1.0);
    assert_eq!(measured.system().joint_limits[0].angle_max_rad, 90.0_f64.to_radians());
}

#[test]
fn what_is_wrong_is_named() {
    type Case = (fn(&mut Value), &'static str);
    let cases: [Case; 7] = [
        (
            |s| s["initial"]["joint_angles_deg"] = json!([10, 0, 20]),
            "initial.joint_angles_deg: found an array of 3, expected an array of 2, one a joint that turns",
        ),
        (
            |s| s["initial"] = json!({ "joint_angles_deg": [10, 20] }),
            "initial.joint_travels_m: found an array of 0, expected an array of 1, one a joint that slides",
        ),
        (
            |s| s["initial"]["joint_travels_m"] = json!([0.4]),
            "initial.joint_travels_m[0]: found 0.4, expected 0.5 to 1.5, the limits of boom_joint",
        ),
        (
            |s| s["initial"]["joint_speeds_m_s"] = json!([0.3]),
            "initial.joint_speeds_m_s[0]: found 0.3, expected at most 0.2 in magnitude, the limit of boom_joint",
        ),
        (
            |s| s["final"] = json!({ "joint_travels_m": [2] }),
            "final.joint_travels_m[0]: found 2, expected 0.5 to 1.5, the limits of boom_joint",
        ),
        (
            |s| s["system"]["bodies"][1]["joint"]["travel_max_m"] = json!(1e9),
            "bodies[1].joint.travel_max_m: found 1e9, expected a number from -1e8 to 1e8",
        ),
        (
            |s| s["system"]["bodies"][1]["joint"]["force_max_n"] = json!(-1),
            "bodies[1].joint.force_max_n: found -1, expected a number above 0",
        ),
    ];
    for (change, expected) in cases {
        let message = scenario(change).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}\n{expected}");
    }
}

/// Printed digits may be past a limit by rounding.
#[test]
fn limits_are_widened_to_a_start_past_them_by_rounding_only() {
    let scenario =
        scenario(|file| file["initial"]["joint_travels_m"] = json!([1.500_000_4])).unwrap();
    assert_eq!(scenario.system().joint_limits[1].angle_max_rad, 1.500_000_4);
    let note = &scenario.notes()[0];
    assert!(
        note.contains("bodies[1].joint.travel_max_m: 1.5000004 instead of 1.5: boom_joint"),
        "{note}"
    );
}
