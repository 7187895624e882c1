//! JSON Schemas of the files a user writes, for editors and checkers.

use serde_json::Value;

use crate::file;
use crate::wheels::WheelFile;

/// The JSON Schema (draft 2020-12) of a scenario file.
pub fn scenario_schema() -> Value {
    schemars::schema_for!(file::Scenario).to_value()
}

/// The JSON Schema (draft 2020-12) of a system file.
pub fn system_schema() -> Value {
    schemars::schema_for!(file::System).to_value()
}

/// The JSON Schema (draft 2020-12) of a file of wheels.
pub fn wheels_schema() -> Value {
    schemars::schema_for!(WheelFile).to_value()
}
