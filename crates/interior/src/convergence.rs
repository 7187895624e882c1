use righting_nlp::{Options, Status};

use crate::iterate::Iterate;
use crate::norm::max_norm;
use crate::optimality_error::{OptimalityError, complementarity};

/// When a solve ends: W&B eq. 6, and the tests that the options of Ipopt's section *Termination*
/// document.
#[derive(Debug, Default)]
pub(crate) struct ConvergenceCheck {
    /// How many iterates in a row were acceptable (option `acceptable_iter`).
    acceptable: u32,
}

impl ConvergenceCheck {
    /// The status to end with here, if any.
    pub(crate) fn status(
        &mut self,
        options: &Options,
        objective_scale: f64,
        variables: usize,
        errors: &OptimalityError,
        iterate: &Iterate,
        iteration: usize,
    ) -> Option<Status> {
        let complementarity = complementarity(iterate, 0.0);
        let error = (errors.dual / errors.dual_scale)
            .max(errors.violation)
            .max(complementarity / errors.complementarity_scale);
        let within = |tolerance, dual, violation, unscaled_complementarity| {
            error <= tolerance
                && errors.dual / objective_scale <= dual
                && errors.unscaled_violation <= violation
                && complementarity / objective_scale <= unscaled_complementarity
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
        // The start does not count: from it the objective has not changed yet (option
        // `acceptable_obj_change_tol`).
        self.acceptable = if is_acceptable && iteration > 0 { self.acceptable + 1 } else { 0 };
        if options.acceptable_iter > 0 && self.acceptable >= options.acceptable_iter {
            return Some(Status::Acceptable);
        }
        if max_norm(&iterate.point.w[..variables]) > options.diverging_iterates_tol {
            return Some(Status::Diverging);
        }
        (iteration >= options.max_iterations as usize).then_some(Status::IterationLimit)
    }
}
