//! What motors draw against a drive by hand, and against where the energy goes.

use righting_analysis::motors::{Braking, Losses};
use righting_analysis::{Motors, PowerProfile};
use righting_scenario::Drive;
use righting_scenario::drive::Motor;
use righting_test_support::{motion, shipped, varied};

const DRIVE: Drive = Drive {
    viscous_friction_n_m_s: 0.4,
    rotor_inertia_kg_m2: 2e-5,
    gear_ratio: 100.0,
    gear_efficiency: 0.7,
    motor: Some(Motor { torque_constant_n_m_a: 0.037, resistance_ohm: 0.98 }),
    idle_power_w: 1.5,
    holding_power_w: None,
};

/// Joints that speed up, one after the other turning back, and end moving.
fn moving(name: &str) -> PowerProfile {
    let scenario = varied(&shipped(name), |file| {
        file.horizon.duration_s = righting_scenario::file::Duration::Given(6.0);
        file.horizon.steps = 60.0;
    });
    let joints = scenario.system().joint_count();
    let control = |step: usize| -> Vec<f64> {
        let of_joint = |joint: usize| {
            let turns_at = 20 + 10 * (joint % 3);
            if step < turns_at { 0.04 } else { -0.03 }
        };
        (0..joints).map(of_joint).collect()
    };
    let controls: Vec<Vec<f64>> = (0..60).map(control).collect();
    PowerProfile::new(&scenario, &motion(&scenario, &controls)).unwrap()
}

/// What comes from the source is work, heat, and what the rotors hold at the end.
#[test]
fn no_energy_is_lost() {
    for name in ["slew_2dof", "slew_4dof", "detumble_4dof"] {
        let profile = moving(name);
        let joints = profile.peak_torques_n_m().len();
        let motors = Motors::new(&vec![DRIVE; joints], &profile).unwrap();
        let Losses { windings_j, gears_j, friction_j, standing_j } = motors.losses();
        assert!((standing_j - 6.0 * 1.5 * joints as f64).abs() < 1e-9);
        assert!(windings_j > 0.0 && gears_j > 0.0 && friction_j > 0.0);
        let last = profile.instants().last().unwrap();
        let squares: f64 = last.joint_rates_rad_s.iter().map(|rate| rate * rate).sum();
        let rotors_j = 0.5 * DRIVE.reflected_inertia_kg_m2() * squares;
        assert!(rotors_j > 1e-6, "{name}: rotors at rest show nothing");
        let spent_j = profile.work_j() + rotors_j + windings_j + gears_j + friction_j + standing_j;
        let drawn_j = motors.consumption(Braking::FedBack).energy_j;
        assert!((spent_j - drawn_j).abs() < 1e-9 * drawn_j, "{name}: {spent_j} J of {drawn_j} J");
        assert!(motors.consumption(Braking::Burnt).energy_j > drawn_j);
    }
}

/// Each term of a motor that drives and of one that brakes, by the textbook.
#[test]
fn one_motor_by_hand() {
    let profile = moving("slew_2dof");
    let motors = Motors::new(&[DRIVE; 2], &profile).unwrap();
    let Motor { torque_constant_n_m_a: k, resistance_ohm: r } = DRIVE.motor.unwrap();
    let (mut drives, mut brakes) = (0, 0);
    let mut peak_a: f64 = 0.0;
    for (instant, drawn_w) in profile.instants().iter().zip(motors.drawn_w(Braking::FedBack)) {
        let mut expected_w = 0.0;
        for joint in 0..2 {
            let rate = instant.joint_rates_rad_s[joint];
            let output = instant.joint_torques_n_m[joint] + 0.4 * rate;
            let passed = if output * rate >= 0.0 {
                drives += 1;
                output / (100.0 * 0.7)
            } else {
                brakes += 1;
                output * 0.7 / 100.0
            };
            let current = (passed + 100.0 * 2e-5 * instant.joint_accelerations_rad_s2[joint]) / k;
            expected_w += current * (r * current + k * 100.0 * rate) + 1.5;
            if joint == 0 {
                peak_a = peak_a.max(current.abs());
            }
        }
        assert!((drawn_w - expected_w).abs() < 1e-12 * expected_w.abs(), "{drawn_w} {expected_w}");
    }
    assert!(drives > 50 && brakes > 50, "{drives} driving, {brakes} braking");
    assert!((motors.peak_currents_a()[0] - peak_a).abs() < 1e-12 * peak_a);
}

/// A joint that never moves takes its brake's power instead of its motor's.
#[test]
fn a_joint_that_stands_still_is_held() {
    let scenario = shipped("slew_2dof");
    let controls = vec![vec![0.0; 2]; scenario.horizon().steps];
    let profile = PowerProfile::new(&scenario, &motion(&scenario, &controls)).unwrap();
    let held = Drive { holding_power_w: Some(2.0), ..DRIVE };
    let motors = Motors::new(&[held, DRIVE], &profile).unwrap();
    let used = motors.consumption(Braking::Burnt);
    assert!((used.mean_w - 5.0).abs() < 1e-12, "{}", used.mean_w);
}

#[test]
fn without_a_motor_there_is_nothing_to_count() {
    let profile = moving("slew_2dof");
    assert_eq!(Motors::new(&[DRIVE, Drive::default()], &profile), None);
}
