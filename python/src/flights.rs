use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;

use numpy::PyArray1;
use pyo3::prelude::*;
use righting_flight::{Campaign, End, Flight, Settings, Summary};
use righting_planner::PlanError;

use crate::argument::count;
use crate::columns::vector;
use crate::failure::Outcome;
use crate::interruptible::interruptible;
use crate::json::to_python;
use crate::plan::Plan;
use crate::turn::alone;

/// Flights of one plan with spacecraft that are not as planned, each open loop, and with what is done about it. Arrays
/// have one entry a flight, NaN where one could not be followed to its end.
#[pyclass(frozen, module = "righting")]
pub struct Flights(Vec<Flight>);

impl Flights {
    /// Flies a plan.
    pub fn of(py: Python<'_>, plan: &Plan, settings: Settings, flights: usize) -> Outcome<Self> {
        let flights = count("flights", flights)?.get();
        let flown = alone(py, || {
            let fly = |halted: &AtomicBool, _: Sender<()>| {
                let campaign = Campaign::new(&plan.scenario, &plan.trajectory, settings)?;
                Ok::<_, PlanError>(campaign.fly(flights, &|| halted.load(Ordering::Relaxed)))
            };
            interruptible(fly, |_, ()| Ok(()))
        })?;
        Ok(Self(flown??))
    }

    fn of_ends(
        &self,
        py: Python<'_>,
        end: fn(&Flight) -> Option<End>,
        value: fn(End) -> f64,
    ) -> Py<PyArray1<f64>> {
        let degrees = |flight| end(flight).map_or(f64::NAN, |end| value(end).to_degrees());
        vector(py, self.0.iter().map(degrees).collect())
    }
}

#[pymethods]
impl Flights {
    fn __len__(&self) -> usize {
        self.0.len()
    }

    /// Angle between the attitude at the end and the target with what is done about it, deg.
    #[getter]
    fn final_error_deg(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.of_ends(py, |flight| Some(flight.flown), |end| end.error_rad)
    }

    /// Angular rate of the base at the end with what is done about it, deg/s.
    #[getter]
    fn final_rate_deg_s(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.of_ends(py, |flight| Some(flight.flown), |end| end.rate_rad_s)
    }

    /// Angle between the attitude at the end and the target, open loop, deg.
    #[getter]
    fn open_loop_error_deg(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.of_ends(py, |flight| flight.open_loop, |end| end.error_rad)
    }

    /// Angular rate of the base at the end, open loop, deg/s.
    #[getter]
    fn open_loop_rate_deg_s(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.of_ends(py, |flight| flight.open_loop, |end| end.rate_rad_s)
    }

    /// How long replans took, s: all of all flights.
    #[getter]
    fn replan_s(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        let times = self.0.iter().flat_map(|flight| &flight.log.replans);
        vector(py, times.map(|time| time.as_secs_f64()).collect())
    }

    /// Medians, 95th percentiles and largest of all that, and how many replans were missed.
    #[getter]
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &Summary::of(&self.0))
    }

    fn __repr__(&self) -> String {
        let summary = Summary::of(&self.0);
        let shown = |median: Option<f64>| median.map_or("none".to_owned(), |m| format!("{m:.3}"));
        format!(
            "Flights({} of {} to their end; median error {} deg, {} deg open loop)",
            summary.completed,
            summary.flights,
            shown(summary.flown.final_error_deg.median),
            shown(summary.open_loop.final_error_deg.median)
        )
    }
}
