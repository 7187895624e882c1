use righting_nlp::Options;

use crate::iterate::Iterate;
use crate::optimality_error::{OptimalityError, complementarity};

/// τ_min, the least fraction to the boundary (W&B eq. 8; option `tau_min`).
const TAU_MIN: f64 = 0.99;

/// The barrier parameter μ and the fraction to the boundary τ that goes with it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BarrierParameter {
    pub(crate) mu: f64,
    pub(crate) tau: f64,
}

impl BarrierParameter {
    pub(crate) fn new(mu: f64) -> Self {
        // W&B eq. 8.
        Self { mu, tau: TAU_MIN.max(1.0 - mu) }
    }

    /// Goes on to the next barrier problem if this one is solved (W&B eq. 7), or over several that
    /// are (option `mu_allow_fast_monotone_decrease`). Returns whether it did.
    ///
    /// The last μ is not the ε_tol/10 that W&B print. A barrier problem solved to κ_ε μ has
    /// |δ z − μ| ≤ κ_ε μ, so δ z ≤ (κ_ε + 1) μ, and this is within the tolerance of complementarity
    /// where μ is that tolerance over κ_ε + 1.
    pub(crate) fn update(
        &mut self,
        options: &Options,
        objective_scale: f64,
        errors: &OptimalityError,
        iterate: &Iterate,
    ) -> bool {
        let factor = options.barrier_tol_factor;
        let tolerance = options.tolerance.min(objective_scale * options.compl_inf_tol);
        let before = self.mu;
        while (errors.dual / errors.dual_scale)
            .max(errors.primal)
            .max(complementarity(iterate, self.mu) / errors.complementarity_scale)
            <= factor * self.mu
        {
            let linear = options.mu_linear_decrease_factor * self.mu;
            let superlinear = self.mu.powf(options.mu_superlinear_decrease_power);
            let next = linear.min(superlinear).max(tolerance / (factor + 1.0));
            if next == self.mu {
                break;
            }
            *self = Self::new(next);
        }
        self.mu != before
    }
}
