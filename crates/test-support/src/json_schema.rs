//! Values against our published JSON Schemas, as another program's validator reads those.

use jsonschema::draft202012;
use serde_json::Value;

/// What is wrong with `value`, if anything.
///
/// # Panics
/// If `schema` is no schema of draft 2020-12.
pub fn violation(schema: &Value, value: &Value) -> Option<String> {
    let validator = draft202012::new(schema).unwrap_or_else(|error| panic!("{error}"));
    let error = validator.validate(value).err()?;
    Some(format!("{}: {error}", error.instance_path()))
}
