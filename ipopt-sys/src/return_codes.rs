use std::ffi::c_int;

/// How a solve ended (`enum ApplicationReturnStatus`).
///
/// Not a Rust enum: a newer library may return a value that is not listed here.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ApplicationReturnStatus(pub c_int);

impl ApplicationReturnStatus {
    /// Converged to `tol`.
    pub const SOLVE_SUCCEEDED: Self = Self(0);
    /// Converged to the acceptable tolerances only.
    pub const SOLVED_TO_ACCEPTABLE_LEVEL: Self = Self(1);
    /// Converged to a stationary point of the infeasibility.
    pub const INFEASIBLE_PROBLEM_DETECTED: Self = Self(2);
    /// No further progress: the step is of the size of rounding errors.
    pub const SEARCH_DIRECTION_BECOMES_TOO_SMALL: Self = Self(3);
    /// A variable grew beyond `diverging_iterates_tol`.
    pub const DIVERGING_ITERATES: Self = Self(4);
    /// The intermediate callback returned false.
    pub const USER_REQUESTED_STOP: Self = Self(5);
    /// A square problem was solved for feasibility.
    pub const FEASIBLE_POINT_FOUND: Self = Self(6);
    /// `max_iter` iterations were made.
    pub const MAXIMUM_ITERATIONS_EXCEEDED: Self = Self(-1);
    /// The restoration phase found no point acceptable to the filter.
    pub const RESTORATION_FAILED: Self = Self(-2);
    /// No usable search direction, or an error in the linear solver.
    pub const ERROR_IN_STEP_COMPUTATION: Self = Self(-3);
    /// `max_cpu_time` was used up.
    pub const MAXIMUM_CPUTIME_EXCEEDED: Self = Self(-4);
    /// `max_wall_time` was used up (Ipopt 3.14 and newer).
    pub const MAXIMUM_WALLTIME_EXCEEDED: Self = Self(-5);
    /// More equality constraints than free variables.
    pub const NOT_ENOUGH_DEGREES_OF_FREEDOM: Self = Self(-10);
    /// Ipopt refused the problem.
    pub const INVALID_PROBLEM_DEFINITION: Self = Self(-11);
    /// Ipopt refused an option.
    pub const INVALID_OPTION: Self = Self(-12);
    /// A function could not be evaluated where it had to be, or gave NaN or infinity.
    pub const INVALID_NUMBER_DETECTED: Self = Self(-13);
    /// An Ipopt exception that nobody caught.
    pub const UNRECOVERABLE_EXCEPTION: Self = Self(-100);
    /// A C++ exception from outside Ipopt.
    pub const NON_IPOPT_EXCEPTION_THROWN: Self = Self(-101);
    /// Memory ran out.
    pub const INSUFFICIENT_MEMORY: Self = Self(-102);
    /// A bug in Ipopt, or a fatal error in the linear solver.
    pub const INTERNAL_ERROR: Self = Self(-199);
}

/// Which algorithm an iteration belongs to (`enum AlgorithmMode`).
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct AlgorithmMode(pub c_int);

impl AlgorithmMode {
    /// The main algorithm.
    pub const REGULAR: Self = Self(0);
    /// The restoration phase, which minimises the constraint violation.
    pub const RESTORATION_PHASE: Self = Self(1);
}
