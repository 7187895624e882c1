//! A system without a maneuver: what a system file means, beside what it says.

use std::path::Path;

use crate::error::Error;
use crate::file;
use crate::json::{Document, FileKind, Location};
use crate::system_description::SystemDescription;

/// A system file, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemFile {
    /// What it means.
    pub description: SystemDescription,
    /// What it says, with what was accepted with a change as it was taken.
    pub resolved: file::System,
    /// What was accepted with an assumption, a sentence each.
    pub notes: Vec<String>,
}

impl SystemFile {
    /// Reads and checks a system file.
    ///
    /// # Errors
    /// Those of reading, and [`Error::Field`] for a field that is wrong.
    pub fn read(file: &Path) -> Result<Self, Error> {
        Self::from_file(Document::read(file, FileKind::System)?.decode()?, file)
    }

    /// Reads and checks a system from its text; `file` names it in errors.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, file: &Path) -> Result<Self, Error> {
        Self::from_file(Document::parse(file, text, FileKind::System)?.decode()?, file)
    }

    /// Checks a system; `file` names it in errors.
    ///
    /// # Errors
    /// [`Error::Field`] for a field that is wrong.
    pub fn from_file(system: file::System, file: &Path) -> Result<Self, Error> {
        Self::noted(system, file, Vec::new())
    }

    /// Checks a system of which something is to be said already.
    pub(crate) fn noted(
        system: file::System,
        file: &Path,
        mut notes: Vec<String>,
    ) -> Result<Self, Error> {
        let (mut resolved, place) = (system, Location::root(file));
        let description = SystemDescription::from_file(&mut resolved, &place, &mut notes)?;
        Ok(Self { description, resolved, notes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_is_the_same_from_its_file_its_text_and_what_it_says() {
        let file = Path::new("../../scenarios/systems/xlink_4dof.json");
        let read = SystemFile::read(file).unwrap();
        assert_eq!(read.description, SystemDescription::read(file).unwrap());
        let text = serde_json::to_string(&read.resolved).unwrap();
        assert_eq!(SystemFile::parse(&text, Path::new("system")).unwrap(), read);
    }

    #[test]
    fn what_is_wrong_is_named_in_the_file_that_stands_for_it() {
        let file = Path::new("../../scenarios/systems/xlink_4dof.json");
        let mut system = SystemFile::read(file).unwrap().resolved;
        system.links[1].mass_kg = -1.0;
        let refused = SystemFile::from_file(system, Path::new("arm")).unwrap_err().to_string();
        assert!(refused.starts_with("arm: links[1].mass_kg: found -1"), "{refused}");
    }
}
