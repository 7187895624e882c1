use righting_ocp::Samples;
use righting_scenario::Scenario;
use righting_scenario::collision::Between;
use righting_scenario::file::{Formulation, SystemReference};
use righting_test_support::thin_links::pendulum;
use righting_test_support::varied;

use super::{PassedLimits, passed_limits};
use crate::formulation::{Clearances, Cones, Coordinates, Loads};

/// What a motion of the joints from the scenario's start passes, one second a step.
fn passed(scenario: &Scenario, accelerations: &[Vec<f64>]) -> PassedLimits {
    let coordinates = Coordinates::new(scenario, Formulation::Reduced);
    let joints = scenario.system().joint_count();
    let (mut states, mut controls) = (Samples::new(coordinates.dimension()), Samples::new(joints));
    let mut angles = scenario.initial().joint_angles_rad.clone();
    let mut rates = vec![0.0; joints];
    // The base has no part in it.
    let state = |angles: &[f64], rates: &[f64]| [&[1.0, 0.0, 0.0, 0.0], angles, rates].concat();
    states.push(&state(&angles, &rates));
    for u in accelerations {
        for joint in 0..joints {
            angles[joint] += rates[joint] + 0.5 * u[joint];
            rates[joint] += u[joint];
        }
        states.push(&state(&angles, &rates));
        controls.push(u);
    }
    let kept = (&Clearances::new(scenario), &Loads::new(scenario), &Cones::new(scenario));
    let joint_limits = &scenario.system().joint_limits;
    passed_limits(joint_limits, kept, &coordinates, &states, &controls, 1.0)
}

/// From 60° on the one side to 60° on the other, at constant rate in the middle of three steps.
fn swing() -> Vec<Vec<f64>> {
    let push = 60.0_f64.to_radians();
    [push, 0.0, -push].map(|u| vec![0.0, 0.0, 0.0, u]).to_vec()
}

#[test]
fn links_that_pass_through_each_other_between_nodes_are_found() {
    let scenario = pendulum(1.9);
    let passed = passed(&scenario, &swing());
    assert!(passed.joints.is_empty());
    let clearances = Clearances::new(&scenario);
    assert_eq!(passed.clearances.len(), 1, "{passed:?}");
    let (&place, clearance) = passed.clearances.first_key_value().unwrap();
    assert_eq!(clearances.between(place), Between::links(0, 3));
    assert!(clearance.is_crossing);
    assert!(clearance.parts > 2, "{clearance:?}");
    assert!(passed.is_crossing());
}

#[test]
fn nearly_what_the_verifier_lets_pass_may_be_lacking() {
    let passes = |gap_m: f64| !passed(&pendulum(3.0_f64.sqrt() - gap_m), &swing()).is_empty();
    assert!(!passes(0.02));
    assert!(!passes(0.0092));
    assert!(passes(0.009));
    let grazing = passed(&pendulum(3.0_f64.sqrt() - 0.008), &swing());
    assert!(!grazing.is_crossing() && grazing.clearances.len() == 1, "{grazing:?}");
}

#[test]
fn a_joint_that_turns_back_between_nodes_is_followed_to_the_turn() {
    let to_angle = |most_rad: f64| {
        let scenario = varied(&pendulum(0.5), |file| {
            let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
            system.links[1].angle_max_deg = Some(120.0 + most_rad.to_degrees());
        });
        // After 1 s the joint is at 0.05 rad with 0.1 rad/s; braked at 0.2 rad/s² it turns back half a
        // second later at 0.075 rad.
        passed(&scenario, &[0.1, -0.2, 0.1].map(|u| vec![0.0, u, 0.0, 0.0])).joints
    };
    assert!(to_angle(0.076).is_empty());
    assert!(to_angle(0.0742).is_empty());
    assert_eq!(to_angle(0.074).into_iter().collect::<Vec<_>>(), [1]);
}
