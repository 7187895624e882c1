//! Clearances between two samples.

use std::path::Path;

use proptest::prelude::*;
use righting_results::{Check, Trajectory, Verification};
use righting_scenario::collision::Clearance;
use righting_scenario::{Scenario, file};
use righting_test_support::arms::arm;
use righting_test_support::bodies::bodies;
use righting_test_support::motion;
use righting_test_support::thin_links::pendulum;
use righting_verifier::verify;

const LINKS: &str = "clearance between links between nodes";
const BODY: &str = "clearance from body between nodes";
/// What the arms that move keep, m. They may miss a tenth of it between nodes, and a thousandth of their
/// size at the most.
const CLEARANCE_M: f64 = 0.02;

/// The pendulum's swing from 60° on the one side to 60° on the other, at constant rate in the middle of
/// three steps.
fn swung(scenario: &Scenario) -> Trajectory {
    let push = 60.0_f64.to_radians();
    motion(scenario, &[push, 0.0, -push].map(|u| vec![0.0, 0.0, 0.0, u]))
}

fn check<'a>(verification: &'a Verification, name: &str) -> &'a Check {
    verification.check(name).unwrap_or_else(|| panic!("no check is called {name}"))
}

/// The distances that are kept by the planner's model, at `samples` places in every interval, as what is
/// past the least one: between links and from the body.
fn sampled_excess(scenario: &Scenario, plan: &Trajectory, samples: usize) -> [f64; 2] {
    let model = &scenario.system().model;
    let mut worst = [f64::NEG_INFINITY; 2];
    let step_s = scenario.horizon().step_s();
    for (node, interval) in plan.nodes().iter().zip(plan.intervals()) {
        for sample in 1..=samples {
            let after_s = step_s * sample as f64 / (samples + 1) as f64;
            let angles: Vec<f64> = (0..model.joint_count())
                .map(|joint| {
                    let gained = interval.joint_accelerations_rad_s2[joint] * after_s;
                    let rate = node.joint_rates_rad_s[joint] + 0.5 * gained;
                    node.joint_angles_rad[joint] + rate * after_s
                })
                .collect();
            let posture = model.kinematics(&angles);
            for pair in &scenario.collision().pairs {
                let which = usize::from(pair.between.off_base().is_some());
                let Clearance { distance_m, least_m, .. } = pair.clearance(&posture);
                // Inside a box, theirs says how deep.
                let distance_m = distance_m.max(-pair.covered_m());
                worst[which] = worst[which].max(least_m - distance_m);
            }
        }
    }
    worst
}

#[test]
fn links_that_pass_through_each_other_between_two_samples_are_caught() {
    let scenario = pendulum(1.9);
    let plan = swung(&scenario);
    // Ten places an interval see nothing: the nearest are 8 cm before and behind.
    assert!(sampled_excess(&scenario, &plan, 10)[0] < -0.05);
    let verification = verify(&scenario, &plan);
    let caught = check(&verification, LINKS);
    assert!(!caught.passed, "{caught}");
    assert_eq!(caught.subject.as_deref(), Some("links 1 and 4"));
    assert!((caught.time_s.unwrap() - 1.5).abs() < 1e-3, "{caught}");
    assert!(caught.value < 1e-4, "{caught}");
    assert!(check(&verification, "clearance between links at nodes").passed);
}

/// A pendulum that is just too short to touch, or just not.
#[test]
fn the_tolerance_parts_those_that_pass_from_those_that_do_not() {
    let reach_m = 3.0_f64.sqrt();
    let off_by_m = |gap_m: f64| {
        let scenario = pendulum(reach_m - gap_m);
        let verification = verify(&scenario, &swung(&scenario));
        check(&verification, LINKS).passed
    };
    // 0.01 m are asked.
    assert!(off_by_m(0.02));
    assert!(off_by_m(0.01));
    assert!(off_by_m(0.0091));
    assert!(!off_by_m(0.0089));
    assert!(!off_by_m(0.001));
    assert!(!off_by_m(0.0));
}

/// Every arm moves from rest to rest by controls of its own, past shapes of the base or not.
fn moving_arm() -> impl Strategy<Value = (Scenario, Trajectory)> {
    let pushes = prop::collection::vec(prop::collection::vec(-1.0..1.0_f64, 3), 6);
    (arm(2..=6), pushes, prop::option::of(bodies())).prop_filter_map(
        "a start that keeps its clearances",
        |(scenario, pushes, bodies)| {
            let mut file = scenario.resolved().clone();
            file.horizon = file::Horizon { duration_s: file::Duration::Given(6.0), steps: 6.0 };
            file.collision.clearance_m = Some(CLEARANCE_M);
            file.initial.joint_angles_deg.iter_mut().zip(0..).for_each(|(angle, joint)| {
                *angle = 50.0 * f64::from(joint % 3) - 40.0;
            });
            if let Some(bodies) = bodies {
                bodies.give(&mut file);
            }
            let scenario = Scenario::from_file(file, Path::new("moving arm.json")).ok()?;
            let joints = scenario.system().joint_count();
            let control = |k: usize| (0..joints).map(|joint| pushes[joint][k]).collect();
            let there: Vec<Vec<f64>> = (0..3).map(control).collect();
            let back = there.iter().rev().map(|u| u.iter().map(|u| -u).collect());
            let controls: Vec<Vec<f64>> = there.iter().cloned().chain(back).collect();
            let plan = motion(&scenario, &controls);
            Some((scenario, plan))
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    /// What thousands of samples find, the verifier knows, and where it finds more, so do they, nearly.
    #[test]
    fn nothing_is_missed_and_nothing_is_made_up((scenario, plan) in moving_arm()) {
        let verification = verify(&scenario, &plan);
        let tolerance_m = (0.1 * CLEARANCE_M).min(1e-3 * scenario.system().model.size_m());
        let dense = sampled_excess(&scenario, &plan, 1000);
        for (name, dense) in [(LINKS, dense[0]), (BODY, dense[1])] {
            let Some(found) = verification.check(name) else { continue };
            let excess = found.limit - found.value;
            prop_assert_eq!(found.passed, excess <= tolerance_m);
            if found.passed {
                prop_assert!(dense <= tolerance_m + 1e-9, "{}: {} where {} is", name, excess, dense);
            } else {
                prop_assert!(dense >= excess - 3e-3, "{}: {} where {} is", name, excess, dense);
                prop_assert!(dense <= excess + 2e-4, "{}: {} where {} is", name, excess, dense);
            }
        }
    }
}
