//! Scenarios, systems, wheels and sweeps: real files varied after their schemas, values made after the schemas alone,
//! and the bytes of either changed.

use std::path::Path;
use std::sync::LazyLock;

use arbitrary::{Result, Unstructured};
use righting_scenario::schema::{scenario_schema, system_schema, wheels_schema};
use righting_scenario::{Scenario, SystemFile, WheelArray};
use righting_sweep::{Sweep, sweep_schema};
use serde_json::Value;

use crate::from_schema::Schema;
use crate::refusal::{same_twice, well_said};
use crate::target::Outcome;
use crate::workspace::scenarios;

/// A format of JSON files.
pub(crate) struct Format {
    /// What files are called in errors; beside the shipped scenarios, so that paths in them lead somewhere.
    file: &'static str,
    schema: fn() -> &'static Value,
    samples: fn() -> &'static [Value],
    /// Reads a text; what is accepted comes back as it is written down, if it is.
    read: fn(&str, &Path) -> std::result::Result<Option<String>, String>,
}

pub(crate) const SCENARIO: Format = Format {
    file: "fuzzed_scenario.json",
    schema: || {
        static SCHEMA: LazyLock<Value> = LazyLock::new(scenario_schema);
        &SCHEMA
    },
    samples: || {
        static SAMPLES: LazyLock<Vec<Value>> = LazyLock::new(|| samples(&["", "real"], true));
        &SAMPLES
    },
    read: |text, file| {
        let scenario = Scenario::parse(text, file).map_err(|error| error.to_string())?;
        Ok(Some(printed(scenario.resolved())))
    },
};

pub(crate) const SYSTEM: Format = Format {
    file: "fuzzed_system.json",
    schema: || {
        static SCHEMA: LazyLock<Value> = LazyLock::new(system_schema);
        &SCHEMA
    },
    samples: || {
        static SAMPLES: LazyLock<Vec<Value>> = LazyLock::new(|| samples(&["systems"], false));
        &SAMPLES
    },
    read: |text, file| {
        let system = SystemFile::parse(text, file).map_err(|error| error.to_string())?;
        Ok(Some(printed(&system.resolved)))
    },
};

pub(crate) const WHEELS: Format = Format {
    file: "fuzzed_wheels.json",
    schema: || {
        static SCHEMA: LazyLock<Value> = LazyLock::new(wheels_schema);
        &SCHEMA
    },
    samples: || &[],
    read: |text, file| {
        WheelArray::parse(text, file).map_err(|error| error.to_string())?;
        Ok(None)
    },
};

pub(crate) const SWEEP: Format = Format {
    file: "sweeps/fuzzed_sweep.json",
    schema: || {
        static SCHEMA: LazyLock<Value> = LazyLock::new(sweep_schema);
        &SCHEMA
    },
    samples: || {
        static SAMPLES: LazyLock<Vec<Value>> = LazyLock::new(|| samples(&["sweeps"], false));
        &SAMPLES
    },
    read: |text, file| {
        let sweep = Sweep::parse(text, file).map_err(|error| error.to_string())?;
        // Any case of it can be made.
        for index in [0, sweep.len() / 2, sweep.len() - 1] {
            let _ = sweep.scenario(&sweep.case(index));
        }
        Ok(Some(printed(sweep.resolved())))
    },
};

fn printed(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).expect("numbers and texts that were read from JSON")
}

/// The JSON files of folders beneath the shipped scenarios; with the systems that they name inline, if asked for.
fn samples(folders: &[&str], inline: bool) -> Vec<Value> {
    let mut samples = Vec::new();
    for folder in folders {
        let folder = scenarios().join(folder);
        let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
        let mut files: Vec<_> = entries.map(|entry| entry.path()).collect();
        files.sort();
        for file in files.iter().filter(|file| file.extension().is_some_and(|e| e == "json")) {
            let Ok(text) = std::fs::read_to_string(file) else { continue };
            let Ok(mut value) = serde_json::from_str::<Value>(&text) else { continue };
            let system = value.get("system").and_then(Value::as_str).filter(|_| inline);
            let system = system.and_then(|path| std::fs::read_to_string(folder.join(path)).ok());
            if let Some(system) = system.and_then(|text| serde_json::from_str(&text).ok()) {
                value["system"] = system;
            }
            samples.push(value);
        }
    }
    samples
}

impl Format {
    /// The text of a file.
    pub(crate) fn text(&self, u: &mut Unstructured<'_>) -> Result<Vec<u8>> {
        let schema = Schema::new((self.schema)());
        let samples = (self.samples)();
        let value = if samples.is_empty() || u.ratio(1, 4)? {
            schema.value(u, 0)?
        } else {
            let mut value = u.choose(samples)?.clone();
            if u.ratio(9, 10)? {
                schema.vary(u, &mut value)?;
            }
            value
        };
        let mut text = value.to_string().into_bytes();
        if u.ratio(1, 8)? {
            change_bytes(u, &mut text)?;
        }
        Ok(text)
    }

    pub(crate) fn check(&self, u: &mut Unstructured<'_>) -> std::result::Result<Outcome, String> {
        let bytes = self.text(u).map_err(|error| error.to_string())?;
        // What is not UTF-8 is refused by the function that opens files.
        let text = String::from_utf8_lossy(&bytes);
        let file = scenarios().join(self.file);
        let answers = [(); 2].map(|()| (self.read)(&text, &file));
        let [first, second] = answers;
        match same_twice(first, second)? {
            Err(message) => {
                // A file that this one names is named in its own errors.
                let folder = scenarios();
                well_said(&message, folder.display())?;
                Ok(Outcome::Refused)
            }
            Ok(None) => Ok(Outcome::Accepted),
            Ok(Some(printed)) => {
                let again = (self.read)(&printed, &file);
                match again {
                    Ok(Some(again)) if again == printed => Ok(Outcome::Accepted),
                    Ok(again) => Err(format!("{printed} is read as {again:?}")),
                    Err(message) => {
                        Err(format!("what was accepted is refused: {message}: {printed}"))
                    }
                }
            }
        }
    }
}

/// Changes, takes out, doubles or cuts off some bytes.
pub(crate) fn change_bytes(u: &mut Unstructured<'_>, text: &mut Vec<u8>) -> Result<()> {
    for _ in 0..u.int_in_range(1..=4)? {
        if text.is_empty() {
            return Ok(());
        }
        let at = u.choose_index(text.len())?;
        match u.int_in_range(0..=4)? {
            0 => text[at] = u.arbitrary()?,
            1 => text.truncate(at),
            2 => {
                text.remove(at);
            }
            3 => {
                let end = text.len().min(at + usize::from(u.arbitrary::<u8>()?));
                let part = text[at..end].to_vec();
                text.splice(at..at, part);
            }
            _ => text[at] ^= 1 << u.int_in_range(0..=7)?,
        }
    }
    Ok(())
}

/// The schema of scenarios.
pub(crate) fn schema_of_scenarios() -> &'static Value {
    (SCENARIO.schema)()
}
