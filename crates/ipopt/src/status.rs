//! Ipopt's return codes.

use crate::Status;
use righting_ipopt_sys::ApplicationReturnStatus as Code;

/// The status that a return code says.
pub(crate) fn status(code: Code) -> Status {
    match code {
        Code::SOLVE_SUCCEEDED => Status::Solved,
        Code::SOLVED_TO_ACCEPTABLE_LEVEL => Status::Acceptable,
        Code::INFEASIBLE_PROBLEM_DETECTED => Status::Infeasible,
        Code::SEARCH_DIRECTION_BECOMES_TOO_SMALL => Status::SearchDirectionTooSmall,
        Code::DIVERGING_ITERATES => Status::Diverging,
        Code::USER_REQUESTED_STOP => Status::UserStop,
        Code::FEASIBLE_POINT_FOUND => Status::FeasiblePointFound,
        Code::MAXIMUM_ITERATIONS_EXCEEDED => Status::IterationLimit,
        Code::RESTORATION_FAILED => Status::RestorationFailed,
        Code::ERROR_IN_STEP_COMPUTATION => Status::StepComputationFailed,
        Code::MAXIMUM_CPUTIME_EXCEEDED => Status::CpuTimeLimit,
        Code::MAXIMUM_WALLTIME_EXCEEDED => Status::WallTimeLimit,
        Code::NOT_ENOUGH_DEGREES_OF_FREEDOM => Status::TooFewDegreesOfFreedom,
        Code::INVALID_PROBLEM_DEFINITION => Status::InvalidProblem,
        Code::INVALID_OPTION => Status::InvalidOption,
        Code::INVALID_NUMBER_DETECTED => Status::InvalidNumber,
        Code::UNRECOVERABLE_EXCEPTION => Status::Exception,
        Code::NON_IPOPT_EXCEPTION_THROWN => Status::ForeignException,
        Code::INSUFFICIENT_MEMORY => Status::OutOfMemory,
        Code::INTERNAL_ERROR => Status::InternalError,
        Code(other) => Status::Unknown(other),
    }
}

/// Whether Ipopt handed back functions and multipliers along with the point.
pub(crate) fn brings_functions(status: Status) -> bool {
    matches!(
        status,
        Status::Solved
            | Status::Acceptable
            | Status::Infeasible
            | Status::SearchDirectionTooSmall
            | Status::Diverging
            | Status::UserStop
            | Status::FeasiblePointFound
            | Status::IterationLimit
            | Status::RestorationFailed
            | Status::StepComputationFailed
    )
}
