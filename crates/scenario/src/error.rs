//! What can be wrong with a user's files, said at one glance.

use std::path::{Path, PathBuf};
use std::{fmt, io};

use righting_import::ImportError;

use crate::file_kind::FileKind;
use crate::json::on_one_line;

/// Any failure of this crate that is the input's or the file system's fault.
///
/// Each message is one line: which file, where in it, and the [`Mismatch`] of what stands there with
/// what is expected there.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be opened or read.
    #[error("{}: cannot be read: {}", named(file), plain(source))]
    Read {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A directory stands where a file is needed.
    #[error("{}: {}", named(file), Mismatch::new("a directory", expected))]
    Directory {
        /// The directory.
        file: PathBuf,
        /// What should be there, such as "a scenario file".
        expected: &'static str,
    },
    /// A file is larger than anything this program reads.
    #[error(
        "{}: {}",
        named(file),
        Mismatch::new(format_args!("{bytes} bytes"), format_args!("at most {limit_bytes}"))
    )]
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
        named(file),
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
    /// A JSON file is of another kind than the one expected.
    #[error("{}: {}", named(file), Mismatch::new(found, expected))]
    Kind {
        /// The file.
        file: PathBuf,
        /// What it is.
        found: FileKind,
        /// What it should be.
        expected: FileKind,
    },
    /// A field of a JSON file is wrong.
    #[error("{}: {field}", named(file))]
    Field {
        /// The file.
        file: PathBuf,
        /// The field and what is wrong with it.
        field: Box<FieldError>,
    },
    /// A robot's file is wrong.
    #[error("{}: {source}", named(file))]
    Robot {
        /// The file.
        file: PathBuf,
        /// Where in it, and what.
        source: ImportError,
    },
    /// A cell of a table is wrong.
    #[error("{}: line {line}, column {column}: {mismatch}", named(file))]
    Cell {
        /// The file.
        file: PathBuf,
        /// Line, from 1; the header is line 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there and what should.
        mismatch: Mismatch,
    },
    /// A table has the wrong header or the wrong number of cells or rows.
    #[error("{}: line {line}: {problem}", named(file))]
    Table {
        /// The file.
        file: PathBuf,
        /// Line, from 1; the header is line 1.
        line: u64,
        /// What is wrong.
        problem: String,
    },
    /// A result could not be written.
    #[error("{}: cannot be written: {}", named(file), plain(source))]
    Write {
        /// The file or folder.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// An earlier result could not be removed.
    #[error("{}: cannot be replaced: {}", named(file), plain(source))]
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
#[error("{what}: {}", Mismatch::new(found, needed))]
pub struct ShapeError {
    /// The part, such as "nodes" or "joint angles of node 3".
    pub what: String,
    /// How many there are.
    pub found: usize,
    /// How many there must be.
    pub needed: usize,
}

/// What stands somewhere and what should: the one sentence of every complaint about a value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("found {found}, expected {expected}")]
pub struct Mismatch {
    /// What stands there, shortened to fit in a line.
    pub found: String,
    /// What would be right.
    pub expected: String,
}

impl Mismatch {
    /// That `found` stands where `expected` should.
    pub fn new(found: impl fmt::Display, expected: impl fmt::Display) -> Self {
        Self { found: found.to_string(), expected: expected.to_string() }
    }
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
    Mismatch(Mismatch),
    /// The field is not there and has no default.
    Missing {
        /// What would be right; empty if the type does not say.
        expected: String,
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
            FieldProblem::Mismatch(mismatch) => mismatch.fmt(f),
            FieldProblem::Missing { expected } if expected.is_empty() => {
                f.write_str("missing: it has no default")
            }
            FieldProblem::Missing { expected } => write!(f, "missing, expected {expected}"),
            FieldProblem::Unknown { nearest: Some(nearest), .. } => {
                write!(f, "unknown field: did you mean `{nearest}`?")
            }
            FieldProblem::Unknown { nearest: None, known } => {
                write!(f, "unknown field, expected one of {}", known.join(", "))
            }
            FieldProblem::Duplicate => f.write_str("duplicate field, expected once"),
        }
    }
}

impl std::error::Error for FieldError {}

/// A file's name on one line: whoever writes control characters into a name gets them escaped.
fn named(file: &Path) -> String {
    const LONGEST: usize = 500;
    on_one_line(&file.display().to_string(), LONGEST)
}

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
