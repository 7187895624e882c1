use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use righting_analysis::motors::Braking;
use righting_analysis::power::Accounting;
use righting_analysis::{Motors, PowerProfile};
use righting_scenario::{Drive, WheelArray};

use crate::columns::{matrix, vector};
use crate::failure::{Failure, Outcome};
use crate::json::to_python;

/// What a plan's motion costs, at five points in each step, beside the power that reaction wheels take.
///
/// Four accountings say what becomes of braking: ``"signed"`` (the paper's: it feeds the others),
/// ``"absolute"`` (it costs as much as driving), ``"without_regeneration"`` (it costs nothing), and
/// ``"with_regeneration"`` (it gives back what its losses leave).
#[pyclass(frozen, module = "righting")]
pub struct Power {
    profile: PowerProfile,
    drives: Vec<Drive>,
    wheels: WheelArray,
    efficiency: f64,
}

impl Power {
    /// Of a profile of joints with these drives.
    pub fn new(
        profile: PowerProfile,
        drives: &[Drive],
        wheels: WheelArray,
        efficiency: f64,
    ) -> Outcome<Self> {
        if !(efficiency > 0.0 && efficiency <= 1.0) {
            return Err(Failure::Argument {
                name: "efficiency",
                found: efficiency.to_string(),
                expected: "more than 0, at most 1",
            });
        }
        Ok(Self { profile, drives: drives.to_vec(), wheels, efficiency })
    }
}

#[pymethods]
impl Power {
    /// Overall efficiency of the joints' actuators.
    #[getter]
    fn efficiency(&self) -> f64 {
        self.efficiency
    }

    /// Length of the maneuver, s.
    #[getter]
    fn duration_s(&self) -> f64 {
        self.profile.duration_s()
    }

    /// What is drawn over the maneuver, by accounting: `peak_w`, `peak_time_s`, `mean_w` and `energy_j`.
    #[getter]
    fn consumption<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for accounting in Accounting::ALL {
            let consumption = self.profile.consumption(accounting, self.efficiency);
            all.set_item(accounting.name(), to_python(py, &consumption)?)?;
        }
        Ok(all)
    }

    /// Largest torque of each joint in magnitude, N m. Shape (j,).
    #[getter]
    fn peak_joint_torques_n_m(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        vector(py, self.profile.peak_torques_n_m())
    }

    /// Largest mechanical power of each joint in magnitude, W. Shape (j,).
    #[getter]
    fn peak_joint_powers_w(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        vector(py, self.profile.peak_joint_powers_w())
    }

    /// Mechanical work of all joints, J.
    #[getter]
    fn work_j(&self) -> f64 {
        self.profile.work_j()
    }

    /// Kinetic energy of the last node less that of the first, J: what the work must be.
    #[getter]
    fn kinetic_energy_change_j(&self) -> f64 {
        self.profile.kinetic_energy_change_j()
    }

    /// Times of the points, s. Shape (5 N,).
    #[getter]
    fn time_s(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        vector(py, self.profile.instants().iter().map(|instant| instant.time_s).collect())
    }

    /// Joint torques at the points, N m. Shape (5 N, j).
    #[getter]
    fn joint_torques_n_m(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let instants = self.profile.instants().iter();
        let values = instants.flat_map(|instant| instant.joint_torques_n_m.iter().copied());
        matrix(py, self.drives.len(), values.collect())
    }

    /// Mechanical power of each joint at the points, W. Shape (5 N, j).
    #[getter]
    fn joint_powers_w(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let instants = self.profile.instants().iter();
        let values = instants.flat_map(|instant| instant.joint_powers_w.iter().copied());
        matrix(py, self.drives.len(), values.collect())
    }

    /// Power that all joints draw at the points by an accounting, W. Shape (5 N,).
    #[pyo3(signature = (accounting = "signed"))]
    fn drawn_w(&self, py: Python<'_>, accounting: &str) -> PyResult<Py<PyArray1<f64>>> {
        let named = Accounting::ALL.into_iter().find(|other| other.name() == accounting);
        let named = named.ok_or_else(|| Failure::Argument {
            name: "accounting",
            found: format!("{accounting:?}"),
            expected: "\"signed\", \"absolute\", \"without_regeneration\" or \"with_regeneration\"",
        })?;
        Ok(vector(py, self.profile.drawn_w(named, self.efficiency)))
    }

    /// What the motors draw, where every joint's drive has a motor: `consumption` without and with regeneration,
    /// `losses`, `peak_currents_a` and `peak_voltages_v`; None otherwise.
    #[getter]
    fn motors<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(motors) = Motors::new(&self.drives, &self.profile) else { return Ok(None) };
        let consumption = PyDict::new(py);
        for (name, braking) in
            [("without_regeneration", Braking::Burnt), ("with_regeneration", Braking::FedBack)]
        {
            consumption.set_item(name, to_python(py, &motors.consumption(braking))?)?;
        }
        let values = PyDict::new(py);
        values.set_item("consumption", consumption)?;
        values.set_item("losses", to_python(py, &motors.losses())?)?;
        values.set_item("peak_currents_a", vector(py, motors.peak_currents_a()))?;
        values.set_item("peak_voltages_v", vector(py, motors.peak_voltages_v()))?;
        Ok(Some(values))
    }

    /// Power that all wheels take while they spin steadily, W.
    #[getter]
    fn wheels_steady_power_w(&self) -> f64 {
        self.wheels.steady_power_w()
    }

    fn __repr__(&self) -> String {
        let consumption = self.profile.consumption(Accounting::Signed, self.efficiency);
        format!(
            "Power(peak {:.4} W, {:.4} J, by the signed accounting; wheels {:.4} W)",
            consumption.peak_w,
            consumption.energy_j,
            self.wheels.steady_power_w()
        )
    }
}
