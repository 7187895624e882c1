//! A plan read from its folder, of every command that takes one.

use std::path::Path;

use righting_scenario::json::FileKind;
use righting_verifier::{Verified, verify_directory};

use crate::failure::Failure;

/// Reads a plan and checks it again.
pub fn read(folder: &Path) -> Result<Verified, Failure> {
    refuse_file(folder, "the folder of a plan")?;
    verify_directory(folder).map_err(|error| Failure::InputOf { kind: FileKind::Solution, error })
}

/// A path whose last part is a file, where a folder is `expected`, is no folder.
pub fn refuse_file(path: &Path, expected: &'static str) -> Result<(), Failure> {
    match path.is_file() {
        true => Err(Failure::NotAFolder { path: path.to_owned(), expected }),
        false => Ok(()),
    }
}
