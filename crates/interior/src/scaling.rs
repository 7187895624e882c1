use righting_nlp::{Declarations, Options};

use crate::norm::max_norm;

/// Factors of the functions, so that no gradient at the start is larger than g_max (W&B section
/// 3.8; options `nlp_scaling_max_gradient` and `nlp_scaling_min_value`).
#[derive(Debug)]
pub(crate) struct GradientScaling {
    /// s_f = min(1, g_max / ‖∇f‖∞).
    pub(crate) objective: f64,
    /// s_c of each constraint, likewise, if any is not one.
    pub(crate) constraints: Option<Vec<f64>>,
}

impl GradientScaling {
    pub(crate) fn none() -> Self {
        Self { objective: 1.0, constraints: None }
    }

    /// From ∇f and the values of the Jacobian at the start.
    pub(crate) fn of(
        declared: &Declarations,
        options: &Options,
        gradient: &[f64],
        jacobian: &[f64],
    ) -> Self {
        let (most, least) = (options.nlp_scaling_max_gradient, options.nlp_scaling_min_value);
        let factor = |steepest: f64| match steepest > most {
            true => (most / steepest).max(least),
            false => 1.0,
        };
        let mut steepest = vec![0.0_f64; declared.constraints];
        for (&row, value) in declared.jacobian.rows.iter().zip(jacobian) {
            let row = &mut steepest[row as usize];
            *row = row.max(value.abs());
        }
        let constraints: Vec<f64> = steepest.into_iter().map(factor).collect();
        let is_scaled = constraints.iter().any(|factor| *factor != 1.0);
        Self {
            objective: factor(max_norm(gradient)),
            constraints: is_scaled.then_some(constraints),
        }
    }

    pub(crate) fn of_row(&self, row: usize) -> f64 {
        self.constraints.as_ref().map_or(1.0, |scales| scales[row])
    }
}
