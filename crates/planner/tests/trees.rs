//! Plans of systems of bodies.

use righting_ocp::Control;
use righting_planner::Planner;
use righting_scenario::{Scenario, file};
use righting_test_support::{scenarios, varied};

/// The objective of the plan of a shipped scenario on a coarse grid, with the default weights.
fn objective(name: &str) -> f64 {
    let scenario = Scenario::read(&scenarios().join(format!("{name}.json"))).unwrap();
    let scenario = varied(&scenario, |file| {
        file.horizon.steps = 120.0;
        file.weights = file::Weights::default();
        file.end = None;
    });
    let plan = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
    assert!(plan.solution.verification.passed, "{name}: {:?}", plan.solution.verification);
    plan.solution.objective
}

/// The same arm as rows of a table and as bodies on joints.
#[test]
fn an_arm_of_bodies_has_the_optimum_of_its_rows() {
    let [rows, bodies] = ["slew_4dof", "real/slew_4dof_bodies"].map(objective);
    assert!((rows / bodies - 1.0).abs() < 1e-6, "{rows} {bodies}");
}
