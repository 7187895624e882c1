//! A file that may hold a system or a scenario.

use std::path::Path;

use crate::error::Error;
use crate::json::{Document, FileKind, Location};
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
            let place = Location::root(file);
            Self::System(Box::new(SystemDescription::from_file(&document.decode()?, &place)?))
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
