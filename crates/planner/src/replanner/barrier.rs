//! How far from the end of its central path a replan stops.
//!
//! An interior-point method starts badly from a solution whose bounds are in force to the last digit: the first steps
//! are cut where they would pass one (Wright, *Primal-Dual Interior-Point Methods*, SIAM 1997, ch. 11). So all solutions
//! of a replanner belong to one barrier parameter, and each is the start of the next.

use righting_ocp::{
    Control, InitialGuess, MultipleShooting, OcpError, OcpSolution, OcpStart, Settings,
    close_guess_settings, warm_start_settings,
};
use righting_scenario::Maneuver;

use crate::search::settings::from_own_plan;

/// The barrier parameters that are tried, for objectives of one or more. Smaller objectives have theirs smaller.
const BARRIERS: [f64; 5] = [1e-5, 3e-6, 1e-6, 3e-7, 1e-7];
/// An objective counts as at least this.
const SMALLEST: f64 = 1e-3;
/// What the barrier may cost, as a share of the objective.
const COST: f64 = 1e-4;
/// The same of a detumble, whose objective is for the most part what no arm can take out.
const COST_OF_DETUMBLE: f64 = 1e-6;

/// The interior solver ends with its tolerance over one more than `barrier_tol_factor`.
const TOLERANCE: f64 = 11.0;
/// Gaps and limits are kept to this, whatever the tolerance.
const FEASIBILITY: f64 = 1e-6;
/// Iterations after which a replan is given up: most need three.
const ITERATIONS: u32 = 40;
/// The same of one from a motion without multipliers.
const ITERATIONS_FROM_MOTION: u32 = 300;

/// The largest barrier parameter that costs a plan little, and the solution there.
///
/// # Errors
/// [`OcpError`] of the solves.
pub(super) fn costing_little(
    program: &mut MultipleShooting<'_>,
    maneuver: &Maneuver,
    optimum: OcpSolution,
    settings: &Settings,
) -> Result<(f64, OcpSolution), OcpError> {
    let cost = match maneuver {
        Maneuver::Slew(_) => COST,
        Maneuver::Detumble => COST_OF_DETUMBLE,
    };
    let motion = OcpStart::Guess(InitialGuess {
        states: optimum.states.clone(),
        controls: optimum.controls.clone(),
    });
    let most = optimum.objective + cost * optimum.objective.abs();
    let size = optimum.objective.abs().clamp(SMALLEST, 1.0);
    let mut solution = optimum;
    let mut barrier = size;
    for share in BARRIERS {
        barrier = share * size;
        let found = program.solve(&motion, &centered(settings, barrier), |_| Control::Continue)?;
        if found.status.is_success() {
            let is_close = found.objective <= most;
            solution = found;
            if is_close {
                return Ok((barrier, solution));
            }
        }
    }
    Ok((barrier, solution))
}

/// Settings of a start from a solution of another barrier parameter: its multipliers would count as converged.
fn centered(settings: &Settings, barrier: f64) -> Settings {
    let mut settings = from_own_plan(settings.clone());
    let ipopt = &mut settings.ipopt;
    ipopt.mu_init = barrier;
    for push in [
        &mut ipopt.bound_push,
        &mut ipopt.bound_frac,
        &mut ipopt.slack_bound_push,
        &mut ipopt.slack_bound_frac,
    ] {
        *push = barrier;
    }
    ended_at(settings, barrier)
}

/// Settings of a start from the last solution.
pub(super) fn warm(settings: &Settings, barrier: f64) -> Settings {
    let mut settings = warm_start_settings(settings, barrier);
    let ipopt = &mut settings.ipopt;
    for push in [
        &mut ipopt.warm_start_bound_push,
        &mut ipopt.warm_start_bound_frac,
        &mut ipopt.warm_start_slack_bound_push,
        &mut ipopt.warm_start_slack_bound_frac,
    ] {
        *push = barrier;
    }
    // Near its solution Newton's method needs no line search. Over 30 replans of three slews steps that are taken as
    // they are save two to four iterations in the median.
    ipopt.accept_after_max_steps = 0;
    ipopt.max_soc = 0;
    ended_at(settings, barrier)
}

/// Settings of a start from a motion.
pub(super) fn from_motion(settings: &Settings, barrier: f64) -> Settings {
    let mut settings = ended_at(close_guess_settings(settings), barrier);
    settings.ipopt.max_iterations = ITERATIONS_FROM_MOTION;
    settings
}

fn ended_at(mut settings: Settings, barrier: f64) -> Settings {
    let ipopt = &mut settings.ipopt;
    ipopt.tolerance = TOLERANCE * barrier;
    ipopt.constr_viol_tol = FEASIBILITY;
    ipopt.max_iterations = ipopt.max_iterations.min(ITERATIONS);
    settings
}
