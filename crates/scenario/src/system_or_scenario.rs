//! A file that may hold a system or a scenario.

use std::path::Path;

use crate::error::Error;
use crate::file_kind::FileKind;
use crate::json::{Document, Location};
use crate::scenario::Scenario;
use crate::system_description::SystemDescription;

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
            let (place, mut notes) = (Location::root(file), Vec::new());
            let system = SystemDescription::from_file(&mut document.decode()?, &place, &mut notes)?;
            Self::System(Box::new(system))
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
