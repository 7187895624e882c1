//! Numbers that were printed with six digits mean what they meant before, with a note; what is off by
//! more is refused.

use std::path::Path;

use nalgebra::Vector3;
use righting_scenario::{Error, Scenario, file};
use righting_test_support::{shipped, varied};

/// A variant of the 4-joint slew, or the complaint about it.
fn slew_with(change: impl FnOnce(&mut file::Scenario)) -> Result<Scenario, Error> {
    let mut file = shipped("slew_4dof").resolved().clone();
    change(&mut file);
    Scenario::from_file(file, Path::new("slew.json"))
}

/// The one note of a scenario.
#[track_caller]
fn note(scenario: &Scenario) -> &str {
    let [note] = scenario.notes() else { panic!("{:?}", scenario.notes()) };
    note
}

#[track_caller]
fn assert_refused(refused: Result<Scenario, Error>, message: &str) {
    let refused = refused.expect_err(message).to_string();
    assert!(refused.contains(message), "`{refused}` does not say `{message}`");
}

fn system(file: &mut file::Scenario) -> &mut file::System {
    let file::SystemReference::Inline(system) = &mut file.system else { panic!("inline") };
    system
}

fn printed(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap()
}

#[test]
fn what_is_exact_has_no_notes() {
    for name in ["slew_2dof", "slew_4dof", "detumble_4dof", "slew_canadarm2", "detumble_canadarm2"]
    {
        assert_eq!(shipped(name).notes(), [""; 0], "{name}");
    }
    let half = 0.5_f64.sqrt();
    let exact = slew_with(|file| file.initial.attitude = Some([half, half, 0.0, 0.0])).unwrap();
    assert_eq!(exact.notes(), [""; 0]);
}

#[test]
fn a_quaternion_of_four_digits_is_one() {
    let half = printed(0.5_f64.sqrt(), 4);
    let wxyz = [half, half, 0.0, 0.0];
    let turned = slew_with(|file| file.initial.attitude = Some(wxyz)).unwrap();
    assert_eq!(
        note(&turned),
        "initial.attitude: its norm is 0.99999041: taken as a unit quaternion, for rounding"
    );
    assert!((turned.initial().attitude.norm_squared() - 1.0).abs() < 1e-15);
    let mounted = slew_with(|file| {
        let system = system(file);
        system.mount.as_mut().unwrap().rotation = Some(wxyz);
        system.base.keep_out_radius_m = Some(0.3);
    })
    .unwrap();
    assert!(note(&mounted).starts_with("system.mount.rotation: its norm is 0.99999041"));
    let axis = mounted.system().model.rows().unwrap().mount.rotation * Vector3::y();
    assert!((axis - Vector3::z()).norm() < 1e-15);

    let long = [1.000_11, 0.0, 0.0, 0.0];
    assert_refused(
        slew_with(|file| file.initial.attitude = Some(long)),
        "initial.attitude: found [1.00011, 0, 0, 0], expected a unit quaternion w, x, y, z",
    );
    assert!(slew_with(|file| file.initial.attitude = Some([1.000_09, 0.0, 0.0, 0.0])).is_ok());
}

#[test]
fn a_limit_that_the_start_is_past_by_rounding_is_widened_to_it() {
    // The limit as a program in single precision prints a round angle.
    let scenario = slew_with(|file| {
        system(file).links[1].angle_max_deg = Some(44.999_637_501_4);
        file.initial.joint_angles_deg[1] = 45.0;
    })
    .unwrap();
    assert_eq!(
        note(&scenario),
        "system.links[1].angle_max_deg: 45 instead of 44.9996375014: joint 2 starts there, past its \
         limit by rounding only"
    );
    let limits = scenario.system().joint_limits[1];
    let start_rad = 45.0_f64.to_radians();
    assert_eq!(limits.angle_max_rad, start_rad);
    assert_eq!(scenario.initial().joint_angles_rad[1], start_rad);
    // Whoever reads the resolved file judges by the same limit, and has nothing to remark.
    assert_eq!(scenario.resolved_system().links[1].angle_max_deg, Some(45.0));
    let again = varied(&scenario, |_| ());
    assert_eq!(again.notes(), [""; 0]);
    assert_eq!(again.system(), scenario.system());

    let below = slew_with(|file| {
        system(file).links[1].angle_min_deg = Some(0.000_5);
        file.initial.joint_angles_deg[1] = 0.0;
    });
    assert_eq!(below.unwrap().system().joint_limits[1].angle_min_rad, 0.0);
    // Of many turns six digits leave more.
    let many_turns = |past_deg: f64| {
        slew_with(|file| {
            system(file).links[0].angle_max_deg = Some(3600.0);
            file.initial.joint_angles_deg[0] = 3600.0 + past_deg;
        })
    };
    assert!(many_turns(0.03).is_ok());
    assert_refused(many_turns(0.04), "the limits of joint 1");
    assert_refused(
        slew_with(|file| file.initial.joint_angles_deg[1] = 90.001_1),
        "initial.joint_angles_deg[1]: found 90.0011, expected -90 to 90, the limits of joint 2",
    );
}

#[test]
fn a_rate_limit_is_widened_likewise() {
    let detumble = |rate_deg_s: f64| {
        let mut file = shipped("detumble_4dof").resolved().clone();
        file.initial.joint_rates_deg_s = Some(vec![0.0, rate_deg_s, 0.0, 0.0]);
        Scenario::from_file(file, Path::new("detumble.json"))
    };
    let scenario = detumble(-17.200_1).unwrap();
    assert!(note(&scenario).starts_with("system.links[1].rate_max_deg_s: 17.2001 instead of 17.2"));
    assert_eq!(scenario.resolved_system().links[1].rate_max_deg_s, 17.2001);
    let limits = scenario.system().joint_limits[1];
    assert_eq!(limits.rate_max_rad_s, -scenario.initial().joint_rates_rad_s[1]);
    assert_refused(detumble(17.2003), "at most 17.2 in magnitude, the limit of joint 2");
}

/// Joint rates, and the base's rate that leaves no momentum, printed with some digits.
fn moving(digits: usize) -> Result<Scenario, Error> {
    let at_rest = shipped("slew_4dof");
    let rates_deg_s = [-6.593_63, 3.414_9, -2.311_71, 5.546_89];
    let q = [0.2, 0.4, -0.3, 0.1];
    let qdot = rates_deg_s.map(f64::to_radians);
    let model = &at_rest.system().model;
    let omega = model.reduced_angular_rate(&q, &qdot, &Vector3::zeros()).map(f64::to_degrees);
    slew_with(|file| {
        file.initial.joint_angles_deg = q.map(|angle| printed(angle.to_degrees(), 17)).to_vec();
        file.initial.joint_rates_deg_s = Some(rates_deg_s.to_vec());
        file.initial.angular_rate_deg_s = Some([0, 1, 2].map(|i| printed(omega[i], digits)));
    })
}

#[test]
fn momentum_that_printed_rates_leave_is_kept_and_noted() {
    assert_eq!(moving(17).unwrap().notes(), [""; 0]);
    let scenario = moving(6).unwrap();
    let note = note(&scenario);
    assert!(note.starts_with("initial.angular_rate_deg_s: the system would turn at "), "{note}");
    assert!(
        note.contains("e-6 deg/s with the arm stopped") || note.contains("e-7 deg/s"),
        "{note}"
    );
    assert!(scenario.initial().angular_momentum_n_m_s.norm() > 0.0);
    assert_refused(moving(3), "a slew ends at rest (it would turn at");
}

#[test]
fn a_clearance_is_lowered_to_what_a_printed_start_has() {
    // Link 2 lies along link 1 but for a few degrees: its end is as near as the clearance.
    let clearance_m = |angle_deg: f64| 0.25 * angle_deg.to_radians().sin();
    let touching = |clearance_m: f64| {
        slew_with(|file| {
            let system = system(file);
            system.base.keep_out_radius_m = Some(0.0);
            system.links[0].body_exempt = false;
            system.links[2].angle_max_deg = Some(179.0);
            file.initial.joint_angles_deg = vec![0.0, 0.0, 176.0, 0.0];
            file.collision.clearance_m = Some(clearance_m);
        })
    };
    let has_m = clearance_m(4.0);
    assert_eq!(touching(has_m * (1.0 - 1e-12)).unwrap().notes(), [""; 0]);
    let scenario = touching(has_m + 5e-6).unwrap();
    let note = note(&scenario);
    assert!(note.starts_with("collision.clearance_m: 0.0174"), "{note}");
    assert!((scenario.collision().clearance_m - has_m).abs() < 1e-12);
    assert_eq!(scenario.resolved().collision.clearance_m, Some(scenario.collision().clearance_m));
    assert_refused(touching(has_m + 5e-5), "expected at least the clearance, 0.0174891 m");
}

#[test]
fn a_joint_with_one_angle_is_locked_there() {
    let locked = |angle_deg: f64, start_deg: f64, rate_deg_s: f64| {
        slew_with(|file| {
            let row = &mut system(file).links[2];
            (row.angle_min_deg, row.angle_max_deg) = (Some(angle_deg), Some(angle_deg));
            file.initial.joint_angles_deg[2] = start_deg;
            file.initial.joint_rates_deg_s = Some(vec![0.0, 0.0, rate_deg_s, 0.0]);
        })
    };
    let scenario = locked(-30.0, -30.0, 0.0).unwrap();
    assert_eq!(scenario.notes(), [""; 0]);
    let system = scenario.system();
    let is_locked: Vec<bool> =
        system.joint_limits.iter().map(|limits| limits.is_locked()).collect();
    assert_eq!(is_locked, [false, false, true, false]);
    for unit in [0.0, 0.3, 1.0] {
        let angles = system.joint_angles_at(&[unit; 4]);
        assert_eq!(angles[2], (-30.0_f64).to_radians());
    }
    let rounded = locked(-30.0, -30.000_4, 0.0).unwrap();
    assert!(note(&rounded).starts_with("system.links[2].angle_min_deg: -30.0004 instead of -30"));
    assert!(rounded.system().joint_limits[2].is_locked());
    assert_eq!(
        rounded.system().joint_limits[2].angle_max_rad,
        rounded.initial().joint_angles_rad[2]
    );
    assert_refused(
        locked(-30.0, -29.0, 0.0),
        "initial.joint_angles_deg[2]: found -29, expected -30, the angle at which joint 3 is locked",
    );
    assert_refused(
        locked(-30.0, -30.0, 0.1),
        "initial.joint_rates_deg_s[2]: found 0.1, expected 0: joint 3 is locked",
    );
}
