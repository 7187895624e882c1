use pyo3::prelude::*;
use righting_results::solution::solution_schema;
use righting_scenario::schema::{scenario_schema, system_schema, wheels_schema};
use righting_sweep::sweep_schema;

use crate::failure::Failure;
use crate::json::to_python;

/// The JSON Schema (draft 2020-12) of a file, as a dictionary.
///
/// Parameters
/// ----------
/// file
///     ``"scenario"``, ``"system"``, ``"wheels"``, ``"sweep"`` or ``"solution"``.
///
/// Raises
/// ------
/// InputError
///     There is no such file.
#[pyfunction]
#[pyo3(signature = (file = "scenario"))]
pub fn schema<'py>(py: Python<'py>, file: &str) -> PyResult<Bound<'py, PyAny>> {
    let schema = match file {
        "scenario" => scenario_schema(),
        "system" => system_schema(),
        "wheels" => wheels_schema(),
        "sweep" => sweep_schema(),
        "solution" => solution_schema(),
        other => {
            return Err(Failure::Argument {
                name: "file",
                found: format!("{other:?}"),
                expected: "\"scenario\", \"system\", \"wheels\", \"sweep\" or \"solution\"",
            }
            .into());
        }
    };
    to_python(py, &schema)
}
