//! How the optimizer is set for each kind of solve.

use righting_ocp::{
    LinearSolverChoice, MultiplierInitialization, NlpScaling, Optimizer, Options, Settings,
};
use righting_scenario::file;
use righting_scenario::scenario::{Maneuver, Scenario};

/// Tolerance of ranking: tight enough for the barrier not to change the order of small objectives …
const COARSE_TOLERANCE: f64 = 1e-5;
/// … and of a detumble, what not to act would cost times this, …
const DETUMBLE_TOLERANCE: f64 = 1e-6;
/// … up to this.
const MOST_DETUMBLE_TOLERANCE: f64 = 2e-5;
/// Iterations after which a guess on the coarse grid is given up.
const COARSE_ITERATIONS: u32 = 300;
/// A step that is still too long there after so many halvings is taken all the same.
const COARSE_HALVINGS: i32 = 5;
/// After so many shortened steps Ipopt's watchdog tries full ones (by itself after 10). Detumbles end in
/// curved valleys, along which the line search would creep.
const WATCHDOG_TRIGGER: u32 = 3;
/// And so many of them (by itself 3): a step out of the valley takes some to come back to its floor.
const WATCHDOG_TRIALS: u32 = 8;

/// Multipliers of constraints that are estimated from a plan of the very problem may be as large: those of a hard
/// end are.
const LARGEST_MULTIPLIER: f64 = 1e12;
/// From its bounds such a plan is pushed no farther than this.
const SMALLEST_PUSH: f64 = 1e-13;

/// Of a ranked guess on the coarse grid.
pub(super) fn coarse(scenario: &Scenario) -> Settings {
    let mut settings = intermediate(scenario);
    // From far away it saves iterations.
    settings.ipopt.nlp_scaling = NlpScaling::GradientBased;
    settings.ipopt.tolerance = settings.ipopt.tolerance.max(coarse_tolerance(scenario));
    settings.ipopt.max_iterations = settings.ipopt.max_iterations.min(COARSE_ITERATIONS);
    // From so far away corrections of single steps save none.
    settings.ipopt.max_soc = 0;
    settings.ipopt.accept_after_max_steps = COARSE_HALVINGS;
    settings.retry_at_iteration_limit = false;
    // One start of many is not worth a general factorisation.
    if settings.linear_solver == LinearSolverChoice::Auto {
        settings.linear_solver = LinearSolverChoice::Stage;
    }
    settings
}

fn coarse_tolerance(scenario: &Scenario) -> f64 {
    match scenario.maneuver() {
        Maneuver::Slew(_) => COARSE_TOLERANCE,
        Maneuver::Detumble => {
            let rate_rad_s = scenario.initial().angular_rate_rad_s.norm();
            let of_drifting = scenario.weights().angular_rate * rate_rad_s * rate_rad_s;
            (DETUMBLE_TOLERANCE * of_drifting).clamp(COARSE_TOLERANCE, MOST_DETUMBLE_TOLERANCE)
        }
    }
}

/// Of a solve whose solution is only the start of another one.
pub(super) fn intermediate(scenario: &Scenario) -> Settings {
    Settings { optimizer: Optimizer::Interior, judges: false, ..delivered(scenario) }
}

/// Of a solve that ends in a plan.
pub(crate) fn delivered(scenario: &Scenario) -> Settings {
    let plain = plain(scenario);
    Settings {
        ipopt: Options {
            watchdog_shortened_iter_trigger: WATCHDOG_TRIGGER,
            watchdog_trial_iter_max: WATCHDOG_TRIALS,
            // Blocks of dense factors leave residuals near rounding: over the shipped maneuvers Ipopt's
            // check of every step changes no iteration and takes a quarter of the time.
            fast_step_computation: true,
            // The problem is in its own measures already. Scaling by the gradient at the start would loosen
            // the tolerance by as much as the end is missed there.
            nlp_scaling: NlpScaling::None,
            ..plain.ipopt
        },
        judges: true,
        ..plain
    }
}

/// Of a solve from a plan of the very problem, without its multipliers. Those of the bounds are what the plan leaves
/// of the bound tells: the barrier parameter that it ended with over the multiplier.
pub(crate) fn from_own_plan(delivered: Settings) -> Settings {
    Settings {
        ipopt: Options {
            mu_init: delivered.ipopt.last_barrier_parameter(),
            bound_mult_init_method: MultiplierInitialization::MuBased,
            constr_mult_init_max: LARGEST_MULTIPLIER,
            bound_push: SMALLEST_PUSH,
            bound_frac: SMALLEST_PUSH,
            slack_bound_push: SMALLEST_PUSH,
            slack_bound_frac: SMALLEST_PUSH,
            ..delivered.ipopt
        },
        ..delivered
    }
}

/// Of the asked grid from the constant guess: where the scenario asks for that guess, Ipopt is as it is
/// by itself, as the paper used it.
pub(super) fn from_constant_guess(scenario: &Scenario) -> Settings {
    match scenario.solver().is_paper() {
        true => Settings { judges: true, ..plain(scenario) },
        false => delivered(scenario),
    }
}

/// Ipopt's own defaults, and what the scenario says.
fn plain(scenario: &Scenario) -> Settings {
    let solver = scenario.solver();
    Settings {
        ipopt: Options {
            tolerance: solver.tolerance,
            max_iterations: solver.max_iterations as u32,
            ..Options::default()
        },
        optimizer: match solver.optimizer {
            file::Optimizer::Ipopt | file::Optimizer::Auto => Optimizer::Ipopt,
            file::Optimizer::Interior => Optimizer::Interior,
        },
        linear_solver: match solver.linear_solver {
            file::LinearSolverChoice::Auto => LinearSolverChoice::Auto,
            file::LinearSolverChoice::Mumps => LinearSolverChoice::Mumps,
            file::LinearSolverChoice::Stage => LinearSolverChoice::Stage,
        },
        ..Settings::default()
    }
}
