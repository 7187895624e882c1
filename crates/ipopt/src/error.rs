use crate::{LinearSolverError, NlpError, OptionValue};
use righting_ipopt_sys::LoadError;
use righting_ipopt_sys::hsl::SlotError;
use thiserror::Error;

/// Why a solve was not begun, or came to nothing.
///
/// Not converging is no error but a [`Status`](crate::Status).
#[derive(Debug, Error)]
pub enum SolveError {
    /// The problem, an option or the start is not what it has to be.
    #[error(transparent)]
    Invalid(#[from] NlpError),
    /// An extra option that is a field of [`Options`](crate::Options), or that this crate sets.
    #[error("Ipopt's option `{name}` is not free: {owner}")]
    OptionTaken {
        /// Ipopt's name.
        name: String,
        /// Who sets it.
        owner: String,
    },
    /// Ipopt does not know an option by this name, of this type or with this value.
    #[error("Ipopt refuses the option `{name}` = {value}")]
    OptionRefused {
        /// Ipopt's name.
        name: String,
        /// The value.
        value: OptionValue,
    },
    /// Text for Ipopt ends at a zero byte.
    #[error("option name or value {text:?} has a zero byte")]
    ZeroByte {
        /// The text.
        text: String,
    },
    /// A solve was started from within a solve on the same thread.
    #[error("a solve cannot be started from within another one")]
    Nested,
    /// There is no Ipopt, or another one.
    #[error(transparent)]
    NotLoaded(#[from] LoadError),
    /// This Ipopt calls no linear solver but its own.
    #[error("Ipopt cannot be given a linear solver of one's own")]
    NoLinearSolverSlot(#[source] SlotError),
    /// It was given one, but did not call it.
    #[error("Ipopt was given a linear solver, but does not call it")]
    SlotNotCalled,
    /// The linear solver refused the structure of the system.
    #[error("the linear solver refuses the system")]
    LinearSolver(#[source] LinearSolverError),
    /// `CreateIpoptProblem` gave nothing although every argument was checked.
    #[error("Ipopt could not create the problem")]
    NotCreated,
}
