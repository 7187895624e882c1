//! JSON Schemas of the files a user writes, for editors and checkers.

use serde_json::Value;

use crate::file;

/// The JSON Schema (draft 2020-12) of a scenario file.
pub fn scenario_schema() -> Value {
    schemars::schema_for!(file::Scenario).to_value()
}

/// The JSON Schema (draft 2020-12) of a system file.
pub fn system_schema() -> Value {
    schemars::schema_for!(file::System).to_value()
}
