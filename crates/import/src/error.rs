//! What can be wrong with a robot's file, or with what is asked of it.

use std::fmt;

/// Why a robot was refused. Each message is one line: where, what was found, and what is right there.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The text is not XML that is read.
    #[error("line {line}, column {column}: not XML that is read: {reason}")]
    NotXml {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What the XML parser expected.
        reason: String,
    },
    /// An element is wrong, or the robot that it belongs to.
    #[error("{place}: found {found}, expected {expected}")]
    Refused {
        /// The element.
        place: Place,
        /// What stands there.
        found: String,
        /// What would be right.
        expected: String,
    },
    /// The robot does not have what an option names, or cannot do without one.
    #[error("{option}: found {found}, expected {expected}")]
    Option {
        /// Which option.
        option: OptionName,
        /// What it says.
        found: String,
        /// What would be right.
        expected: String,
    },
}

/// An option of an import, as [`Options`](crate::Options) calls it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OptionName {
    /// The link that floats.
    Base,
    /// The link at the end of the arm.
    Tip,
    /// Joints that are held.
    Locked,
    /// Links that are left out.
    Dropped,
}

impl fmt::Display for OptionName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Base => "base",
            Self::Tip => "tip",
            Self::Locked => "locked",
            Self::Dropped => "dropped",
        })
    }
}

/// A place in a robot's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// The element, such as `joint "elbow", limit`.
    pub element: String,
}

impl Place {
    pub(crate) fn refuse(
        &self,
        found: impl fmt::Display,
        expected: impl fmt::Display,
    ) -> ImportError {
        ImportError::Refused {
            place: self.clone(),
            found: found.to_string(),
            expected: expected.to_string(),
        }
    }

    pub(crate) fn note(&self, remark: impl fmt::Display) -> String {
        format!("{self}: {remark}")
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.element)
    }
}

impl OptionName {
    pub(crate) fn refuse(
        self,
        found: impl fmt::Display,
        expected: impl fmt::Display,
    ) -> ImportError {
        ImportError::Option {
            option: self,
            found: found.to_string(),
            expected: expected.to_string(),
        }
    }
}

/// A text in quotes, shortened to fit in a line.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 60;
    let escaped: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    let rest = if text.chars().nth(LONGEST).is_some() { "…" } else { "" };
    format!("\"{escaped}{rest}\"")
}

/// Names in one sentence; of many the first few.
pub(crate) fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    const MOST: usize = 8;
    let mut names = names.into_iter();
    let first: Vec<String> = names.by_ref().take(MOST).map(quoted).collect();
    match names.count() {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}
