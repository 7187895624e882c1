//! Replans leave no memory behind, and the workspace that they share does not grow.

#[path = "../../symbolic/tests/counting/mod.rs"]
mod counting;

use counting::allocations;
use righting_multibody::Quaternion;
use righting_ocp::Control;
use righting_planner::{Measured, Planner, Replanner};
use righting_test_support::{shipped, varied};

/// What replans work in is made with the first, and later ones allocate no more than earlier ones.
#[test]
fn replans_do_not_allocate_more_and_more() {
    let scenario = varied(&shipped("slew_4dof"), |file| file.horizon.steps = 100.0);
    let plan = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap().trajectory;
    let mut replanner = Replanner::new(&scenario, &plan).unwrap();
    let node = &plan.nodes()[5];
    let mut replanned = |half_turn: f64| {
        let turn = Quaternion::from_array([half_turn.cos(), 0.0, half_turn.sin(), 0.0]);
        let measured = Measured {
            attitude: Quaternion::from_array(node.attitude).product(&turn).normalized(),
            joint_angles_rad: &node.joint_angles_rad,
            joint_rates_rad_s: &node.joint_rates_rad_s,
        };
        let before = allocations();
        let replan =
            replanner.replan(5, &measured, None).unwrap().expect("a replan that converges");
        assert!(replan.iterations > 0);
        allocations() - before
    };
    let counts: Vec<_> =
        (0..12).map(|k| replanned(if k % 2 == 0 { 2e-3 } else { -2e-3 })).collect();
    let (first, rest) = counts.split_at(4);
    assert!(rest.iter().max() <= first.iter().max(), "{counts:?}");
    // The factorisation of each node alone is four vectors.
    assert!(rest.iter().all(|&count| count < 4 * 100), "{counts:?}");
}
