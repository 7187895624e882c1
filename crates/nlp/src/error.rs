use std::fmt;

use thiserror::Error;

/// What a problem declares, an option or a start that no optimizer can use.
///
/// Not converging is no error but a [`Status`](crate::Status).
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NlpError {
    /// There is nothing to solve for.
    #[error("the problem has no variables")]
    NoVariables,
    /// Optimizers and linear solvers count with 32 bits.
    #[error("{count} {what} are more than 32 bits can count")]
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
        matrix: MatrixName,
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
        matrix: MatrixName,
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
}

/// A matrix of a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MatrixName {
    /// The constraint Jacobian.
    Jacobian,
    /// The Hessian of the Lagrangian.
    Hessian,
}

impl fmt::Display for MatrixName {
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
