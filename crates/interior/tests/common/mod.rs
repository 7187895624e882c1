//! One problem solved by Ipopt and by this crate, with the same linear solver.
#![allow(dead_code)]

#[path = "../../../ipopt/tests/support/mod.rs"]
pub mod support;

use righting_interior::InteriorError;
use righting_ipopt::*;

/// Every iteration, and the end.
pub type Run<T, E> = (Vec<Iteration>, Result<T, E>);

/// Ipopt's options, with what this crate asks for.
pub fn fast() -> Options {
    Options { fast_step_computation: true, ..Options::default() }
}

pub fn ipopt(
    mut problem: impl Problem,
    options: &Options,
    start: &Start,
) -> Run<NlpSolution, SolveError> {
    let mut iterations = Vec::new();
    let mut solver = BunchKaufman::default();
    let outcome = solve_with(&mut problem, options, start, &mut solver, |iteration| {
        iterations.push(*iteration);
        Control::Continue
    });
    (iterations, outcome)
}

pub fn own(
    mut problem: impl Problem,
    options: &Options,
    start: &Start,
) -> Run<NlpSolution, InteriorError> {
    let mut iterations = Vec::new();
    let mut solver = BunchKaufman::default();
    let outcome =
        righting_interior::solve(&mut problem, options, start, &mut solver, |iteration| {
            iterations.push(*iteration);
            Control::Continue
        });
    (iterations, outcome)
}
