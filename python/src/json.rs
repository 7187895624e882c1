//! What the libraries write as JSON, as Python's dictionaries and lists.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde::Serialize;

/// The value as Python reads its JSON: a number that is not finite is `None`.
pub fn to_python<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text =
        serde_json::to_string(value).map_err(|error| PyValueError::new_err(error.to_string()))?;
    py.import("json")?.call_method1("loads", (text,))
}

/// A mapping of Python's as JSON; arrays, numbers of NumPy and objects with `to_dict` may stand in it.
pub fn text_of(mapping: &Bound<'_, PyAny>) -> PyResult<String> {
    mapping.py().import("righting._json")?.call_method1("text", (mapping,))?.extract()
}

/// A value whose JSON is one word, such as a status.
pub fn word(value: &impl Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(word)) => word,
        _ => String::new(),
    }
}
