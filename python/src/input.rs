//! What a caller may give for a file: a path, or what the file would hold.

use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use pyo3::types::PyMapping;

use crate::json::text_of;

/// A file, or its contents.
pub enum Input {
    /// Where the file is.
    File(PathBuf),
    /// What it would hold, as JSON.
    Text(String),
}

impl Input {
    /// A path, or a mapping of what a file would hold.
    pub fn of(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        match source.cast::<PyMapping>() {
            Ok(_) => Ok(Self::Text(text_of(source)?)),
            Err(_) => Ok(Self::File(source.extract()?)),
        }
    }
}

/// What errors call a file that is none, in the folder that its relative paths start from.
pub fn named(folder: Option<&Path>, name: &str) -> PathBuf {
    folder.unwrap_or(Path::new("")).join(name)
}
