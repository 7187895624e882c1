use righting_nlp::Problem;

use crate::barrier::{barrier_term, distances};
use crate::error::FailureReason;
use crate::filter::Measures;
use crate::norm::sum_norm;
use crate::program::Program;

/// A point w with the functions there.
#[derive(Debug, Clone)]
pub(crate) struct PrimalPoint {
    pub(crate) w: Vec<f64>,
    pub(crate) objective: f64,
    /// The barrier term, to be multiplied by μ.
    barrier_term: f64,
    pub(crate) residuals: Vec<f64>,
    pub(crate) distances: Vec<f64>,
    /// θ = ‖c(w)‖₁.
    pub(crate) violation: f64,
    /// Whether a bound has to move for the distances to be so large.
    pub(crate) moves_bounds: bool,
}

impl PrimalPoint {
    /// A point where nothing is evaluated yet.
    pub(crate) fn at(w: Vec<f64>, constraints: usize, bounds: usize) -> Self {
        Self {
            w,
            objective: f64::NAN,
            barrier_term: f64::NAN,
            residuals: vec![0.0; constraints],
            distances: vec![0.0; bounds],
            violation: f64::NAN,
            moves_bounds: false,
        }
    }

    pub(crate) fn evaluate<P: Problem + ?Sized>(
        &mut self,
        program: &mut Program<'_, P>,
        z: &[f64],
        mu: f64,
    ) -> Result<(), FailureReason> {
        self.objective = program.objective(&self.w[..program.variables()])?;
        program.residuals(&self.w, &mut self.residuals)?;
        self.violation = sum_norm(&self.residuals);
        self.moves_bounds = distances(&program.bounds, &self.w, z, mu, &mut self.distances);
        self.barrier_term = barrier_term(&program.bounds, &self.distances);
        if self.barrier_term.is_finite() { Ok(()) } else { Err(FailureReason::Undefined) }
    }

    pub(crate) fn measures(&self, mu: f64) -> Measures {
        Measures { violation: self.violation, barrier: self.objective + mu * self.barrier_term }
    }
}
