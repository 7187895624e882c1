use righting_nlp::Problem;

use crate::barrier::{barrier, distances};
use crate::filter::Merit;
use crate::program::Program;
use crate::{GivesUp, are_finite};

/// A point w with what is evaluated there.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) w: Vec<f64>,
    pub(crate) objective: f64,
    /// The barrier term, to be multiplied by μ.
    barrier: f64,
    pub(crate) residuals: Vec<f64>,
    pub(crate) distances: Vec<f64>,
    /// 1-norm of the residuals.
    pub(crate) violation: f64,
    /// Whether a bound has to move for the distances to be so large.
    pub(crate) moves_bounds: bool,
}

impl Point {
    pub(crate) fn at(w: Vec<f64>, constraints: usize, bounds: usize) -> Self {
        Self {
            w,
            objective: f64::NAN,
            barrier: f64::NAN,
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
    ) -> Result<(), GivesUp> {
        self.objective = program.objective(&self.w[..program.variables()])?;
        program.residuals(&self.w, &mut self.residuals)?;
        self.violation = self.residuals.iter().map(|c| c.abs()).sum();
        self.moves_bounds = distances(&program.bounds, &self.w, z, mu, &mut self.distances);
        self.barrier = barrier(&program.bounds, &self.distances);
        if self.barrier.is_finite() { Ok(()) } else { Err(GivesUp::Undefined) }
    }

    pub(crate) fn merit(&self, mu: f64) -> Merit {
        Merit { violation: self.violation, barrier: self.objective + mu * self.barrier }
    }
}

/// A step of all unknowns.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    pub(crate) w: Vec<f64>,
    pub(crate) y: Vec<f64>,
    pub(crate) z: Vec<f64>,
}

impl Step {
    pub(crate) fn is_finite(&self) -> bool {
        let Self { w, y, z } = self;
        are_finite(w) && are_finite(y) && are_finite(z)
    }
}
