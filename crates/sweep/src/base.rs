//! The scenario that a sweep varies.

use std::path::Path;

use righting_scenario::file::{Scenario as ScenarioFile, SystemReference};
use righting_scenario::json::{Document, FileKind, Location, shown};
use righting_scenario::{Error, Scenario};
use serde_json::{Value, json};

use crate::field_path::FieldPath;
use crate::file::ScenarioReference;

/// A scenario as it is written, with its system inline. Its defaults stay open, since they may depend on what
/// a case sets: there is one joint rate a joint, and weights depend on the type of the maneuver.
#[derive(Clone, Debug)]
pub(crate) struct Base {
    written: Value,
    /// The same with every default filled in.
    resolved: Value,
}

impl Base {
    /// Reads and checks what a sweep that stands in `file` has at `place`.
    ///
    /// # Errors
    /// Those of reading a scenario.
    pub fn read(
        reference: &ScenarioReference,
        file: &Path,
        place: &Location,
    ) -> Result<Self, Error> {
        let (mut written, checked) = match reference {
            ScenarioReference::Inline(scenario) => {
                let written = (**scenario).clone();
                (written.clone(), Scenario::from_file_at(written, file, place)?)
            }
            ScenarioReference::File(path) if path.is_empty() => {
                return Err(place.refuse("\"\"", "the path of a scenario file, or a scenario"));
            }
            ScenarioReference::File(path) => {
                let file = file.parent().unwrap_or(Path::new("")).join(path);
                read_file(&file).map_err(|error| match error {
                    Error::Field { .. } | Error::NotJson { .. } | Error::Kind { .. } => error,
                    unreadable => place.refuse(
                        shown(&json!(path)),
                        format_args!("the path of a scenario file ({unreadable})"),
                    ),
                })?
            }
        };
        written.system = SystemReference::Inline(Box::new(checked.resolved_system().clone()));
        written.system_options = None;
        Ok(Self { written: json!(written), resolved: json!(checked.resolved()) })
    }

    /// Fills in the default of a field of which a case changes a part only.
    pub fn fill_in(&mut self, path: &FieldPath) {
        path.fill_in(&mut self.written, &self.resolved);
    }

    /// The scenario as a file.
    pub fn to_file(&self) -> ScenarioFile {
        serde_json::from_value(self.written.clone()).expect("a scenario with defaults filled in")
    }

    /// The scenario.
    pub fn written(&self) -> &Value {
        &self.written
    }
}

fn read_file(file: &Path) -> Result<(ScenarioFile, Scenario), Error> {
    let written: ScenarioFile = Document::read(file, FileKind::Scenario)?.decode()?;
    let checked = Scenario::from_file(written.clone(), file)?;
    Ok((written, checked))
}
