use std::collections::HashSet;

use pyo3::prelude::*;
use righting_analysis::PowerProfile;
use righting_report::{ComparedNumbers, ComparedPlan, compare_html, comparison_table};

use crate::failure::{Failure, Outcome};
use crate::json::to_python;
use crate::plan::Plan;

/// More scenes than these a browser does not draw at a time.
const MOST_PLANS: usize = 12;

/// Plans side by side; its text is the table of `righting compare`.
#[pyclass(frozen, module = "righting")]
pub struct Comparison {
    names: Vec<String>,
    plans: Vec<Py<Plan>>,
    profiles: Vec<PowerProfile>,
}

impl Comparison {
    fn plans(&self) -> Vec<ComparedPlan<'_>> {
        let plans = self.names.iter().zip(&self.plans).zip(&self.profiles);
        plans
            .map(|((name, plan), profile)| {
                let Plan { scenario, solution, trajectory, .. } = plan.get();
                ComparedPlan { name, scenario, solution, trajectory, profile }
            })
            .collect()
    }
}

#[pymethods]
impl Comparison {
    /// What the plans are called, in order.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// One dictionary a plan: end, duration, effort, torque, power, energy and how near it comes to its limits
    /// (`smallest_margins`), with units in the names.
    #[getter]
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.plans().iter().map(ComparedNumbers::of).collect::<Vec<_>>())
    }

    /// The interactive page, the plans on one clock with overlaid plots: an HTML document.
    fn page(&self) -> String {
        compare_html(&self.plans())
    }

    /// Shows the interactive page: inline in a notebook, `height` pixels high; elsewhere in a browser, and the file is
    /// returned.
    #[pyo3(signature = (*, height = 760))]
    fn show<'py>(slf: &Bound<'py, Self>, height: u32) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("righting._show")?.call_method1("show", (slf, height))
    }

    fn __str__(&self) -> String {
        comparison_table(&self.plans())
    }

    fn __repr__(&self) -> String {
        format!("Comparison({})", self.names.join(", "))
    }
}

/// Puts plans side by side.
///
/// Parameters
/// ----------
/// plans
///     2 to 12 plans.
/// names
///     What each is called; by default the names of their scenarios.
///
/// Raises
/// ------
/// InputError
///     The number of plans is not 2 to 12, or the names are not as many and distinct.
/// NoPlanError
///     There is no motion in one of them.
#[pyfunction]
#[pyo3(signature = (plans, names = None))]
pub fn compare(
    py: Python<'_>,
    plans: Vec<Py<Plan>>,
    names: Option<Vec<String>>,
) -> PyResult<Comparison> {
    if !(2..=MOST_PLANS).contains(&plans.len()) {
        let found = format!("{} of them", plans.len());
        return Err(Failure::Argument { name: "plans", found, expected: "2 to 12 plans" }.into());
    }
    if let Some(none) = plans.iter().map(Py::get).find(|plan| !plan.solution.has_plan()) {
        return Err(Failure::NoPlan(none.solution.status).into());
    }
    let names = match names {
        Some(names) => checked(names, plans.len())?,
        None => default_names(&plans),
    };
    let profiles = plans.iter().map(Py::get);
    let profiles = profiles
        .map(|plan| py.detach(|| PowerProfile::new(&plan.scenario, &plan.trajectory)))
        .collect::<Result<Vec<_>, _>>()
        .map_err(Failure::from)?;
    Ok(Comparison { names, plans, profiles })
}

fn checked(names: Vec<String>, plans: usize) -> Outcome<Vec<String>> {
    let distinct: HashSet<&String> = names.iter().collect();
    match names.len() == plans && distinct.len() == plans {
        true => Ok(names),
        false => Err(Failure::Argument {
            name: "names",
            found: format!("{names:?}"),
            expected: "one name a plan, all different",
        }),
    }
}

/// Those of the scenarios, with their numbers where two would be the same.
fn default_names(plans: &[Py<Plan>]) -> Vec<String> {
    let names = plans.iter().map(|plan| plan.get().scenario.name());
    let distinct: HashSet<&str> = names.clone().collect();
    match distinct.len() == plans.len() {
        true => names.map(str::to_owned).collect(),
        false => names.enumerate().map(|(i, name)| format!("{name} ({})", i + 1)).collect(),
    }
}
