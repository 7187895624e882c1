//! What can be wrong with a user's files, said at one glance.

use std::fmt;
use std::io;
use std::path::PathBuf;

/// Any failure of this crate that is the input's or the file system's fault.
///
/// Each message is one line: which file, where in it, what stands there and what is allowed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be opened or read.
    #[error("{}: cannot be read: {}", file.display(), plain(source))]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A directory stands where a file is needed.
    #[error("{}: is a directory: {needed} is needed", file.display())]
    Directory {
        /// The directory.
        file: PathBuf,
        /// What should be there, such as "a scenario file".
        needed: &'static str,
    },
    /// A file is larger than anything this program reads.
    #[error("{}: {bytes} bytes is not allowed: at most {limit_bytes} bytes", file.display())]
    TooLarge {
        /// The file.
        file: PathBuf,
        /// Its size.
        bytes: u64,
        /// The largest size read.
        limit_bytes: u64,
    },
    /// The text is not JSON.
    #[error(
        "{}: {path}{}line {line}, column {column}: not JSON: {reason}",
        file.display(),
        if path.is_empty() { "" } else { ": " }
    )]
    NotJson {
        /// The file.
        file: PathBuf,
        /// JSON path of the place; empty at the root.
        path: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What the JSON parser expected.
        reason: String,
    },
    /// A field of a JSON file is wrong.
    #[error("{}: {field}", file.display())]
    Field {
        /// The file.
        file: PathBuf,
        /// The field and what is wrong with it.
        field: Box<FieldError>,
    },
    /// A cell of a table is wrong.
    #[error("{}: line {line}, column {column}: `{value}` is not allowed: {allowed}", file.display())]
    Cell {
        /// The file.
        file: PathBuf,
        /// Line, from 1; the header is line 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there.
        value: String,
        /// What is allowed there.
        allowed: String,
    },
    /// A table has the wrong header or the wrong number of cells or rows.
    #[error("{}: line {line}: {problem}", file.display())]
    Table {
        /// The file.
        file: PathBuf,
        /// Line, from 1; the header is line 1.
        line: u64,
        /// What is wrong.
        problem: String,
    },
    /// A result could not be written.
    #[error("{}: cannot be written: {}", file.display(), plain(source))]
    Write {
        /// The file or folder.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// An earlier result could not be removed.
    #[error("{}: cannot be replaced: {}", file.display(), plain(source))]
    Remove {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The parts of a trajectory do not fit together.
    #[error("trajectory: {0}")]
    Shape(#[from] ShapeError),
}

/// The parts of a trajectory do not fit together: counts of nodes, intervals or joints differ.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}: {found} is not allowed: {needed}")]
pub struct ShapeError {
    /// The part, such as "nodes" or "joint angles of node 3".
    pub what: String,
    /// How many there are.
    pub found: usize,
    /// How many there must be.
    pub needed: usize,
}

/// What is wrong with one field of a JSON file.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldError {
    /// JSON path of the field, such as `links[3].mass_kg`; empty at the root.
    pub path: String,
    /// What is wrong with it.
    pub problem: FieldProblem,
}

/// The ways a field can be wrong.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FieldProblem {
    /// The value is of the wrong type, out of range or contradicts another field.
    NotAllowed {
        /// The value as JSON, shortened.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// The field is not there and has no default.
    Missing {
        /// What is allowed; empty if the type says no more than "an object".
        allowed: String,
    },
    /// The format has no such field.
    Unknown {
        /// The nearest field name, if one is near.
        nearest: Option<String>,
        /// Every field of that object.
        known: Vec<String>,
    },
    /// The field appears twice in its object.
    Duplicate,
}

impl fmt::Display for FieldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.path.is_empty() {
            write!(f, "{}: ", self.path)?;
        }
        match &self.problem {
            FieldProblem::NotAllowed { value, allowed } => {
                write!(f, "{value} is not allowed: {allowed}")
            }
            FieldProblem::Missing { allowed } if allowed.is_empty() => {
                f.write_str("missing: it has no default")
            }
            FieldProblem::Missing { allowed } => write!(f, "missing: {allowed} is needed"),
            FieldProblem::Unknown { nearest: Some(nearest), .. } => {
                write!(f, "unknown field: did you mean `{nearest}`?")
            }
            FieldProblem::Unknown { nearest: None, known } => {
                write!(f, "unknown field: the fields here are {}", known.join(", "))
            }
            FieldProblem::Duplicate => f.write_str("duplicate field: it may appear once only"),
        }
    }
}

impl std::error::Error for FieldError {}

/// An I/O error without the operating system's error number.
fn plain(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::InvalidData => "not UTF-8 text".to_owned(),
        _ => {
            let text = error.to_string();
            text.split(" (os error").next().unwrap_or(&text).to_lowercase()
        }
    }
}
