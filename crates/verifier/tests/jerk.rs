//! Motions with linear accelerations: followed exactly, and caught where they jump or change too fast.

use std::f64::consts::TAU;

use righting_results::Verification;
use righting_scenario::Scenario;
use righting_scenario::file::{self, SystemReference};
use righting_test_support::{motion_of_jerks, shipped, tampered, varied};
use righting_verifier::verify;

const JERK_MAX_DEG_S3: f64 = 2.0;
const STEPS: usize = 100;

fn scenario(change: impl FnOnce(&mut file::System)) -> Scenario {
    varied(&shipped("detumble_4dof"), |file| {
        file.horizon.steps = STEPS as f64;
        file.horizon.duration_s = file::Duration::Given(5.0);
        let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
        system.links[1].jerk_max_deg_s3 = Some(JERK_MAX_DEG_S3);
        change(system);
    })
}

/// Jerks of whole cosine waves over the maneuver: accelerations come back to zero.
fn waves() -> Vec<Vec<f64>> {
    let largest = (0.9 * JERK_MAX_DEG_S3).to_radians();
    let row = |k: usize| -> Vec<f64> {
        let phase = TAU * (k as f64 + 0.5) / STEPS as f64;
        (1..=4).map(|waves| largest * (f64::from(waves) * phase).cos()).collect()
    };
    (0..STEPS).map(row).collect()
}

/// The checks that failed, but those of what the end shall reach.
fn caught(verification: &Verification) -> Vec<&str> {
    let names = verification.failures().map(|check| check.name.as_str());
    let of_end = ["angular rate at the end", "joint rate at the end"];
    names.filter(|name| !of_end.contains(name) && !name.contains("clearance")).collect()
}

#[test]
fn a_motion_with_linear_accelerations_is_followed() {
    let scenario = scenario(|_| {});
    let motion = motion_of_jerks(&scenario, &waves());
    let verification = verify(&scenario, &motion);
    assert!(caught(&verification).is_empty(), "{:?}", caught(&verification));
    let jerk = verification.check("joint jerk").unwrap();
    assert_eq!(jerk.subject.as_deref(), Some("joint 2"));
    assert!((jerk.value / jerk.limit - 0.9).abs() < 1e-2, "{jerk}");
    // Without the jerks the same table is another motion.
    let held = tampered(&motion, |_, intervals| {
        intervals.iter_mut().for_each(|interval| interval.joint_jerks_rad_s3.clear());
    });
    let verification = verify(&scenario, &held);
    let names = caught(&verification);
    assert!(names.contains(&"joint rate mismatch"), "{names:?}");
    assert!(names.contains(&"jump of joint acceleration at nodes"), "{names:?}");
}

#[test]
fn jerks_jumps_and_ends_are_caught() {
    let lower = scenario(|system| system.links[1].jerk_max_deg_s3 = Some(1.5));
    let names = |scenario: &Scenario, jerks: &[Vec<f64>]| -> Vec<String> {
        let verification = verify(scenario, &motion_of_jerks(scenario, jerks));
        caught(&verification).iter().map(ToString::to_string).collect()
    };
    assert_eq!(names(&lower, &waves()), ["joint jerk"]);
    let asked = scenario(|_| {});
    let mut open_end = waves();
    open_end[STEPS - 1][0] += 1e-2;
    assert_eq!(names(&asked, &open_end), ["joint acceleration at start and end"]);
    let jumping = tampered(&motion_of_jerks(&asked, &waves()), |_, intervals| {
        intervals[40].joint_accelerations_rad_s2[3] += 1e-3;
    });
    let verification = verify(&asked, &jumping);
    let jump = verification.check("jump of joint acceleration at nodes").unwrap();
    assert!(!jump.passed && (jump.value - 1e-3).abs() < 1e-9, "{jump}");
    assert_eq!(jump.subject.as_deref(), Some("joint 4"));
}

/// A rate that peaks between two nodes.
#[test]
fn a_parabola_of_a_rate_is_followed_to_its_peak() {
    let still = varied(&shipped("slew_4dof"), |file| {
        file.horizon.steps = 3.0;
        file.horizon.duration_s = file::Duration::Given(3.0);
        let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
        system.links[1].jerk_max_deg_s3 = Some(20.0);
    });
    // The rate of joint 2 is ½ J t² (1 s), then J (½ + s − s²), the largest half a second into the second step.
    let jerk = 2.0_f64.to_radians();
    let row = |jerk: f64| vec![0.0, jerk, 0.0, 0.0];
    let motion = motion_of_jerks(&still, &[row(jerk), row(-2.0 * jerk), row(jerk)]);
    let verification = verify(&still, &motion);
    let rate = verification.check("joint rate between nodes").unwrap();
    assert!((rate.value - 0.75 * jerk).abs() < 1e-9, "{rate}");
    assert!((rate.time_s.unwrap() - 1.5).abs() < 1e-9, "{rate}");
}
