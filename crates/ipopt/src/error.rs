use crate::LinearSolverError;
use std::fmt;
use thiserror::Error;

/// Why a solve was not begun, or came to nothing.
///
/// Not converging is no error but a [`Status`](crate::Status).
#[derive(Debug, Error)]
pub enum SolveError {
    /// There is nothing to solve for.
    #[error("the problem has no variables")]
    NoVariables,
    /// Ipopt counts with 32 bits.
    #[error("{count} {what} are more than Ipopt can count")]
    TooMany {
        /// What there are too many of.
        what: &'static str,
        /// How many.
        count: usize,
    },
    /// A structure has not as many row as column indices.
    #[error("the {matrix} structure has {rows} row indices but {columns} column indices")]
    UnevenStructure {
        /// Which matrix.
        matrix: Matrix,
        /// The number of row indices.
        rows: usize,
        /// The number of column indices.
        columns: usize,
    },
    /// A structure has an entry outside of the matrix.
    #[error(
        "entry {entry} of the {matrix} structure, at ({row}, {column}), is outside of the \
         {height} × {width} matrix"
    )]
    EntryOutOfRange {
        /// Which matrix.
        matrix: Matrix,
        /// Number of the entry.
        entry: usize,
        /// Its row.
        row: i32,
        /// Its column.
        column: i32,
        /// The number of rows of the matrix.
        height: usize,
        /// The number of columns of the matrix.
        width: usize,
    },
    /// The Hessian is given by its lower triangle.
    #[error(
        "entry {entry} of the Hessian structure, at ({row}, {column}), is in the upper triangle"
    )]
    UpperTriangle {
        /// Number of the entry.
        entry: usize,
        /// Its row.
        row: i32,
        /// Its column.
        column: i32,
    },
    /// A pair of bounds is NaN, the wrong way round, or an infinity on the wrong side.
    #[error("{vector} {index} cannot lie between {lower} and {upper}")]
    ImpossibleBounds {
        /// Variables or constraints.
        vector: VectorName,
        /// Which of them.
        index: usize,
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
    /// A vector does not fit the problem.
    #[error("{found} entries of the {vector} where the problem needs {expected}")]
    WrongLength {
        /// Which vector.
        vector: VectorName,
        /// What the problem needs.
        expected: usize,
        /// What was given.
        found: usize,
    },
    /// A number is NaN, infinite, or outside of what its vector allows.
    #[error("entry {index} of the {vector} is {value}; {allowed} is allowed")]
    BadNumber {
        /// Which vector.
        vector: VectorName,
        /// Which entry.
        index: usize,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// An option is out of its range.
    #[error("option `{field}` is {value}; allowed is {allowed}")]
    OptionOutOfRange {
        /// The field of [`Options`](crate::Options).
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: String,
    },
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
        value: crate::OptionValue,
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
    /// The installed Ipopt has no slot for a linear solver of one's own.
    #[error(
        "Ipopt {} calls no linear solver but its own; 3.11 to 3.13 do",
        righting_ipopt_sys::VERSION
    )]
    NoLinearSolverSlot,
    /// The linear solver refused the structure of the system.
    #[error("the linear solver refuses the system")]
    LinearSolver(#[source] LinearSolverError),
    /// `CreateIpoptProblem` gave nothing although every argument was checked.
    #[error("Ipopt could not create the problem")]
    NotCreated,
}

/// A matrix of a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Matrix {
    /// The constraint Jacobian.
    Jacobian,
    /// The Hessian of the Lagrangian.
    Hessian,
}

impl fmt::Display for Matrix {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Jacobian => "Jacobian",
            Self::Hessian => "Hessian",
        })
    }
}

/// A vector that belongs to a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VectorName {
    /// Bounds of the variables.
    Variable,
    /// Bounds of the constraints.
    Constraint,
    /// The variables to start from.
    Start,
    /// λ to start from.
    ConstraintMultipliers,
    /// z_L to start from.
    LowerMultipliers,
    /// z_U to start from.
    UpperMultipliers,
    /// The factor of the objective.
    ObjectiveScaling,
    /// Factors of the variables.
    VariableScaling,
    /// Factors of the constraints.
    ConstraintScaling,
}

impl fmt::Display for VectorName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Variable => "variable",
            Self::Constraint => "constraint",
            Self::Start => "start",
            Self::ConstraintMultipliers => "constraint multipliers",
            Self::LowerMultipliers => "lower bound multipliers",
            Self::UpperMultipliers => "upper bound multipliers",
            Self::ObjectiveScaling => "objective scaling",
            Self::VariableScaling => "variable scaling",
            Self::ConstraintScaling => "constraint scaling",
        })
    }
}
