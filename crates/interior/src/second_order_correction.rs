//! Second-order corrections of the first trial step (W&B section 2.4, steps ).

use righting_nlp::{LinearSolver, Problem};

use crate::error::FailureReason;
use crate::filter::{Filter, ReferencePoint};
use crate::primal_point::PrimalPoint;
use crate::state::State;

/// κ_soc: a correction must leave less than this of the violation for another one to be tried
/// (option `kappa_soc`).
const KAPPA_SOC: f64 = 0.99;

/// Tries corrections after a first trial point, at the step length `tested`, whose violation is not
/// less than the iterate's; at most `max_soc`. The length of the step that is accepted, whose
/// direction replaces the state's.
pub(crate) fn correct<P: Problem + ?Sized, L: LinearSolver + ?Sized>(
    state: &mut State<'_, P, L>,
    trial: &mut PrimalPoint,
    filter: &mut Filter,
    reference: &ReferencePoint,
    tested: f64,
) -> Result<Option<f64>, FailureReason> {
    if state.options.max_soc == 0 {
        return Ok(None);
    }
    let direction = state.direction.clone();
    let mut residuals = state.iterate.point.residuals.clone();
    let mut length = tested;
    let mut violation_before = f64::INFINITY;
    for _ in 0..state.options.max_soc {
        if trial.violation > KAPPA_SOC * violation_before {
            break;
        }
        violation_before = trial.violation;
        // W&B eq. 27.
        for (c, trial) in residuals.iter_mut().zip(&trial.residuals) {
            *c = trial + length * *c;
        }
        let State { newton, program, iterate, barrier, direction, .. } = state;
        newton.solve(program, iterate, barrier.mu, &residuals, direction);
        length = state.longest_step();
        if !state.direction.is_finite() || !state.try_step(length, trial)? {
            break;
        }
        let measures = trial.measures(state.barrier.mu);
        if filter.accepts(reference, tested, &measures) {
            filter.augment(reference, tested, &measures);
            return Ok(Some(length));
        }
    }
    state.direction = direction;
    Ok(None)
}
