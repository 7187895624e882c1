use pyo3::prelude::*;

use crate::check::Check;

/// What the independent check of a plan found: by another model of the system and another integrator than the
/// planner's. It is true where every check passed.
#[pyclass(frozen, module = "righting")]
pub struct Verification(righting_results::Verification);

impl Verification {
    pub fn of(verification: righting_results::Verification) -> Self {
        Self(verification)
    }
}

#[pymethods]
impl Verification {
    /// Whether every check passed. A plan that did not converge is not checked, and has not.
    #[getter]
    fn passed(&self) -> bool {
        self.0.passed
    }

    /// Largest change of the angular momentum along the nodes, relative to the largest momentum of the arm or of
    /// the system along it.
    #[getter]
    fn momentum_drift(&self) -> f64 {
        self.0.momentum_drift
    }

    /// Largest angle between the plan's attitude and the second integration's, rad.
    #[getter]
    fn attitude_mismatch_rad(&self) -> f64 {
        self.0.attitude_mismatch
    }

    /// Largest difference in a joint angle, rad.
    #[getter]
    fn joint_mismatch_rad(&self) -> f64 {
        self.0.joint_mismatch
    }

    /// Largest difference in the base's position, m.
    #[getter]
    fn position_mismatch_m(&self) -> f64 {
        self.0.position_mismatch
    }

    /// Every check, at its worst place.
    #[getter]
    fn checks(&self) -> Vec<Check> {
        self.0.checks.iter().map(Check::of).collect()
    }

    /// The checks that failed.
    #[getter]
    fn failures(&self) -> Vec<Check> {
        self.0.failures().map(Check::of).collect()
    }

    fn __bool__(&self) -> bool {
        self.0.passed
    }

    fn __repr__(&self) -> String {
        let (checks, failed) = (self.0.checks.len(), self.0.failures().count());
        match (self.0.passed, self.0.failures().next()) {
            (true, _) => format!("Verification(passed: {checks} checks)"),
            (false, Some(first)) => {
                format!("Verification(FAILED: {failed} of {checks} checks, first {first})")
            }
            (false, None) => "Verification(not made: the plan did not converge)".to_owned(),
        }
    }
}
