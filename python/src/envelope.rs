use std::path::PathBuf;

use numpy::{PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use righting_analysis::zonotope::Zonotope;
use righting_scenario::json::FileKind;
use righting_scenario::{SystemDescription, SystemOrScenario};

use crate::columns::matrix;
use crate::failure::{Failure, Outcome};
use crate::json::to_python;
use crate::scenario::Scenario;
use crate::system::System;
use crate::turn::refuse_fork;
use crate::wheels::wheels;

/// All momenta (N m s) or torques (N m) that an arm can give, beside those of reaction wheels; body axes.
#[pyclass(frozen, module = "righting")]
pub struct Envelope {
    found: righting_analysis::Envelope,
    wheels: Zonotope,
}

#[pymethods]
impl Envelope {
    /// Largest norm among the samples.
    #[getter]
    fn sampled_max(&self) -> f64 {
        self.found.sampled_max
    }

    /// Largest norm that the limits of the joints allow.
    #[getter]
    fn true_max(&self) -> f64 {
        self.found.true_max
    }

    /// Where it points, a unit vector.
    #[getter]
    fn true_max_axis(&self) -> [f64; 3] {
        self.found.true_max_axis
    }

    /// Largest component along x, y and z in magnitude.
    #[getter]
    fn per_axis_max(&self) -> [f64; 3] {
        self.found.per_axis_max
    }

    /// Smallest extent over all directions.
    #[getter]
    fn true_min(&self) -> f64 {
        self.found.true_min
    }

    /// Volume of the convex hull of the samples.
    #[getter]
    fn hull_volume(&self) -> f64 {
        self.found.hull_volume
    }

    /// Volume of the convex hull of the extreme points: at most that of the true envelope.
    #[getter]
    fn true_volume(&self) -> f64 {
        self.found.true_volume
    }

    /// Factors at which arm and wheels reach as far in every direction: on the arm's lengths, on its masses, or on
    /// the wheels' limits. None where no factor up to 100 does.
    #[getter]
    fn sizing<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.found.sizing)
    }

    /// Corners of the convex hull of the extreme points. Shape (n, 3).
    #[getter]
    fn vertices(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let corners = self.found.hull.vertices.iter();
        matrix(py, 3, corners.flat_map(|corner| [corner.x, corner.y, corner.z]).collect())
    }

    /// Its triangles, three indices of corners each, counter-clockwise from outside. Shape (m, 3).
    #[getter]
    fn triangles(&self, py: Python<'_>) -> PyResult<Py<PyArray2<usize>>> {
        let rows: Vec<Vec<usize>> =
            self.found.hull.triangles.iter().map(|corners| corners.to_vec()).collect();
        let array = match rows.is_empty() {
            true => PyArray2::zeros(py, [0, 3], false),
            false => PyArray2::from_vec2(py, &rows)?,
        };
        array.readwrite().make_nonwriteable();
        Ok(array.unbind())
    }

    /// What the wheels give: `max`, `min` and `rms` over all directions, and `volume`.
    #[getter]
    fn wheels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let radii = self.wheels.radii();
        let values = PyDict::new(py);
        values.set_item("max", radii.max)?;
        values.set_item("min", radii.min)?;
        values.set_item("rms", radii.rms)?;
        values.set_item("volume", self.wheels.volume())?;
        Ok(values)
    }

    fn __repr__(&self) -> String {
        let Self { found, wheels } = self;
        let radii = wheels.radii();
        format!(
            "Envelope(true_max={:.4}, true_min={:.4}; wheels {:.4}, {:.4})",
            found.true_max, found.true_min, radii.max, radii.min
        )
    }
}

/// The momentum and torque envelopes of an arm.
#[pyclass(frozen, get_all, module = "righting")]
pub struct Envelopes {
    /// Of the angular momentum that the arm's motion gives, N m s.
    momentum_n_m_s: Py<Envelope>,
    /// Of the torque on the base, N m.
    torque_n_m: Py<Envelope>,
}

#[pymethods]
impl Envelopes {
    fn __repr__(&self) -> String {
        format!(
            "Envelopes(momentum_n_m_s={}, torque_n_m={})",
            self.momentum_n_m_s.get().__repr__(),
            self.torque_n_m.get().__repr__()
        )
    }
}

/// What momentum and torque an arm can give within the limits of its joints, beside reaction wheels.
///
/// Parameters
/// ----------
/// system
///     A `System`, or a `Scenario`, a path or a mapping for its system.
/// samples, seed
///     How many uniform samples of joint angles, rates and accelerations, and their seed. The true extents do not
///     depend on them.
/// wheels
///     The wheels to compare with: the path of a file of wheels, or a mapping; by default a pyramid of four of
///     1 N m s, 0.1 N m and 5 W each.
#[pyfunction]
#[pyo3(signature = (system, *, samples=2000, seed=1, wheels=None))]
pub fn envelope(
    py: Python<'_>,
    system: &Bound<'_, PyAny>,
    samples: usize,
    seed: u64,
    wheels: Option<&Bound<'_, PyAny>>,
) -> PyResult<Envelopes> {
    let system = description(system)?;
    let wheels = self::wheels(wheels)?;
    if !(1..=10_000_000).contains(&samples) {
        let expected = "from 1 to 10000000";
        return Err(
            Failure::Argument { name: "samples", found: samples.to_string(), expected }.into()
        );
    }
    refuse_fork()?;
    let found = py.detach(|| righting_analysis::envelopes(&system, samples, seed, &wheels));
    let [momenta, torques] =
        [Zonotope::momenta(wheels.wheels()), Zonotope::torques(wheels.wheels())];
    Ok(Envelopes {
        momentum_n_m_s: Py::new(py, Envelope { found: found.momentum, wheels: momenta })?,
        torque_n_m: Py::new(py, Envelope { found: found.torque, wheels: torques })?,
    })
}

/// The system that a caller means.
fn description(source: &Bound<'_, PyAny>) -> Outcome<SystemDescription> {
    if let Ok(system) = source.cast::<System>() {
        return Ok(system.get().0.description.clone());
    }
    if let Ok(scenario) = source.cast::<Scenario>() {
        return Ok(scenario.get().0.system().clone());
    }
    let is_scenario = match source.cast::<PyMapping>() {
        Ok(mapping) => mapping.contains("system")?,
        Err(_) => {
            let read = SystemOrScenario::read(&source.extract::<PathBuf>()?);
            let read = read.map_err(Failure::of_input(FileKind::SystemOrScenario))?;
            return Ok(read.system().clone());
        }
    };
    Ok(match is_scenario {
        true => Scenario::of(source)?.system().clone(),
        false => System::of(source)?.0.description,
    })
}
