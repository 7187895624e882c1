//! Who ends a solve: the callback, or a panic in any code of the user's.

mod support;

use righting_ipopt::*;
use std::panic::panic_any;
use support::hock_schittkowski::*;
use support::meddling::{Meddling, Method, Mischief};
use support::{assert_close, caught, solve_from};

fn start() -> Start {
    Start::at(Hs071::START.to_vec())
}

fn go_on(_: &Iteration) -> Control {
    Control::Continue
}

#[test]
fn every_iteration_is_reported() {
    let mut iterations = Vec::new();
    let solution = solve(&mut Dense(Hs071), &Options::default(), &start(), |iteration| {
        iterations.push(*iteration);
        Control::Continue
    })
    .unwrap();

    let counts: Vec<usize> = iterations.iter().map(|iteration| iteration.iteration).collect();
    assert_eq!(counts, (0..=solution.iterations).collect::<Vec<_>>());
    assert_eq!(iterations.last().copied(), solution.last_iteration);
    assert_eq!(solution.timing.evaluation.iteration.calls, iterations.len());

    let (first, last) = (iterations[0], solution.last_iteration.unwrap());
    assert_close(&[first.objective], &[Hs071::objective(&[1.01, 4.96, 4.96, 1.01])], 0.05);
    assert_close(&[last.objective], &[solution.objective], 1e-12);
    assert_eq!(first.mu, 0.1);
    assert!(last.mu < 1e-8 && last.primal_infeasibility < 1e-8 && last.dual_infeasibility < 1e-8);
    assert!(iterations[1..].iter().all(|iteration| {
        let step = 0.0..=1.0;
        step.contains(&iteration.alpha_primal)
            && step.contains(&iteration.alpha_dual)
            && iteration.line_search_trials >= 1
            && iteration.step_norm > 0.0
            && !iteration.restoration
    }));
}

#[test]
fn the_callback_stops_the_solve() {
    let solution = solve(&mut Dense(Hs071), &Options::default(), &start(), |iteration| {
        if iteration.iteration == 3 { Control::Stop } else { Control::Continue }
    })
    .unwrap();
    assert_eq!(solution.status, Status::UserStop);
    assert_eq!(solution.iterations, 3);
    assert_eq!(solution.objective, Hs071::objective(&solution.x));
    assert_close(&solution.g, &Hs071::constraints(&solution.x), 1e-14);
}

#[test]
fn a_panic_in_the_problem_goes_on_after_the_solve() {
    let methods = [
        Method::Objective,
        Method::Gradient,
        Method::Constraints,
        Method::Jacobian,
        Method::Hessian,
    ];
    for method in methods {
        for call in [0, 2] {
            let mut problem = Meddling::new(Dense(Hs071), |called, count, _: &[f64]| {
                if called == method && count == call { Mischief::Panic } else { Mischief::None }
            });
            let found: Method =
                caught(|| solve(&mut problem, &Options::default(), &start(), go_on));
            assert_eq!(found, method);
            assert_eq!(problem.calls[method as usize], call + 1, "it was called again");
            // Neither the lock nor Ipopt was left in a bad state.
            let solution = solve_from(&mut problem.inner, Hs071::START, &Options::default());
            assert_eq!(solution.status, Status::Solved);
        }
    }
}

#[test]
fn a_panic_in_the_callback_goes_on_after_the_solve() {
    let found: u8 = caught(|| {
        solve(&mut Dense(Hs071), &Options::default(), &start(), |iteration| {
            if iteration.iteration == 2 { panic_any(42_u8) } else { Control::Continue }
        })
    });
    assert_eq!(found, 42);
}
