//! Algorithm IC (W&B section 3.1): the least regularisation that gives the augmented system the
//! inertia of a minimum's.
//!
//! With J of full rank the inertia of the system is that of the reduced Hessian and m positive and
//! m negative eigenvalues more (Gould, *Mathematical Programming* 32, 1985). So more than m
//! negative ones ask for more convexity, δ_w; fewer than m, or a zero, cannot be with J of full
//! rank, and ask for δ_c. Two things differ from the printed algorithm:
//!
//! - Fewer than m negative eigenvalues may as well be a factorisation that is not accurate enough.
//!   The same matrix is factorised again with a larger pivot tolerance first.
//! - δ_c alone is tried before δ_w joins it: if only J lacks rank there is no reason to change the
//!   Hessian and with it the step.
//!
//! A first matrix of all that is singular is not regularised: that such a problem is degenerate
//! everywhere is for Ipopt to find out.

use righting_nlp::{Factorization, LinearSolver, Options};

use crate::error::FailureReason;
use crate::linear_system::{LinearSystem, Regularization};

/// κ̄_w⁺: growth of δ_w before any was needed (option `perturb_inc_fact_first`).
const FIRST_GROWTH: f64 = 100.0;
/// κ_w⁺: its growth later (option `perturb_inc_fact`).
const GROWTH: f64 = 8.0;
/// κ_w⁻: what the last δ_w is reduced by to begin with (option `perturb_dec_fact`).
const REDUCTION: f64 = 1.0 / 3.0;
/// κ_c: δ_c is δ̄_c μ to this power (option `jacobian_regularization_exponent`).
const CONSTRAINT_EXPONENT: f64 = 0.25;

/// The last regularisation that was needed, and what bounds the next.
pub(crate) struct InertiaCorrection {
    /// δ̄_w⁰ (option `first_hessian_perturbation`).
    first: f64,
    /// δ̄_w^min (option `min_hessian_perturbation`).
    least: f64,
    /// δ̄_w^max (option `max_hessian_perturbation`).
    most: f64,
    /// δ̄_c (option `jacobian_regularization_value`).
    constraint: f64,
    /// δ_w^last.
    last: f64,
    /// Whether some matrix was regular with no constraint regularised.
    is_settled: bool,
}

impl InertiaCorrection {
    pub(crate) fn new(options: &Options) -> Self {
        Self {
            first: options.first_hessian_perturbation,
            least: options.min_hessian_perturbation,
            most: options.max_hessian_perturbation,
            constraint: options.jacobian_regularization_value,
            last: 0.0,
            is_settled: false,
        }
    }

    /// Factorises with these barrier terms Σ of w, and whatever regularisation gives the right
    /// inertia. Returns δ_w.
    pub(crate) fn factor<L: LinearSolver + ?Sized>(
        &mut self,
        system: &mut LinearSystem<'_, L>,
        sigma: &[f64],
        mu: f64,
    ) -> Result<f64, FailureReason> {
        let constraints = system.matrix.constraints();
        let mut added = Regularization::default();
        let mut may_raise_tolerance = true;
        loop {
            match system.factor(sigma, added) {
                outcome if system.has_right_inertia(outcome) => break,
                Factorization::Failed => return Err(FailureReason::StepComputation),
                Factorization::Regular { negative_eigenvalues: n } if n < constraints => {
                    if may_raise_tolerance && system.raise_pivot_tolerance() {
                        may_raise_tolerance = false;
                        continue;
                    }
                    added = self.after_singular(added, mu)?;
                }
                Factorization::Singular if constraints > 0 => {
                    added = self.after_singular(added, mu)?;
                }
                Factorization::Regular { .. } | Factorization::Singular => {
                    self.is_settled = true;
                    added.primal = self.larger(added.primal)?;
                }
            }
        }
        self.is_settled = true;
        if added.primal > 0.0 {
            self.last = added.primal;
        }
        Ok(added.primal)
    }

    /// The next regularisation after a singular matrix, or one with too few negative eigenvalues.
    fn after_singular(
        &self,
        added: Regularization,
        mu: f64,
    ) -> Result<Regularization, FailureReason> {
        if !self.is_settled {
            return Err(FailureReason::StepComputation);
        }
        let constraint = self.constraint * mu.powf(CONSTRAINT_EXPONENT);
        if constraint > added.constraint {
            return Ok(Regularization { constraint, ..added });
        }
        Ok(Regularization { primal: self.larger(added.primal)?, ..added })
    }

    /// The next δ_w after one that was too small (steps IC-3, IC-5 and IC-6).
    fn larger(&self, primal: f64) -> Result<f64, FailureReason> {
        let larger = if primal == 0.0 {
            if self.last == 0.0 { self.first } else { self.least.max(REDUCTION * self.last) }
        } else if self.last == 0.0 {
            FIRST_GROWTH * primal
        } else {
            GROWTH * primal
        };
        if larger > self.most { Err(FailureReason::StepComputation) } else { Ok(larger) }
    }
}
