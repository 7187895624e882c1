use thiserror::Error;

/// Why a problem cannot be transcribed or a start cannot be used. A solve that does not converge
/// is not an error: it is a status of the [`OcpSolution`](crate::OcpSolution).
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum OcpError {
    /// The problem has no state.
    #[error("a control problem needs at least one state")]
    NoStates,
    /// Something has the wrong number of components.
    #[error("{what}: {found} components where {expected} are expected")]
    Dimension {
        /// What has them.
        what: &'static str,
        /// How many it should have.
        expected: usize,
        /// How many it has.
        found: usize,
    },
    /// A lower bound lies above its upper bound, or one of the two is not a number.
    #[error("{what}, component {index}: [{lower}, {upper}] is not an interval")]
    CrossedBounds {
        /// Which bounds.
        what: &'static str,
        /// Which component.
        index: usize,
        /// Its lower bound.
        lower: f64,
        /// Its upper bound.
        upper: f64,
    },
    /// A value that must be finite is not.
    #[error("{what}, component {index}: {value} is not a finite number")]
    NotFinite {
        /// What holds it.
        what: &'static str,
        /// Which component.
        index: usize,
        /// The value.
        value: f64,
    },
    /// A grid without steps or without a positive, finite duration.
    #[error("a grid of {steps} steps over {duration_s} s cannot be used: both must be positive")]
    Grid {
        /// Length of the horizon.
        duration_s: f64,
        /// Number of steps.
        steps: usize,
    },
    /// A traced function could not be compiled.
    #[error("compiling the stage functions: {0}")]
    Function(#[from] righting_symbolic::FunctionError),
    /// Ipopt refused the problem.
    #[error(transparent)]
    Solve(#[from] righting_ipopt::SolveError),
}
