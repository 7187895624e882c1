//! What a solution is by its own residuals, whatever the optimizer says of it.

use righting_ipopt::SolveError;
use righting_nlp::{Declarations, Multipliers, OptimalityResiduals, Options, Status};

use crate::multiple_shooting::MultipleShooting;
use crate::ocp_solution::OcpSolution;

/// So many times the tolerance the residuals may be: an optimizer puts its last point back within bounds that it has
/// relaxed, and its tolerance is one of the problem as it scales it. Over the shipped scenarios they are up to 94
/// times as large.
const SOLVED: f64 = 1e3;
/// The same of the acceptable tolerance.
const ACCEPTABLE: f64 = 1e2;

impl MultipleShooting<'_> {
    /// Computes the residuals of a solution of this program anew, and the status that they deserve.
    pub(crate) fn judge(
        &mut self,
        solution: &mut OcpSolution,
        options: &Options,
    ) -> Result<(), SolveError> {
        let declared = Declarations::of(self)?;
        let point = &solution.point;
        let multipliers = Multipliers {
            constraints: point.constraints.clone(),
            lower: point.lower.clone(),
            upper: point.upper.clone(),
        };
        // Where the problem is not defined there is nothing to say, and the optimizer has said so.
        let residuals = OptimalityResiduals::of(self, &declared, &point.z, &multipliers).ok();
        if let Some(residuals) = residuals {
            solution.constraint_violation = residuals.violation;
            solution.status = verdict(solution.status, &residuals, options);
        }
        solution.residuals = residuals;
        Ok(())
    }
}

/// The status of a point with such residuals, at which an optimizer ended with `status`.
fn verdict(status: Status, residuals: &OptimalityResiduals, options: &Options) -> Status {
    let (solved, acceptable) = (options.tolerance, options.acceptable_tol);
    // The objective misses its optimum by the sum of all products: at 5e-6 each a slew costs 1.3 % too much. Where an
    // optimizer stopped for another reason, none may be above the tolerance itself.
    let is_within = |tolerance: f64, times: f64| {
        residuals.largest() <= times * tolerance
            && (status.is_success() || residuals.complementarity <= tolerance)
    };
    match status {
        _ if is_within(solved, SOLVED) => Status::Solved,
        _ if is_within(acceptable, ACCEPTABLE) => Status::Acceptable,
        status if status.is_success() => Status::Unconfirmed,
        status => status,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn residuals(stationarity: f64, complementarity: f64) -> OptimalityResiduals {
        OptimalityResiduals { stationarity, violation: 0.0, complementarity }
    }

    #[test]
    fn residuals_decide_whatever_the_optimizer_says() {
        let options = Options { tolerance: 1e-8, acceptable_tol: 1e-6, ..Options::default() };
        let cases = [
            (Status::Solved, 1e-9, 1e-9, Status::Solved),
            (Status::Solved, 1e-9, 5e-6, Status::Solved),
            (Status::Solved, 5e-5, 1e-9, Status::Acceptable),
            (Status::Solved, 1e-3, 1e-9, Status::Unconfirmed),
            (Status::Solved, f64::NAN, 0.0, Status::Unconfirmed),
            (Status::SearchDirectionTooSmall, 1e-9, 1e-9, Status::Solved),
            (Status::RestorationFailed, 5e-5, 1e-9, Status::Acceptable),
            // On the central path, far from its end.
            (Status::IterationLimit, 1e-9, 5e-7, Status::Acceptable),
            (Status::IterationLimit, 1e-9, 5e-6, Status::IterationLimit),
            (Status::IterationLimit, 1e-3, 1e-9, Status::IterationLimit),
            (Status::Infeasible, f64::NAN, 0.0, Status::Infeasible),
        ];
        for (by_optimizer, stationarity, complementarity, expected) in cases {
            let found = verdict(by_optimizer, &residuals(stationarity, complementarity), &options);
            assert_eq!(found, expected, "{by_optimizer:?}, {stationarity}, {complementarity}");
        }
    }
}
