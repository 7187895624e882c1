//! Solves that are stopped on their way: what they deliver is proven, or nothing is delivered.

use std::time::Duration;

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_results::Status;
use righting_scenario::Scenario;
use righting_scenario::file::{Guess, NamedGuess};
use righting_test_support::{shipped, varied};
use righting_verifier::verify;

/// The plan of a solve that is stopped after so many iterations of all that it shows; one thread shows the same
/// ones every time.
fn stopped_after(scenario: &Scenario, iterations: usize) -> Planned {
    let mut left = iterations;
    let mut planner = Planner::new().threads(std::num::NonZeroUsize::MIN);
    let planned = planner.plan(scenario, &mut |_| {
        left = left.saturating_sub(1);
        if left == 0 { Control::Stop } else { Control::Continue }
    });
    planned.expect("a plan, stopped or not")
}

/// A slew that is solved from the constant guess, on the asked grid alone.
fn constant_slew() -> Scenario {
    varied(&shipped("slew_4dof"), |file| {
        file.solver.guess = Some(Guess::Named(NamedGuess::Constant));
        file.horizon.steps = 60.0;
    })
}

/// Iterations on the asked grid are stopped one by one: with a constant guess there are no others.
#[test]
fn the_last_iterates_of_a_slew_are_plans_before_it_has_converged() {
    let scenario = constant_slew();
    let optimum = stopped_after(&scenario, usize::MAX).solution;
    assert_eq!(optimum.status, Status::Solved);
    let mut plans = 0;
    for iterations in 1..optimum.iterations {
        let Planned { solution, trajectory } = stopped_after(&scenario, iterations);
        assert_eq!(solution.status, Status::Interrupted, "{iterations}");
        assert!(!solution.status.is_acceptable());
        assert_eq!(solution.has_plan(), solution.verification.passed, "{iterations}");
        if !solution.has_plan() {
            assert!(solution.verification.checks.is_empty(), "{iterations}");
            continue;
        }
        plans += 1;
        assert!(verify(&scenario, &trajectory).passed, "{iterations}");
        // It is the optimum of a problem whose end may be missed by as much as the verification allows.
        assert!(solution.objective > 0.9 * optimum.objective, "{iterations}");
        assert!(solution.notes.iter().any(|note| note.starts_with("not optimal")), "{iterations}");
    }
    assert!(plans > 2, "{plans} of {} iterates", optimum.iterations);
}

#[test]
fn an_iteration_limit_delivers_what_passes_every_check() {
    let scenario = constant_slew();
    let optimum = stopped_after(&scenario, usize::MAX).solution;
    let limited = |iterations: usize| {
        varied(&scenario, |file| file.solver.max_iterations = Some(iterations as f64))
    };
    // The very last iterates before the optimum are solutions by their residuals already.
    let (limited, planned) = (1..optimum.iterations)
        .rev()
        .map(|iterations| {
            let limited = limited(iterations);
            let planned = stopped_after(&limited, usize::MAX);
            (limited.clone(), planned)
        })
        .find(|(_, planned)| planned.solution.status == Status::IterationLimit)
        .expect("the first iterate is not acceptable");
    let Planned { solution, trajectory } = planned;
    assert!(solution.has_plan() && verify(&limited, &trajectory).passed);
    let ratio = solution.objective / optimum.objective;
    assert!((0.9..1.2).contains(&ratio), "{ratio}");
    let residuals = solution.optimality.expect("computed");
    assert!(residuals.complementarity > 1e-6, "{residuals:?}");
}

#[test]
fn a_time_that_is_over_at_once_leaves_no_plan_that_is_none() {
    for name in ["slew_canadarm2", "detumble_4dof"] {
        let scenario = shipped(name);
        let mut planner = Planner::new().time_limit(Duration::ZERO);
        let planned = planner.plan(&scenario, &mut |_| Control::Continue).expect("a plan or none");
        assert_eq!(planned.solution.status, Status::TimeLimit, "{name}");
        assert_eq!(planned.solution.has_plan(), verify(&scenario, &planned.trajectory).passed);
    }
}

/// To do nothing keeps every limit of a detumble, and is no plan.
#[test]
fn a_detumble_that_takes_nothing_out_is_not_delivered() {
    let scenario = varied(&shipped("detumble_4dof"), |file| {
        file.solver.guess = Some(Guess::Named(NamedGuess::Constant));
    });
    let planned = stopped_after(&scenario, 1);
    assert!(!planned.solution.has_plan());
    let reduction = planned.solution.reduction_percent.expect("a detumble");
    assert!(reduction.abs() < 1e-6, "{reduction}");
}
