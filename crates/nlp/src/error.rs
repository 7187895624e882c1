use std::fmt;

use thiserror::Error;

/// What a problem declares, an option or a start that no optimizer can use.
///
/// Not converging is no error but a [`Status`](crate::Status).
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NlpError {
    /// There is nothing to solve for.
    #[error("found no variables, expected at least one")]
    NoVariables,
    /// Optimizers and linear solvers count with 32 bits.
    #[error("found {count} {what}, expected at most {}", i32::MAX)]
    TooMany {
        /// What there are too many of.
        what: &'static str,
        /// How many.
        count: usize,
    },
    /// A structure has not as many row as column indices.
    #[error(
        "{matrix} structure: found {rows} row indices and {columns} column indices, expected as many"
    )]
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
        "{matrix} structure, entry {entry}: found ({row}, {column}), expected an entry of a \
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
        "Hessian structure, entry {entry}: found ({row}, {column}), expected the lower triangle"
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
    #[error(
        "bounds of {vector} {index}: found [{lower}, {upper}], expected lower ≤ upper, and a finite number between them"
    )]
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
    #[error("{vector}: found {found} entries, expected {expected}")]
    WrongLength {
        /// Which vector.
        vector: VectorName,
        /// What the problem needs.
        expected: usize,
        /// What was given.
        found: usize,
    },
    /// A number is NaN, infinite, or outside of what its vector may hold.
    #[error("{vector}, entry {index}: found {value}, expected {expected}")]
    BadNumber {
        /// Which vector.
        vector: VectorName,
        /// Which entry.
        index: usize,
        /// What was given.
        value: f64,
        /// What is expected.
        expected: &'static str,
    },
    /// An option is out of its range.
    #[error("option `{field}`: found {value}, expected {expected}")]
    OptionOutOfRange {
        /// The field of [`Options`](crate::Options).
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is expected.
        expected: String,
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
