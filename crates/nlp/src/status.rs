use std::fmt;

/// How a solve ended: the outcomes that Ipopt tells apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Status {
    /// Converged to the tolerances.
    Solved,
    /// Converged to the acceptable tolerances only.
    Acceptable,
    /// Converged by the optimizer's account, but not by residuals that were computed apart from it.
    Unconfirmed,
    /// Converged to a point where the constraint violation cannot locally be reduced.
    Infeasible,
    /// Steps became as small as rounding errors.
    SearchDirectionTooSmall,
    /// A variable grew without limit.
    Diverging,
    /// The iteration callback asked for it.
    UserStop,
    /// As many equations as variables, and these are solved.
    FeasiblePointFound,
    /// The iteration limit was reached.
    IterationLimit,
    /// The restoration phase found no better point.
    RestorationFailed,
    /// No step could be computed.
    StepComputationFailed,
    /// The limit of processor time was reached.
    CpuTimeLimit,
    /// The limit of wall time was reached (Ipopt 3.14 and newer).
    WallTimeLimit,
    /// More equality constraints than free variables.
    TooFewDegreesOfFreedom,
    /// The optimizer refused the problem.
    InvalidProblem,
    /// The optimizer refused the options together, each of which it accepted.
    InvalidOption,
    /// A function was undefined at the start, or a derivative at an accepted point.
    InvalidNumber,
    /// The [`LinearSolver`](crate::LinearSolver) given failed and the optimizer could not go on.
    LinearSolverFailed,
    /// An exception inside the optimizer.
    Exception,
    /// A C++ exception from outside the optimizer.
    ForeignException,
    /// Memory ran out.
    OutOfMemory,
    /// An internal error of the optimizer.
    InternalError,
    /// A return code that has no name here.
    Unknown(i32),
}

impl Status {
    /// Whether the point satisfies the tolerances, or at least the acceptable ones.
    pub fn is_success(self) -> bool {
        matches!(self, Self::Solved | Self::Acceptable | Self::FeasiblePointFound)
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Solved => "solved",
            Self::Acceptable => "solved to the acceptable tolerances",
            Self::Unconfirmed => "converged by the optimizer's account alone",
            Self::Infeasible => "converged to a locally infeasible point",
            Self::SearchDirectionTooSmall => "search direction too small",
            Self::Diverging => "iterates diverge",
            Self::UserStop => "stopped on request",
            Self::FeasiblePointFound => "feasible point of a square problem found",
            Self::IterationLimit => "iteration limit reached",
            Self::RestorationFailed => "restoration phase failed",
            Self::StepComputationFailed => "no step could be computed",
            Self::CpuTimeLimit => "processor time limit reached",
            Self::WallTimeLimit => "wall time limit reached",
            Self::TooFewDegreesOfFreedom => "more equality constraints than free variables",
            Self::InvalidProblem => "problem refused by the optimizer",
            Self::InvalidOption => "options refused by the optimizer",
            Self::InvalidNumber => "a function could not be evaluated",
            Self::LinearSolverFailed => "linear solver failed",
            Self::Exception => "exception inside the optimizer",
            Self::ForeignException => "foreign exception inside the optimizer",
            Self::OutOfMemory => "out of memory",
            Self::InternalError => "internal error of the optimizer",
            Self::Unknown(code) => return write!(f, "return code {code}"),
        })
    }
}
