//! A plan of the very problem is gone on from; one of another is a start among others.

use righting_ocp::Control;
use righting_planner::Planner;
use righting_test_support::{shipped, varied};

#[test]
fn a_plan_of_the_very_problem_takes_two_iterations_and_no_coarse_start() {
    for name in
        ["slew_2dof", "slew_4dof", "detumble_4dof", "slew_canadarm2_table", "detumble_canadarm2"]
    {
        let scenario = shipped(name);
        let first = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
        let mut planner = Planner::new().warm_start(&first.trajectory);
        let again = planner.plan(&scenario, &mut |_| Control::Continue).unwrap().solution;
        println!("{name}: {} iterations", again.iterations);
        assert!(again.verification.passed, "{name}");
        assert!(again.attempts.iter().all(|attempt| attempt.steps == 600), "{name}");
        assert!(again.iterations <= 2, "{name}: {} iterations", again.iterations);
        let change = (again.objective / first.solution.objective - 1.0).abs();
        assert!(change < 1e-6, "{name}: the objective changes by {change}");
    }
}

#[test]
fn a_plan_of_another_angle_is_one_start_of_several() {
    let scenario = shipped("slew_2dof");
    let first = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
    let wider = varied(&scenario, |file| file.maneuver.angle_deg = Some(24.0));
    let mut planner = Planner::new().warm_start(&first.trajectory);
    let other = planner.plan(&wider, &mut |_| Control::Continue).unwrap().solution;
    assert!(other.verification.passed);
    assert!(other.attempts.iter().any(|attempt| attempt.steps < 600));
}
