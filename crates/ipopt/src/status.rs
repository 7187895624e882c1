use righting_ipopt_sys::ApplicationReturnStatus as Code;
use std::fmt;

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Status {
    /// Converged to the tolerances.
    Solved,
    /// Converged to the acceptable tolerances only.
    Acceptable,
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
    /// Ipopt refused the problem.
    InvalidProblem,
    /// Ipopt refused the options together, each of which it accepted.
    InvalidOption,
    /// A function was undefined at the start, or a derivative at an accepted point.
    InvalidNumber,
    /// The [`LinearSolver`](crate::LinearSolver) given failed and Ipopt could not go on.
    LinearSolverFailed,
    /// An exception inside Ipopt.
    Exception,
    /// A C++ exception from outside Ipopt.
    ForeignException,
    /// Memory ran out.
    OutOfMemory,
    /// An internal error of Ipopt.
    InternalError,
    /// A code that this crate does not know.
    Unknown(i32),
}

impl Status {
    /// Whether the point satisfies the tolerances, or at least the acceptable ones.
    pub fn is_success(self) -> bool {
        matches!(self, Self::Solved | Self::Acceptable | Self::FeasiblePointFound)
    }

    /// Whether Ipopt handed back functions and multipliers along with the point.
    pub(crate) fn brings_functions(self) -> bool {
        matches!(
            self,
            Self::Solved
                | Self::Acceptable
                | Self::Infeasible
                | Self::SearchDirectionTooSmall
                | Self::Diverging
                | Self::UserStop
                | Self::FeasiblePointFound
                | Self::IterationLimit
                | Self::RestorationFailed
                | Self::StepComputationFailed
        )
    }
}

impl From<Code> for Status {
    fn from(code: Code) -> Self {
        match code {
            Code::SOLVE_SUCCEEDED => Self::Solved,
            Code::SOLVED_TO_ACCEPTABLE_LEVEL => Self::Acceptable,
            Code::INFEASIBLE_PROBLEM_DETECTED => Self::Infeasible,
            Code::SEARCH_DIRECTION_BECOMES_TOO_SMALL => Self::SearchDirectionTooSmall,
            Code::DIVERGING_ITERATES => Self::Diverging,
            Code::USER_REQUESTED_STOP => Self::UserStop,
            Code::FEASIBLE_POINT_FOUND => Self::FeasiblePointFound,
            Code::MAXIMUM_ITERATIONS_EXCEEDED => Self::IterationLimit,
            Code::RESTORATION_FAILED => Self::RestorationFailed,
            Code::ERROR_IN_STEP_COMPUTATION => Self::StepComputationFailed,
            Code::MAXIMUM_CPUTIME_EXCEEDED => Self::CpuTimeLimit,
            Code::MAXIMUM_WALLTIME_EXCEEDED => Self::WallTimeLimit,
            Code::NOT_ENOUGH_DEGREES_OF_FREEDOM => Self::TooFewDegreesOfFreedom,
            Code::INVALID_PROBLEM_DEFINITION => Self::InvalidProblem,
            Code::INVALID_OPTION => Self::InvalidOption,
            Code::INVALID_NUMBER_DETECTED => Self::InvalidNumber,
            Code::UNRECOVERABLE_EXCEPTION => Self::Exception,
            Code::NON_IPOPT_EXCEPTION_THROWN => Self::ForeignException,
            Code::INSUFFICIENT_MEMORY => Self::OutOfMemory,
            Code::INTERNAL_ERROR => Self::InternalError,
            Code(other) => Self::Unknown(other),
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Solved => "solved",
            Self::Acceptable => "solved to the acceptable tolerances",
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
            Self::InvalidProblem => "problem refused by Ipopt",
            Self::InvalidOption => "options refused by Ipopt",
            Self::InvalidNumber => "a function could not be evaluated",
            Self::LinearSolverFailed => "linear solver failed",
            Self::Exception => "exception inside Ipopt",
            Self::ForeignException => "foreign exception inside Ipopt",
            Self::OutOfMemory => "out of memory",
            Self::InternalError => "internal error of Ipopt",
            Self::Unknown(code) => return write!(f, "Ipopt's return code {code}"),
        })
    }
}
