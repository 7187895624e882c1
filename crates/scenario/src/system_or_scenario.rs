//! A file that may hold a system or a scenario.

use std::path::Path;

use crate::error::Error;
use crate::file_kind::FileKind;
use crate::json::Document;
use crate::scenario::Scenario;
use crate::system_description::SystemDescription;
use crate::system_file::SystemFile;

/// What a file holds that may be either.
#[derive(Clone, Debug, PartialEq)]
pub enum SystemOrScenario {
    /// A system alone.
    System(Box<SystemDescription>),
    /// A maneuver of a system.
    Scenario(Box<Scenario>),
}

impl SystemOrScenario {
    /// Reads and checks a system file or a scenario file, told by its field `system`.
    ///
    /// # Errors
    /// As reading either.
    pub fn read(file: &Path) -> Result<Self, Error> {
        let document = Document::read(file, FileKind::SystemOrScenario)?;
        Ok(if document.has_key("system") {
            Self::Scenario(Box::new(Scenario::from_file(document.decode()?, file)?))
        } else {
            Self::System(Box::new(SystemFile::from_file(document.decode()?, file)?.description))
        })
    }

    /// The system.
    pub fn system(&self) -> &SystemDescription {
        match self {
            Self::System(system) => system,
            Self::Scenario(scenario) => scenario.system(),
        }
    }
}

/// The system of a system file or of a scenario file.
///
/// # Errors
/// As reading either.
pub fn read_system_or_scenario(file: &Path) -> Result<SystemDescription, Error> {
    Ok(SystemOrScenario::read(file)?.system().clone())
}
