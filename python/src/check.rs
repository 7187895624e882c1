use pyo3::prelude::*;
use righting_results::Sense;

/// One check of a verification, at the place where it is closest to failing or fails most.
#[pyclass(frozen, get_all, module = "righting")]
#[derive(Clone)]
pub struct Check {
    /// What was checked.
    name: String,
    /// The joint, link, pair of links or instrument, where the check has one.
    subject: Option<String>,
    /// The value at the worst place.
    value: f64,
    /// What the value must not exceed (`sense` is ``"at_most"``) or fall below (``"at_least"``).
    limit: f64,
    /// ``"at_most"`` or ``"at_least"``.
    sense: &'static str,
    /// How far past the limit still passes.
    tolerance: f64,
    /// Unit of value, limit and tolerance; empty for a pure number.
    unit: String,
    /// Time of the worst place, s, where the check has one.
    time_s: Option<f64>,
    /// Whether it is about a limit that holds along the way.
    is_limit: bool,
    /// Whether it passed.
    passed: bool,
    /// The check in one line.
    text: String,
}

impl Check {
    pub fn of(check: &righting_results::Check) -> Self {
        Self {
            name: check.name.clone(),
            subject: check.subject.clone(),
            value: check.value,
            limit: check.limit,
            sense: match check.sense {
                Sense::AtMost => "at_most",
                Sense::AtLeast => "at_least",
            },
            tolerance: check.tolerance,
            unit: check.unit.clone(),
            time_s: check.time_s,
            is_limit: check.is_limit,
            passed: check.passed,
            text: check.to_string(),
        }
    }
}

#[pymethods]
impl Check {
    fn __repr__(&self) -> String {
        let verdict = if self.passed { "passed" } else { "FAILED" };
        format!("Check({verdict}: {})", self.text)
    }
}
