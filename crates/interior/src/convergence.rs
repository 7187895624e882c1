//! When a solve ends, and when a barrier problem does. (Wächter & Biegler 2006, section 2.1.)

use righting_nlp::{LinearSolver, Problem, Status};

use crate::line_search::Watchdog;
use crate::method::{Method, TAU_MIN};
use crate::point::Point;
use crate::program::Row;
use crate::{larger, largest};

/// Multipliers larger than this on average are divided out of the errors.
const S_MAX: f64 = 100.0;

/// How far the current iterate is from a solution of the scaled problem; maximum norms.
pub(crate) struct Errors {
    pub(crate) dual: f64,
    /// Of the residuals.
    pub(crate) primal: f64,
    /// Of the constraints: how far g is from where it should be.
    violation: f64,
    unscaled_violation: f64,
    /// What dual errors and complementarity are divided by.
    dual_scale: f64,
    complementarity_scale: f64,
}

impl<P, L> Method<'_, P, L>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    /// Whether to stop here.
    pub(crate) fn ends(&mut self, errors: &Errors, count: usize) -> Option<Status> {
        let options = self.options;
        let complementarity = self.complementarity(0.0);
        let error = (errors.dual / errors.dual_scale)
            .max(errors.violation)
            .max(complementarity / errors.complementarity_scale);
        let scale = self.program.objective_scale;
        let within = |tolerance, dual, violation, unscaled_complementarity| {
            error <= tolerance
                && errors.dual / scale <= dual
                && errors.unscaled_violation <= violation
                && complementarity / scale <= unscaled_complementarity
        };
        if within(
            options.tolerance,
            options.dual_inf_tol,
            options.constr_viol_tol,
            options.compl_inf_tol,
        ) {
            return Some(Status::Solved);
        }
        let is_acceptable = within(
            options.acceptable_tol,
            options.acceptable_dual_inf_tol,
            options.acceptable_constr_viol_tol,
            options.acceptable_compl_inf_tol,
        );
        // The start does not count: from it the objective has not changed yet.
        self.acceptable = if is_acceptable && count > 0 { self.acceptable + 1 } else { 0 };
        if options.acceptable_iter > 0 && self.acceptable >= options.acceptable_iter {
            return Some(Status::Acceptable);
        }
        if largest(&self.point.w[..self.program.variables()]) > options.diverging_iterates_tol {
            return Some(Status::Diverging);
        }
        (count >= options.max_iterations as usize).then_some(Status::IterationLimit)
    }

    /// Goes on to the next barrier problem, or several, if this one is solved.
    pub(crate) fn lower_barrier(&mut self, errors: &Errors) {
        let options = self.options;
        let factor = options.barrier_tol_factor;
        let tolerance = options.tolerance.min(self.program.objective_scale * options.compl_inf_tol);
        let before = self.mu;
        while (errors.dual / errors.dual_scale)
            .max(errors.primal)
            .max(self.complementarity(self.mu) / errors.complementarity_scale)
            <= factor * self.mu
        {
            let linear = options.mu_linear_decrease_factor * self.mu;
            let superlinear = self.mu.powf(options.mu_superlinear_decrease_power);
            let next = linear.min(superlinear).max(tolerance / (factor + 1.0));
            if next == self.mu {
                break;
            }
            self.mu = next;
            self.tau = TAU_MIN.max(1.0 - next);
        }
        if self.mu != before {
            self.filter.reset();
            self.watchdog = Watchdog::default();
        }
    }

    pub(crate) fn errors(&self) -> Errors {
        let Point { residuals, distances, .. } = &self.point;
        let program = &self.program;
        let (mut violation, mut unscaled_violation) = (0.0_f64, 0.0_f64);
        let mut outside = |row: usize, by: f64| {
            violation = violation.max(by);
            unscaled_violation = unscaled_violation.max(by / program.row_scale(row));
        };
        for (row, (kind, c)) in program.rows.iter().zip(residuals).enumerate() {
            if let Row::Equality(_) = kind {
                outside(row, c.abs());
            }
        }
        for (bound, distance) in program.bounds.iter().zip(distances) {
            if let Some(slack) = bound.index().checked_sub(program.variables()) {
                let row = program.slack_rows[slack];
                outside(row, -(distance + bound.sign() * residuals[row]));
            }
        }
        let sum_z: f64 = self.z.iter().sum();
        let sum_y: f64 = self.y.iter().map(|y| y.abs()).sum();
        let scale = |sum: f64, count: usize| match count {
            0 => 1.0,
            _ => (sum / count as f64).max(S_MAX) / S_MAX,
        };
        Errors {
            dual: largest(&self.lagrangian),
            primal: largest(residuals),
            violation,
            unscaled_violation,
            dual_scale: scale(sum_y + sum_z, self.y.len() + self.z.len()),
            complementarity_scale: scale(sum_z, self.z.len()),
        }
    }

    /// max |d z − μ|.
    fn complementarity(&self, mu: f64) -> f64 {
        let products = self.point.distances.iter().zip(&self.z);
        products.map(|(distance, z)| (distance * z - mu).abs()).fold(0.0, larger)
    }
}
