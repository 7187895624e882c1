use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::PyTuple;
use righting_analysis::Explanation;
use righting_scenario::json::FileKind;

use crate::failure::{Failure, Outcome};
use crate::input::{Input, named};
use crate::json::to_python;
use crate::system::System;

/// One maneuver of one system, checked.
///
/// Parameters
/// ----------
/// source
///     Path of a scenario file, or a mapping of what such a file holds. Lengths are in meters, angles in degrees,
///     as their names say. `system` may be a path, a mapping or a `System`; arrays of NumPy may stand for lists.
///     ``righting.schema("scenario")`` has every field.
/// folder
///     Of a mapping: the folder that a relative path in `system` starts from; the working folder by default.
///
/// Raises
/// ------
/// InputError
///     A field is missing, unknown or out of range; `field` names it.
/// FileError
///     A file cannot be read.
#[pyclass(frozen, eq, module = "righting")]
#[derive(Clone, PartialEq)]
pub struct Scenario(pub righting_scenario::Scenario);

impl Scenario {
    /// What a caller gave for a scenario.
    pub fn of(source: &Bound<'_, PyAny>) -> Outcome<righting_scenario::Scenario> {
        match source.cast::<Self>() {
            Ok(scenario) => Ok(scenario.get().0.clone()),
            Err(_) => Self::read(source, None),
        }
    }

    fn read(
        source: &Bound<'_, PyAny>,
        folder: Option<PathBuf>,
    ) -> Outcome<righting_scenario::Scenario> {
        let read = match Input::of(source)? {
            Input::File(file) => righting_scenario::Scenario::read(&file),
            Input::Text(text) => {
                let file = named(folder.as_deref(), "scenario");
                righting_scenario::Scenario::parse(&text, &file)
            }
        };
        read.map_err(Failure::of_input(FileKind::Scenario))
    }
}

#[pymethods]
impl Scenario {
    #[new]
    #[pyo3(signature = (source, *, folder=None))]
    fn new(source: &Bound<'_, PyAny>, folder: Option<PathBuf>) -> PyResult<Self> {
        Ok(Self(Self::read(source, folder)?))
    }

    /// Name of the scenario.
    #[getter]
    fn name(&self) -> &str {
        self.0.name()
    }

    /// The system, with every default filled in.
    #[getter]
    fn system(&self) -> PyResult<System> {
        System::of_file(self.0.resolved_system().clone(), self.0.name()).map_err(PyErr::from)
    }

    /// Duration, s; the longest one where the plan chooses it.
    #[getter]
    fn duration_s(&self) -> f64 {
        self.0.horizon().duration_s
    }

    /// Number of steps N of the grid.
    #[getter]
    fn steps(&self) -> usize {
        self.0.horizon().steps
    }

    /// What was accepted with an assumption, a sentence each.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes().to_vec()
    }

    /// SHA-256 of the scenario with every default filled in, hexadecimal.
    #[getter]
    fn sha256(&self) -> String {
        self.0.resolved().sha256()
    }

    /// What the arm can do to the base from the posture at the start, as `System.explain`, and under `maneuver` what is
    /// asked of it: whether it is `possible`, else why not, and first estimates of the time of a slew (`estimated_s`)
    /// or the bound of a detumble (`bound_deg_s`). Nothing is planned.
    fn explain<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let explanation = py.detach(|| Explanation::of_scenario(&self.0));
        to_python(py, &explanation)
    }

    /// The scenario as a file holds it, the system inline and every default filled in. To vary it, change the
    /// dictionary and make another `Scenario` of it.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, self.0.resolved())
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let arguments = PyTuple::new(py, [slf.get().to_dict(py)?])?;
        Ok((slf.get_type().into_any(), arguments))
    }

    fn __repr__(&self) -> String {
        let asked = righting_report::asked_phrase(self.0.resolved());
        format!("Scenario({:?}: {asked}, {} steps)", self.0.name(), self.steps())
    }
}
