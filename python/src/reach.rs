use pyo3::prelude::*;
use righting_ocp::Control;
use righting_planner::reach::{Progress, Quantity, ReachSettings, Reached};
use righting_scenario::scenario::MAX_STARTS;

use crate::failure::{Failure, Outcome};
use crate::json::{to_python, word};
use crate::plan::Plan;
use crate::scenario::Scenario;
use crate::turn::alone;
use crate::watch::Watch;

/// What a search for the shortest duration or the largest angle found.
///
/// The answer is the end of an unbroken row of successes, not a proof: a value that was not tried may behave
/// otherwise.
#[pyclass(frozen, module = "righting")]
pub struct Reach {
    scenario: righting_scenario::Scenario,
    found: righting_planner::Reach,
    plan: Option<Py<Plan>>,
}

#[pymethods]
impl Reach {
    /// What was varied: ``"duration"`` or ``"angle"``.
    #[getter]
    fn what(&self) -> String {
        word(&self.found.quantity)
    }

    /// The smallest duration, s, or largest angle, deg, of an unbroken row of successes; None if none succeeded.
    #[getter]
    fn first_succeeding(&self) -> Option<f64> {
        self.found.first_succeeding
    }

    /// The failure next to it; None if nothing failed.
    #[getter]
    fn last_failing(&self) -> Option<f64> {
        self.found.last_failing
    }

    /// The plan of `first_succeeding`.
    #[getter]
    fn plan(&self, py: Python<'_>) -> Option<Py<Plan>> {
        self.plan.as_ref().map(|plan| plan.clone_ref(py))
    }

    /// Everything tried, in order, a dictionary each: `duration_s`, `succeeded`, `status`, `shortfall`, …
    #[getter]
    fn tries<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.found.tries)
    }

    /// Of a detumble: no motion that stops the arm can leave less angular rate, deg/s.
    #[getter]
    fn bound_deg_s(&self) -> Option<f64> {
        self.found.bound_deg_s
    }

    /// What stands in the way of more, and how sure that is.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.found.notes.clone()
    }

    fn __str__(&self) -> String {
        righting_report::reach_summary(self.scenario.resolved(), &self.found, &[])
    }

    fn __repr__(&self) -> String {
        let unit = match self.found.quantity {
            Quantity::Duration => " s",
            Quantity::Angle => "\u{b0}",
        };
        let shown = |value: Option<f64>| value.map_or("none".to_owned(), |v| format!("{v}{unit}"));
        let [yes, no] = [self.found.first_succeeding, self.found.last_failing].map(shown);
        format!("Reach({}: succeeds at {yes}, fails at {no})", self.what())
    }
}

/// Searches for what is possible: see `righting.reach`, which adds the progress.
#[pyfunction]
#[pyo3(signature = (scenario, what="duration", *, resolution=None, within_percent=None, starts=0, on_iteration=None))]
pub fn reach(
    py: Python<'_>,
    scenario: &Bound<'_, PyAny>,
    what: &str,
    resolution: Option<f64>,
    within_percent: Option<f64>,
    starts: u64,
    on_iteration: Option<Py<PyAny>>,
) -> PyResult<Reach> {
    let scenario = Scenario::of(scenario)?;
    let settings = settings(what, resolution, within_percent, starts)?;
    let mut watch = Watch::new(on_iteration);
    let found = alone(py, || {
        righting_planner::reach(&scenario, settings, &mut |step| match step {
            Progress::Iteration(record) => watch.see(record),
            Progress::Trying { .. } | Progress::Tried(_) => Control::Continue,
        })
    })?;
    watch.end()?;
    let mut found = found.map_err(Failure::from)?;
    let plan = found.plan.take().map(|Reached { scenario, planned }| {
        Py::new(py, Plan::new(scenario, planned.solution, planned.trajectory))
    });
    Ok(Reach { scenario, found, plan: plan.transpose()? })
}

fn settings(
    what: &str,
    resolution: Option<f64>,
    within_percent: Option<f64>,
    starts: u64,
) -> Outcome<ReachSettings> {
    let argument = |name, found: String, expected| Failure::Argument { name, found, expected };
    let quantity = match what {
        "duration" => Quantity::Duration,
        "angle" => Quantity::Angle,
        other => {
            return Err(argument("what", format!("{other:?}"), "\"duration\" or \"angle\""));
        }
    };
    let usual = ReachSettings::new(quantity);
    let resolution = resolution.unwrap_or(usual.resolution);
    if !(0.01..=50.0).contains(&resolution) {
        return Err(argument("resolution", resolution.to_string(), "a number from 0.01 to 50"));
    }
    let within_percent = within_percent.unwrap_or(usual.within_percent);
    if !(0.0..=1000.0).contains(&within_percent) {
        let found = within_percent.to_string();
        return Err(argument("within_percent", found, "a number from 0 to 1000"));
    }
    if starts > MAX_STARTS {
        return Err(argument("starts", starts.to_string(), "at most 1000"));
    }
    Ok(ReachSettings { resolution, within_percent, starts, ..usual })
}
