//! Problems with published solutions, and a linear solver that shares nothing with MUMPS.
#![allow(dead_code)]

pub mod counting;
pub mod hock_schittkowski;
pub mod meddling;
pub mod quadratic;

use righting_ipopt::*;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Options and a start at `x`, to the end.
pub fn solve_from<P: Problem>(problem: &mut P, x: &[f64], options: &Options) -> NlpSolution {
    solve(problem, options, &Start::at(x.to_vec()), |_| Control::Continue).unwrap()
}

/// Fails unless the vectors agree entry by entry, absolutely and relatively to 1.
#[track_caller]
pub fn assert_close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} against {expected:?}");
    for (a, b) in found.iter().zip(expected) {
        let difference = (a - b).abs();
        assert!(difference <= tolerance * b.abs().max(1.0), "{found:?} is not {expected:?}");
    }
}

/// The payload of the panic that `solve` must not have swallowed.
#[track_caller]
pub fn caught<T>(solve: impl FnOnce() -> Result<NlpSolution, SolveError>) -> T
where
    T: Copy + 'static,
{
    let payload = catch_unwind(AssertUnwindSafe(solve)).expect_err("the panic was swallowed");
    *payload.downcast_ref().expect("another panic")
}
