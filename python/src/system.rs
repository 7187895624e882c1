use std::path::PathBuf;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use righting_analysis::Explanation;
use righting_scenario::json::{Document, FileKind};
use righting_scenario::{SystemFile, file, import_urdf};

use crate::failure::{Failure, Outcome};
use crate::function::Function;
use crate::input::{Input, named};
use crate::json::{text_of, to_python};
use crate::mechanics;

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
    /// What a path or a mapping holds.
    pub fn of(source: &Bound<'_, PyAny>) -> Outcome<Self> {
        let read = match Input::of(source)? {
            Input::File(file) => SystemFile::read(&file),
            Input::Text(text) => SystemFile::parse(&text, &named(None, "system")),
        };
        Ok(Self(read.map_err(Failure::of_input(FileKind::System))?))
    }

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
        Ok(Self::of(source)?)
    }

    /// The system that a robot's URDF file describes, its macros expanded.
    ///
    /// Parameters
    /// ----------
    /// file
    ///     Path of the URDF file.
    /// options
    ///     What a URDF file does not say, as the fields of a scenario's `system_options`: `base`, the link that floats,
    ///     or `on`, a mapping with the base that the robot's root link is fixed to, then with `mount_position_m` and
    ///     `mount_rpy_deg` (roll, pitch, yaw); `acceleration_max_deg_s2`, and `acceleration_max_m_s2` for joints that
    ///     slide, which URDF does not have; `rate_max_deg_s` and `speed_max_m_s` where the file has none; `tip`, the
    ///     link at the end of the only arm that moves; `locked`, joints that are held, a mapping to deg or m;
    ///     `dropped`, links that are left out; `point_masses` and `project_inertias`, for inertias that are missing or
    ///     of no rigid body.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     Something is wrong with the robot or an option; `field` names the option.
    /// FileError
    ///     The file cannot be read.
    #[staticmethod]
    #[pyo3(signature = (file, **options))]
    fn from_urdf(file: PathBuf, options: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let text = match options {
            Some(options) => text_of(options)?,
            None => "{}".to_owned(),
        };
        let imported = Document::parse(&file, &text, FileKind::Scenario)
            .and_then(|document| import_urdf(&file, &document.decode()?));
        Ok(Self(imported.map_err(Failure::of_input(FileKind::Scenario))?))
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

    /// What the joints are called, in the order of their coordinates: by their names where they have any, else by
    /// their numbers.
    #[getter]
    fn joint_names(&self) -> Vec<String> {
        let names = &self.0.description.names;
        (0..self.joint_count()).map(|joint| names.joint(joint)).collect()
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

    /// The equations of motion as a compiled function of x and u (joint accelerations, rad/s²), to its `rates` ẋ.
    ///
    /// Parameters
    /// ----------
    /// form
    ///     ``"reduced"``: x = [quaternion, joint angles, joint rates], 4 + 2j states, with a third input `momentum`, the
    ///     angular momentum about the system's center of mass in inertial axes, N m s.
    ///     ``"full"``: x = [position, quaternion, velocity, angular rate, joint angles, joint rates], 13 + 2j states,
    ///     with the axes of the arrays of a `Plan`.
    /// order
    ///     0: the rates. 1: `jacobian` too, by x and u. 2: `hessian` too, of the sum of the rates by a last input
    ///     `weights`, by x and u.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     There is no such form or order.
    #[pyo3(signature = (form = "reduced", *, order = 1))]
    fn dynamics(&self, py: Python<'_>, form: &str, order: usize) -> PyResult<Function> {
        let order = checked_order(order)?;
        let model = &self.0.description.model;
        let built = match form {
            "reduced" => py.detach(|| mechanics::reduced_dynamics(model, order)),
            "full" => py.detach(|| mechanics::full_dynamics(model, order)),
            other => {
                let found = format!("{other:?}");
                let expected = "\"reduced\" or \"full\"";
                return Err(Failure::Argument { name: "form", found, expected }.into());
            }
        };
        Ok(built?)
    }

    /// The torques of the joints, N m, of the free-floating system as a compiled function of the base's angular rate
    /// (body axes, rad/s) and joint angles, rates and accelerations (rad, rad/s, rad/s²). `order` is that of
    /// `dynamics`; derivatives are by the four inputs in this order.
    #[pyo3(signature = (*, order = 1))]
    fn joint_torques(&self, py: Python<'_>, order: usize) -> PyResult<Function> {
        let order = checked_order(order)?;
        Ok(py.detach(|| mechanics::joint_torques(&self.0.description.model, order))?)
    }

    /// Ĩ (`inertia`, 3 by 3) and B (`joint_columns`, 3 by j) of the angular momentum Ĩ ω + B q̇ about the system's
    /// center of mass, body axes, kg m², as a compiled function of the joint angles, rad.
    fn momentum_map(&self, py: Python<'_>) -> PyResult<Function> {
        Ok(py.detach(|| mechanics::momentum_map(&self.0.description.model))?)
    }

    /// What the arm can do to the base, from its middle posture: about which axes it turns it (`rank`, `only_axis`),
    /// how fast (`loops`: `principal_axes` in body axes and `rates_deg_s` about them), joints that do not help, the
    /// range of the whole system's `inertia`. Nothing is planned. The fields are those of `righting explain --json`.
    fn explain<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let explanation = py.detach(|| Explanation::of_system(&self.0.description));
        to_python(py, &explanation)
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

fn checked_order(order: usize) -> Outcome<usize> {
    match order {
        0..=2 => Ok(order),
        _ => Err(Failure::Argument {
            name: "order",
            found: order.to_string(),
            expected: "0, 1 or 2",
        }),
    }
}
