//! Where a maneuver shall end: a target attitude, and the posture of the arm.

use std::path::Path;

use nalgebra::Vector3;
use righting_multibody::Quaternion;
use righting_scenario::file::{ManeuverType, SystemReference};
use righting_scenario::{Error, Maneuver, Scenario, Slew, file, schema};
use righting_test_support::json_schema::violation;
use righting_test_support::shipped;

fn varied(name: &str, change: impl FnOnce(&mut file::Scenario)) -> Result<Scenario, Error> {
    let mut file = shipped(name).resolved().clone();
    change(&mut file);
    Scenario::from_file(file, Path::new("plan.json"))
}

/// A slew of the 4-joint arm to an attitude.
fn to_attitude(start: [f64; 4], target: [f64; 4]) -> Result<Scenario, Error> {
    varied("slew_4dof", |file| {
        file.initial.attitude = Some(start);
        file.maneuver.axis = None;
        file.maneuver.angle_deg = None;
        file.maneuver.target_attitude = Some(target);
    })
}

fn slew(scenario: &Scenario) -> &Slew {
    let Maneuver::Slew(slew) = scenario.maneuver() else { panic!("a slew") };
    slew
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found} instead of {expected}");
}

#[track_caller]
fn assert_refused(refused: Result<Scenario, Error>, message: &str) {
    let refused = refused.expect_err(message).to_string();
    assert!(refused.contains(message), "`{refused}` does not say `{message}`");
}

#[test]
fn an_attitude_says_the_same_as_an_axis_and_an_angle() {
    let start = Quaternion::from_array([0.5, -0.5, 0.5, 0.5]);
    let axis = Vector3::new(0.6, 0.0, -0.8);
    let target = start.product(&Quaternion::from_axis_angle(&axis, 0.7));
    for sign in [1.0, -1.0] {
        let scenario =
            to_attitude(start.to_array(), target.to_array().map(|entry| sign * entry)).unwrap();
        let slew = slew(&scenario);
        assert_close((slew.axis - axis).norm(), 0.0);
        assert_close(slew.angle_rad, 0.7);
        assert!(slew.target.angle_to(&target) < 1e-12);
        let (axis_in_file, angle_deg) = scenario.resolved().slew_axis_and_angle_deg().unwrap();
        assert_close((Vector3::from(axis_in_file) - axis).norm(), 0.0);
        assert_close(angle_deg, 0.7_f64.to_degrees());
    }
    assert_eq!(
        shipped("slew_4dof").resolved().slew_axis_and_angle_deg(),
        Some(([0.74, 0.02, 0.68], 20.0))
    );
    assert_eq!(shipped("detumble_4dof").resolved().slew_axis_and_angle_deg(), None);
}

#[test]
fn the_start_s_own_attitude_is_a_target() {
    let scenario = to_attitude([0.6, 0.0, 0.8, 0.0], [-0.6, 0.0, -0.8, 0.0]).unwrap();
    assert_eq!(slew(&scenario).angle_rad, 0.0);
    assert_close(slew(&scenario).axis.norm(), 1.0);
}

#[test]
fn a_target_of_four_digits_is_taken_with_a_note() {
    let half = (0.5_f64.sqrt() * 1e4).round() / 1e4;
    let scenario = to_attitude([1.0, 0.0, 0.0, 0.0], [half, half, 0.0, 0.0]).unwrap();
    let expected = "maneuver.target_attitude: its norm is 0.99999041: taken as a unit quaternion, for rounding";
    assert_eq!(scenario.notes(), [expected]);
    assert_close(slew(&scenario).angle_rad, std::f64::consts::FRAC_PI_2);
}

#[test]
fn a_target_that_is_no_attitude_or_one_too_many_is_refused() {
    let identity = [1.0, 0.0, 0.0, 0.0];
    for target in [[0.0; 4], [1.0, 1.0, 0.0, 0.0], [f64::NAN, 0.0, 0.0, 1.0], [0.99, 0.0, 0.0, 0.0]]
    {
        assert_refused(to_attitude(identity, target), "maneuver.target_attitude");
    }
    let beside = |axis, angle_deg| {
        varied("slew_4dof", |file| {
            file.maneuver.axis = axis;
            file.maneuver.angle_deg = angle_deg;
            file.maneuver.target_attitude = Some(identity);
        })
    };
    let axis = Some([1.0, 0.0, 0.0]);
    let message =
        "maneuver.target_attitude: found an attitude beside axis and angle_deg, expected either";
    assert_refused(beside(axis, Some(3.0)), message);
    assert_refused(beside(axis, None), "beside axis, expected");
    assert_refused(beside(None, Some(3.0)), "beside angle_deg, expected");
    let neither = varied("slew_4dof", |file| {
        file.maneuver.axis = None;
        file.maneuver.angle_deg = None;
    });
    assert_refused(
        neither,
        "maneuver.axis: missing, expected the axis of the slew, with angle_deg, or target_attitude",
    );
    let detumble = varied("detumble_4dof", |file| file.maneuver.target_attitude = Some(identity));
    assert_refused(
        detumble,
        "maneuver.target_attitude: found an attitude, expected none for a detumble",
    );
}

/// The 4-joint slew with a posture at the end.
fn ending_at(angles_deg: &[Option<f64>]) -> Result<Scenario, Error> {
    varied("slew_4dof", |file| {
        file.end = Some(file::End {
            hard: None,
            joint_angles_deg: Some(angles_deg.to_vec()),
            ..file::End::default()
        });
    })
}

#[test]
fn joints_may_be_asked_to_end_somewhere() {
    let scenario = ending_at(&[None, Some(30.0), None, Some(-20.0)]).unwrap();
    let asked = [None, Some(30f64.to_radians()), None, Some(-(20f64.to_radians()))];
    assert_eq!(scenario.end_angles_rad(), asked);
    assert_eq!(scenario.desired_joint_angles_rad(), asked.map(Option::unwrap_or_default));
    let text = serde_json::to_string(scenario.resolved()).unwrap();
    assert!(text.contains(r#""joint_angles_deg":[null,30.0,null,-20.0]"#), "{text}");
    let again = Scenario::parse(&text, Path::new("plan.json")).unwrap();
    assert_eq!(again, scenario);
    assert_eq!(shipped("slew_4dof").end_angles_rad(), [None; 4]);
}

#[test]
fn an_end_that_the_arm_cannot_have_is_refused() {
    let field = "final.joint_angles_deg";
    assert_refused(
        ending_at(&[None; 3]),
        "final.joint_angles_deg: found an array of 3, expected an array of 4",
    );
    for (joint, angle_deg, allowed) in [
        (1, 91.0, "-90 to 90, the limits of joint 2"),
        (2, -50.1, "-50 to 50, the limits of joint 3"),
        (0, f64::NAN, "a number from"),
        (3, f64::INFINITY, "a number from"),
    ] {
        let mut angles = [None; 4];
        angles[joint] = Some(angle_deg);
        assert_refused(ending_at(&angles), &format!("{field}[{joint}]"));
        assert_refused(ending_at(&angles), allowed);
    }
    let locked = |angle_deg| {
        varied("slew_4dof", |file| {
            let SystemReference::Inline(system) = &mut file.system else { panic!("inline") };
            system.links[3].angle_min_deg = Some(0.0);
            system.links[3].angle_max_deg = Some(0.0);
            let angles = vec![None, None, None, Some(angle_deg)];
            file.end = Some(file::End {
                hard: None,
                joint_angles_deg: Some(angles),
                ..file::End::default()
            });
        })
    };
    locked(0.0).unwrap();
    assert_refused(locked(5.0), "expected 0, the angle at which joint 4 is locked");
}

#[test]
fn an_end_in_collision_is_refused_where_the_given_joints_decide_it() {
    // Bent back at once, links 2 and 3 lie along the body.
    let down = Some(90.0);
    assert_refused(
        ending_at(&[None, down, Some(50.0), Some(35.0)]),
        "final.joint_angles_deg: found an end with link ",
    );
    // Where a free joint may still part them, nothing is decided.
    ending_at(&[None, None, Some(50.0), Some(35.0)]).unwrap();
}

#[test]
fn the_schema_takes_one_target_of_each_kind() {
    let schema = schema::scenario_schema();
    let file = |change: &dyn Fn(&mut file::Scenario)| {
        let mut file = shipped("slew_4dof").resolved().clone();
        change(&mut file);
        serde_json::to_value(file).unwrap()
    };
    let attitude = |file: &mut file::Scenario| {
        file.maneuver.axis = None;
        file.maneuver.angle_deg = None;
        file.maneuver.target_attitude = Some([1.0, 0.0, 0.0, 0.0]);
    };
    assert_eq!(violation(&schema, &file(&attitude)), None);
    let both =
        |file: &mut file::Scenario| file.maneuver.target_attitude = Some([1.0, 0.0, 0.0, 0.0]);
    assert!(violation(&schema, &file(&both)).is_some());
    let detumble = |file: &mut file::Scenario| {
        attitude(file);
        file.maneuver.kind = ManeuverType::Detumble;
    };
    assert!(violation(&schema, &file(&detumble)).is_some());
    let posture = |file: &mut file::Scenario| {
        file.end = Some(file::End {
            hard: None,
            joint_angles_deg: Some(vec![None, Some(1.0), None, None]),
            ..file::End::default()
        });
    };
    assert_eq!(violation(&schema, &file(&posture)), None);
}
