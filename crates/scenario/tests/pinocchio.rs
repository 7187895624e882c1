//! Shipped trees agree with Pinocchio, another group's rigid-body library, which was given their bodies one by
//! one: a base with two arms, and an arm with a joint that slides.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use righting_multibody::{State, System};
use righting_scenario::SystemDescription;
use righting_test_support::scenarios;
use serde::Deserialize;

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
        assert!(error <= 1e-11, "{what}[{i}]: {ours} is {error:.1e} off {theirs}");
    }
}

fn check(name: &str, system: &System, sample: &Sample) {
    let state = State::from_slice(&sample.x).unwrap();
    let State { attitude, angular_rate, joint_angles: q, joint_rates: qdot, .. } = &state;
    let label = |what: &str| format!("{name}: {what}");
    let theirs = State::from_slice(&sample.xdot).unwrap();
    let ours = State::from_slice(&system.state_derivative(&sample.x, &sample.u, None)).unwrap();
    assert_close(&label("r''"), ours.velocity.as_slice(), theirs.velocity.as_slice());
    assert_close(&label("q_BN'"), &ours.attitude.to_array(), &theirs.attitude.to_array());
    assert_close(&label("omega'"), ours.angular_rate.as_slice(), theirs.angular_rate.as_slice());

    let momentum = system.angular_momentum(angular_rate, q, qdot);
    assert_close(&label("H"), momentum.as_slice(), &sample.angular_momentum_body);
    let map = system.momentum_map(q);
    let rates = nalgebra::DVector::from_column_slice(qdot);
    let by_map = map.inertia * angular_rate + &map.joint_columns * rates;
    assert_close(&label("H by its map"), by_map.as_slice(), &sample.angular_momentum_body);
    let linear = system.linear_momentum(&state);
    assert_close(&label("P"), linear.as_slice(), &sample.linear_momentum_inertial);
    let center = system.inertial_center_of_mass(&state);
    assert_close(&label("center of mass"), center.as_slice(), &sample.center_of_mass_inertial);
    let torques = system.joint_torques(angular_rate, q, qdot, &sample.u, None);
    assert_close(&label("torque"), &torques, &sample.joint_torque);
    let h_body = attitude.to_body(&Vector3::from(sample.angular_momentum_inertial));
    let reduced = system.reduced_angular_rate(q, qdot, &h_body);
    assert_close(&label("reduced omega"), reduced.as_slice(), angular_rate.as_slice());
}

#[test]
fn shipped_trees_agree_with_pinocchio() {
    let reference: Reference =
        serde_json::from_str(include_str!("data/tree_dynamics.json")).unwrap();
    assert_eq!(reference.systems.len(), 2);
    for (name, samples) in &reference.systems {
        let file = scenarios().join(format!("systems/{name}.json"));
        let system = SystemDescription::read(&file).unwrap().model;
        assert!(samples.len() >= 12);
        for sample in samples {
            check(name, &system, sample);
        }
    }
}
