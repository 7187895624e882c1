//! Agreement with Pinocchio, another group's rigid-body library.

mod support;

use nalgebra::Vector3;
use righting_multibody::{State, System};
use serde::Deserialize;
use std::collections::BTreeMap;
use support::table_one;

#[derive(Deserialize)]
struct Reference {
    systems: BTreeMap<String, Vec<Sample>>,
}

#[derive(Deserialize)]
struct Sample {
    x: Vec<f64>,
    u: Vec<f64>,
    xdot: Vec<f64>,
    angular_momentum_body: [f64; 3],
    angular_momentum_inertial: [f64; 3],
    linear_momentum_inertial: [f64; 3],
    center_of_mass_inertial: [f64; 3],
    joint_torque: Vec<f64>,
}

/// Relative to the largest element of the vector.
fn assert_close(what: &str, ours: &[f64], theirs: &[f64]) {
    assert_eq!(ours.len(), theirs.len(), "{what}");
    let scale = theirs.iter().fold(0.0_f64, |scale, value| scale.max(value.abs()));
    for (i, (ours, theirs)) in ours.iter().zip(theirs).enumerate() {
        let error = (ours - theirs).abs() / scale;
        assert!(error <= 1e-10, "{what}[{i}]: {ours} is {error:.1e} off {theirs}");
    }
}

fn check(name: &str, system: &System, sample: &Sample) {
    let State { attitude, angular_rate, joint_angles: q, joint_rates: qdot, .. } =
        &State::from_slice(&sample.x).unwrap();
    let state = &State::from_slice(&sample.x).unwrap();

    let xdot = system.state_derivative(&sample.x, &sample.u, None);
    let theirs = State::from_slice(&sample.xdot).unwrap();
    let ours = State::from_slice(&xdot).unwrap();
    let label = |what: &str| format!("{name}: {what}");
    assert_close(&label("r'"), ours.position.as_slice(), theirs.position.as_slice());
    assert_close(&label("q_BN'"), &ours.attitude.to_array(), &theirs.attitude.to_array());
    assert_close(&label("r''"), ours.velocity.as_slice(), theirs.velocity.as_slice());
    assert_close(&label("omega'"), ours.angular_rate.as_slice(), theirs.angular_rate.as_slice());
    assert_close(&label("q'"), &ours.joint_angles, &theirs.joint_angles);
    assert_close(&label("q''"), &ours.joint_rates, &theirs.joint_rates);

    let momentum = system.angular_momentum(angular_rate, q, qdot);
    assert_close(&label("H"), momentum.as_slice(), &sample.angular_momentum_body);
    let inertial = system.inertial_angular_momentum(state);
    assert_close(&label("H inertial"), inertial.as_slice(), &sample.angular_momentum_inertial);
    let linear = system.linear_momentum(state);
    assert_close(&label("P"), linear.as_slice(), &sample.linear_momentum_inertial);
    let center = system.inertial_center_of_mass(state);
    assert_close(&label("centre of mass"), center.as_slice(), &sample.center_of_mass_inertial);
    let torques = system.joint_torques(angular_rate, q, qdot, &sample.u, None);
    assert_close(&label("torque"), &torques, &sample.joint_torque);

    let h_body = attitude.to_body(&Vector3::from(sample.angular_momentum_inertial));
    let reduced = system.reduced_angular_rate(q, qdot, &h_body);
    assert_close(&label("reduced omega"), reduced.as_slice(), angular_rate.as_slice());
}

#[test]
fn agrees_with_pinocchio() {
    let text = include_str!("data/dynamics.json");
    let reference: Reference = serde_json::from_str(text).unwrap();
    assert_eq!(reference.systems.len(), 2);
    for (name, samples) in &reference.systems {
        let table = table_one::all();
        let (_, system) = table.iter().find(|(known, _)| known == name).expect("a known system");
        assert!(samples.len() >= 12);
        for sample in samples {
            check(name, system, sample);
        }
    }
}
