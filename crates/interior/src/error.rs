use std::time::Duration;

use righting_nlp::{LinearSolverError, NlpError};
use thiserror::Error;

/// A solve that ended without an answer. It says nothing about the problem: Ipopt, which has a
/// restoration phase, may well solve it.
#[derive(Debug, Error)]
#[error("{reason}, after {iterations} iterations")]
pub struct InteriorError {
    /// Why.
    #[source]
    pub reason: FailureReason,
    /// How many iterations were made until then.
    pub iterations: usize,
    /// The wall time they took.
    pub time: Duration,
}

/// Why a solve ended without an answer.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FailureReason {
    /// An option, or the problem, asks for something that the method does not have.
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
    Invalid(#[from] NlpError),
    /// A function or derivative is not defined where a step cannot be shortened.
    #[error("a function is not defined at the start, or a derivative at an accepted point")]
    Undefined,
    /// The linear solver does not take the system.
    #[error("the linear solver refuses the system")]
    LinearSolver(#[source] LinearSolverError),
    /// No regularisation gave the augmented system the right inertia, or the search direction was
    /// not finite.
    #[error("no search direction could be computed")]
    StepComputation,
    /// No step length was acceptable: Ipopt would enter its restoration phase.
    #[error("no acceptable step length, as before a restoration phase")]
    RestorationNeeded,
    /// Two search directions in a row were as small as rounding errors.
    #[error("search directions have become as small as rounding errors")]
    TinySteps,
}
