use pyo3::prelude::*;
use pyo3::types::PyTuple;
use righting_scenario::json::FileKind;
use righting_scenario::{SystemFile, file};

use crate::failure::{Failure, Outcome};
use crate::input::{Input, named};
use crate::json::to_python;

/// A spacecraft and its arm, checked.
///
/// Parameters
/// ----------
/// source
///     Path of a system file, or a mapping of what such a file holds; ``righting.schema("system")`` has every
///     field.
///
/// Raises
/// ------
/// InputError
///     A field is missing, unknown or out of range; `field` names it.
/// FileError
///     The file cannot be read.
#[pyclass(frozen, eq, module = "righting")]
#[derive(Clone, PartialEq)]
pub struct System(pub SystemFile);

impl System {
    /// A system that was read already; `name` stands for its file in errors.
    pub fn of_file(system: file::System, name: &str) -> Outcome<Self> {
        let checked = SystemFile::from_file(system, &named(None, name));
        Ok(Self(checked.map_err(Failure::of_input(FileKind::System))?))
    }
}

#[pymethods]
impl System {
    #[new]
    fn new(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        let read = match Input::of(source)? {
            Input::File(file) => SystemFile::read(&file),
            Input::Text(text) => SystemFile::parse(&text, &named(None, "system")),
        };
        Ok(Self(read.map_err(Failure::of_input(FileKind::System))?))
    }

    /// Name of the system.
    #[getter]
    fn name(&self) -> &str {
        &self.0.description.name
    }

    /// Number of joints j.
    #[getter]
    fn joint_count(&self) -> usize {
        self.0.description.joint_count()
    }

    /// Mass of base, links and payload, kg.
    #[getter]
    fn mass_kg(&self) -> f64 {
        self.0.description.model.total_mass()
    }

    /// What was accepted with an assumption, a sentence each.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.0.notes.clone()
    }

    /// The system as a file holds it.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.0.resolved)
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let arguments = PyTuple::new(py, [slf.get().to_dict(py)?])?;
        Ok((slf.get_type().into_any(), arguments))
    }

    fn __repr__(&self) -> String {
        let Self(SystemFile { description, .. }) = self;
        format!(
            "System({:?}: {} joints, {} kg)",
            description.name,
            self.joint_count(),
            self.mass_kg()
        )
    }
}
