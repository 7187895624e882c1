//! Ipopt's line-search interior-point method (Wächter & Biegler, *Mathematical Programming* 106,
//! 2006) for programs so small, or solved so often, that Ipopt's own bookkeeping would cost more
//! than evaluating and factorising them: of a program with 300 variables three quarters of its time.
//!
//! It takes [`Problem`]s, [`Options`] and [`LinearSolver`]s of [`righting_ipopt`] and goes the way
//! that Ipopt goes with `fast_step_computation`, iterate by iterate up to rounding: monotone barrier
//! parameter, filter, second-order corrections, watchdog, regularisation by inertia. It has no
//! restoration phase. Where Ipopt would enter one, and wherever else it does not know how to go on,
//! it [gives up](GivesUp), for Ipopt to solve the problem instead.
#![forbid(unsafe_code)]

mod barrier;
mod filter;
mod line_search;
mod method;
mod program;
mod start;
mod system;

pub use method::{Solved, solve};

use righting_ipopt::{LinearSolverError, SolveError};

/// Why a solve ended without an answer. None of it says anything about the problem: Ipopt may well
/// solve it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GivesUp {
    /// An option asks for something that the method does not have.
    #[error("{0} is not supported")]
    Unsupported(&'static str),
    /// A variable has equal bounds.
    #[error("variable {index} is fixed")]
    FixedVariable {
        /// Which.
        index: usize,
    },
    /// The problem, the start or an option is not what it has to be.
    #[error(transparent)]
    Invalid(#[from] SolveError),
    /// A function or derivative is not defined where a step cannot be shortened.
    #[error("a function is not defined at the start, or a derivative at an accepted point")]
    Undefined,
    /// The linear solver does not take the system.
    #[error("the linear solver refuses the system")]
    LinearSolver(#[source] LinearSolverError),
    /// No regularisation gave a step.
    #[error("no step could be computed")]
    NoStep,
    /// No step length was acceptable: Ipopt would enter its restoration phase.
    #[error("no point along the step is acceptable")]
    NeedsRestoration,
    /// Two steps in a row were as small as rounding errors.
    #[error("steps have become as small as rounding errors")]
    TinySteps,
}

/// Numbers compared at a time: a chain of single comparisons would wait for each.
const LANES: usize = 8;

/// The maximum norm; not a number if an entry is not.
pub(crate) fn largest(values: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (chunks, rest) = values.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane = larger(*lane, value.abs());
        }
    }
    rest.iter().map(|value| value.abs()).chain(lanes).fold(0.0, larger)
}

/// The larger size; not a number if one is not.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}
