use pyo3::prelude::*;
use righting_results::IterationRecord;

/// The optimizer after one iteration.
#[pyclass(frozen, get_all, module = "righting")]
pub struct Iteration {
    /// Number of the iteration; 0 is the starting point.
    iteration: usize,
    /// Objective, in the scenario's weights.
    objective: f64,
    /// Largest violation of a constraint, unscaled.
    primal_infeasibility: f64,
    /// Dual infeasibility.
    dual_infeasibility: f64,
    /// Barrier parameter.
    barrier_parameter: f64,
}

impl Iteration {
    pub fn of(record: &IterationRecord) -> Self {
        Self {
            iteration: record.iteration,
            objective: record.objective,
            primal_infeasibility: record.primal_infeasibility,
            dual_infeasibility: record.dual_infeasibility,
            barrier_parameter: record.barrier_parameter,
        }
    }
}

#[pymethods]
impl Iteration {
    fn __repr__(&self) -> String {
        let Self { iteration, objective, primal_infeasibility, .. } = self;
        format!(
            "Iteration({iteration}, objective={objective:e}, primal_infeasibility={primal_infeasibility:e})"
        )
    }
}
