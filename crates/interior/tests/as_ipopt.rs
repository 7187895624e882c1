//! The same iterates as Ipopt, on problems of which the solution is published.

mod common;

use common::support::assert_close;
use common::support::hock_schittkowski::*;
use common::{fast, ipopt, own};
use righting_ipopt::*;

/// What an iteration reports, by name.
fn numbers(iteration: &Iteration) -> [(&'static str, f64); 8] {
    [
        ("objective", iteration.objective),
        ("primal infeasibility", iteration.primal_infeasibility),
        ("dual infeasibility", iteration.dual_infeasibility),
        ("mu", iteration.mu),
        ("step", iteration.step_norm),
        ("regularization", iteration.regularization),
        ("primal step length", iteration.alpha_primal),
        ("dual step length", iteration.alpha_dual),
    ]
}

/// Every number of every iteration, the trial counts, and the solution agree. Returns the
/// iterations.
#[track_caller]
fn agree<F: Functions>(
    problem: impl Fn() -> Dense<F>,
    options: &Options,
    start: &Start,
) -> Vec<Iteration> {
    let name = F::NAME;
    let (theirs, expected) = ipopt(problem(), options, start);
    let (ours, found) = own(problem(), options, start);
    let (expected, found) = (expected.unwrap(), found.unwrap());
    assert_eq!(ours.len(), theirs.len(), "{name}");
    for (a, b) in ours.iter().zip(&theirs) {
        assert_eq!(a.line_search_trials, b.line_search_trials, "{name}, iteration {}", b.iteration);
        for ((what, a), (_, b_value)) in numbers(a).into_iter().zip(numbers(b)) {
            // Rounding grows along the way, and what is left of an infeasibility is rounding itself.
            let grown = (1e-11 * 2_f64.powi(b.iteration as i32)).min(1e-4);
            let allowed = grown * b_value.abs() + 1e-9;
            let iteration = b.iteration;
            assert!(
                (a - b_value).abs() <= allowed,
                "{name}, {iteration}: {what} {a} not {b_value}"
            );
        }
    }
    assert_eq!((found.status, found.iterations), (expected.status, expected.iterations), "{name}");
    assert_close(&[found.objective], &[expected.objective], 1e-9);
    assert_close(&found.x, &expected.x, 1e-7);
    assert_close(&found.g, &expected.g, 1e-7);
    let (found, expected) = (found.multipliers, expected.multipliers);
    assert_close(&found.constraints, &expected.constraints, 1e-6);
    assert_close(&found.lower, &expected.lower, 1e-6);
    assert_close(&found.upper, &expected.upper, 1e-6);
    ours
}

/// From each problem's published start.
fn agree_on_all(options: &Options) -> Vec<Iteration> {
    fn on<F: Functions>(problem: impl Fn() -> Dense<F>, options: &Options) -> Vec<Iteration> {
        agree(problem, options, &Start::at(F::START.to_vec()))
    }
    [
        on(|| Dense(Hs006), options),
        on(|| Dense(Hs035), options),
        on(|| Dense(Hs038), options),
        on(|| Dense(Hs040), options),
        on(|| Dense(Hs071), options),
        on(|| Dense(Hs100), options),
    ]
    .concat()
}

#[test]
fn every_iterate_is_that_of_ipopt() {
    let iterations = agree_on_all(&fast());
    // The parts of the method that the problems are to exercise.
    assert!(iterations.iter().any(|iteration| iteration.regularization > 0.0));
    assert!(iterations.iter().any(|iteration| iteration.line_search_trials > 2));
    assert!(iterations.iter().any(|iteration| iteration.alpha_dual < 1.0));
}

#[test]
fn so_it_is_with_other_options() {
    agree_on_all(&Options { max_soc: 0, ..fast() });
    agree_on_all(&Options { watchdog_shortened_iter_trigger: 1, ..fast() });
    agree_on_all(&Options {
        watchdog_shortened_iter_trigger: 1,
        watchdog_trial_iter_max: 8,
        max_soc: 0,
        ..fast()
    });
    agree_on_all(&Options { accept_after_max_steps: 1, ..fast() });
    agree_on_all(&Options { mu_init: 1e-4, tolerance: 1e-6, barrier_tol_factor: 1.0, ..fast() });
    agree_on_all(&Options {
        bound_mult_init_method: MultiplierInitialization::MuBased,
        bound_push: 1e-4,
        bound_frac: 1e-4,
        ..fast()
    });
    agree_on_all(&Options { nlp_scaling_max_gradient: 1.0, ..fast() });
    agree_on_all(&Options { nlp_scaling: NlpScaling::None, constr_mult_init_max: 0.0, ..fast() });
    agree_on_all(&Options { max_iterations: 4, ..fast() });
}

#[test]
fn so_it_is_from_a_warm_start() {
    let near = |x: &[f64]| x.iter().map(|x| x + 1e-2).collect();
    let solved = ipopt(Dense(Hs071), &fast(), &Start::at(Hs071::START.to_vec())).1.unwrap();
    let start = Start { x: near(&solved.x), ..solved.to_start() };
    for mu_init in [1e-2, 1e-6] {
        agree(|| Dense(Hs071), &Options { mu_init, ..fast() }, &start);
        let push = 1e-9;
        let options = Options {
            mu_init,
            warm_start_bound_push: push,
            warm_start_bound_frac: push,
            warm_start_slack_bound_push: push,
            warm_start_slack_bound_frac: push,
            warm_start_mult_bound_push: push,
            nlp_scaling_max_gradient: 1.0,
            ..fast()
        };
        agree(|| Dense(Hs071), &options, &start);
    }
    let solved = ipopt(Dense(Hs100), &fast(), &Start::at(Hs100::START.to_vec())).1.unwrap();
    let start = Start { x: near(&solved.x), ..solved.to_start() };
    agree(|| Dense(Hs100), &Options { mu_init: 1e-3, ..fast() }, &start);
}

#[test]
fn the_caller_may_stop_it() {
    let start = Start::at(Hs071::START.to_vec());
    let mut seen = 0;
    let mut solver = BunchKaufman::default();
    let solution =
        righting_interior::solve(&mut Dense(Hs071), &fast(), &start, &mut solver, |iteration| {
            seen += 1;
            if iteration.iteration == 3 { Control::Stop } else { Control::Continue }
        })
        .unwrap();
    assert_eq!((solution.status, solution.iterations, seen), (Status::UserStop, 3, 4));
}
