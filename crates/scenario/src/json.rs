//! JSON files read so that every complaint names the field by its path.
//!
//! Text becomes a tree in which no key appears twice (`unique`), and the tree becomes typed values
//! through a reader whose error is a [`FieldError`] (`decode`). What the types cannot say is then
//! checked value by value through a [`Location`].

mod decode;
mod location;
mod unique;

pub use crate::file_kind::FileKind;
pub use location::{Bounds, Location, Number};

use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::Value;

use crate::error::{Error, FieldError, FieldProblem};
use crate::file_io;
use unique::{SyntaxError, SyntaxProblem};

/// A JSON file: no key twice in any object.
#[derive(Debug)]
pub struct Document {
    file: PathBuf,
    expected: FileKind,
    root: Value,
}

impl Document {
    /// Reads a file that should be of the kind `expected`.
    ///
    /// # Errors
    /// Those of reading; [`Error::NotJson`], and [`Error::Field`] for a key that appears twice.
    pub fn read(file: &Path, expected: FileKind) -> Result<Self, Error> {
        let text = file_io::read(file, expected.phrase(), file_io::JSON_LIMIT_BYTES)?;
        Self::parse(file, &text, expected)
    }

    /// Parses the text of a file that should be of the kind `expected`.
    ///
    /// # Errors
    /// [`Error::NotJson`], and [`Error::Field`] for a key that appears twice.
    pub fn parse(file: &Path, text: &str, expected: FileKind) -> Result<Self, Error> {
        let file = file.to_owned();
        match unique::parse(text) {
            Ok(root) => Ok(Self { file, expected, root }),
            Err(SyntaxError { path, problem: SyntaxProblem::Duplicate }) => {
                let field = FieldError { path, problem: FieldProblem::Duplicate };
                Err(Error::Field { file, field: Box::new(field) })
            }
            Err(SyntaxError { path, problem: SyntaxProblem::NotJson { line, column, reason } }) => {
                Err(Error::NotJson { file, path, line, column, reason })
            }
        }
    }

    /// Reads the tree as a typed value.
    ///
    /// # Errors
    /// [`Error::Kind`] where the fields are those of another kind of file, otherwise
    /// [`Error::Field`] for the first field that does not fit the type.
    pub fn decode<'a, T: Deserialize<'a>>(&'a self) -> Result<T, Error> {
        decode::decode(&self.root).map_err(|field| match FileKind::of(&self.root) {
            Some(found) if !self.expected.includes(found) => {
                Error::Kind { file: self.file.clone(), found, expected: self.expected }
            }
            _ => Error::Field { file: self.file.clone(), field: Box::new(field) },
        })
    }

    /// Whether the file holds an object with this key.
    pub(crate) fn has_key(&self, key: &str) -> bool {
        self.root.get(key).is_some()
    }
}

/// A key as part of a path.
fn shown_key(key: &str) -> String {
    shown_text(key)
}

/// A path of many keys.
fn shown_path(path: &str) -> String {
    const LONGEST: usize = 400;
    on_one_line(path, LONGEST)
}

/// A value as JSON, shortened to fit in a line.
pub fn shown(value: &Value) -> String {
    shown_text(&value.to_string())
}

/// What a file says, shortened to fit in a line.
pub fn shown_text(text: &str) -> String {
    const LONGEST: usize = 60;
    on_one_line(text, LONGEST)
}

/// A text of so many characters at most; those that would move a terminal's cursor are escaped.
pub(crate) fn on_one_line(text: &str, longest: usize) -> String {
    let mut shown = String::new();
    for (place, c) in text.chars().enumerate() {
        if place == longest {
            shown.push('…');
            break;
        }
        match c.is_control() {
            true => shown.extend(c.escape_default()),
            false => shown.push(c),
        }
    }
    shown
}

/// The candidate nearest to `name`, if any is near enough to be what was meant.
fn nearest<'a>(name: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let name = name.to_lowercase();
    let likeness = |candidate: &&str| {
        let prefixed = name.len() >= 3 && candidate.starts_with(&name);
        let similar = strsim::normalized_damerau_levenshtein(&name, candidate);
        if prefixed { similar.max(0.9) } else { similar }
    };
    let best = candidates.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    // The first letter is seldom the wrong one.
    let least = if best.chars().next() == name.chars().next() { 0.5 } else { 0.6 };
    (likeness(best) >= least).then_some(*best)
}
