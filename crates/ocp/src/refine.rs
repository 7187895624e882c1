use righting_nlp::{Control, Iteration, MultiplierInitialization, Options, Status};

use crate::error::OcpError;
use crate::grid::Grid;
use crate::nlp::MultipleShooting;
use crate::point::Point;
use crate::solution::Solution;
use crate::solve::{Optimizer, Settings};
use crate::stage::StageFunctions;
use crate::start::{Guess, Start};

/// How close to their bounds the variables and multipliers of a warm start may stay: it is nearly
/// optimal, and pushing it back inside would undo that.
const WARM_PUSH: f64 = 1e-9;
/// The same for a guess without multipliers, which are only estimated.
const GUESS_PUSH: f64 = 1e-6;
/// Barrier parameter of such a guess.
const GUESS_BARRIER: f64 = 1e-6;
/// Barrier parameter on the grids between the first and the asked one. Their active bounds are not yet
/// those of the plan: further from them there are fewer steps that a bound cuts short.
const BETWEEN_BARRIER: f64 = 5e-7;
/// Tolerance there: what is solved more tightly, the next grid changes again.
const BETWEEN_TOLERANCE: f64 = 1e-6;
/// Iterations after which a warm start is given up. Most need a tenth of them; where the optimum is
/// nearly flat in some direction, so small a barrier parameter lets none converge.
const WARM_ITERATIONS: u32 = 200;

/// Settings for a grid on the way, whose solution is only a start.
fn between_settings(settings: &Settings) -> Settings {
    let mut between = warm_start_settings(settings, BETWEEN_BARRIER);
    between.ipopt.tolerance = settings.ipopt.tolerance.max(BETWEEN_TOLERANCE);
    // The first barrier problem is the only one.
    between.ipopt.barrier_tol_factor = 1.0;
    between.optimizer = Optimizer::Interior;
    between
}

/// Settings for the asked grid: they begin at the barrier parameter that Ipopt ends with.
fn last_settings(settings: &Settings) -> Settings {
    let Options { tolerance, barrier_tol_factor, .. } = settings.ipopt;
    warm_start_settings(settings, tolerance / (barrier_tol_factor + 1.0))
}

/// Settings for a start with multipliers, at a barrier parameter.
fn warm_start_settings(settings: &Settings, barrier_parameter: f64) -> Settings {
    let ipopt = Options {
        mu_init: barrier_parameter,
        warm_start_bound_push: WARM_PUSH,
        warm_start_bound_frac: WARM_PUSH,
        warm_start_slack_bound_push: WARM_PUSH,
        warm_start_slack_bound_frac: WARM_PUSH,
        warm_start_mult_bound_push: WARM_PUSH,
        max_iterations: settings.ipopt.max_iterations.min(WARM_ITERATIONS),
        ..settings.ipopt.clone()
    };
    Settings { ipopt, retry_at_iteration_limit: false, ..*settings }
}

/// Settings for a guess that is nearly optimal but comes without multipliers: they are estimated
/// from the guess, those of the bounds by their distance from it.
pub fn close_guess_settings(settings: &Settings) -> Settings {
    let ipopt = Options {
        mu_init: GUESS_BARRIER,
        bound_push: GUESS_PUSH,
        bound_frac: GUESS_PUSH,
        slack_bound_push: GUESS_PUSH,
        slack_bound_frac: GUESS_PUSH,
        bound_mult_init_method: MultiplierInitialization::MuBased,
        ..settings.ipopt.clone()
    };
    Settings { ipopt, ..*settings }
}

/// Carries `point`, solved on a coarse grid over the same horizon, to `grid` by way of grids of
/// `between` steps. Where a warm start does not converge, the motion alone is a start, as cold as any.
/// Stops at the first grid on which that fails too: its solution is then the one returned.
///
/// # Errors
/// Those of [`MultipleShooting::new`] and [`MultipleShooting::solve`].
pub fn refine(
    functions: &StageFunctions,
    grid: Grid,
    between: &[usize],
    initial: &[f64],
    mut point: Point,
    settings: &Settings,
    mut on_iteration: impl FnMut(&Iteration) -> Control,
) -> Result<Solution, OcpError> {
    let mut attempts = Vec::new();
    let mut climb = |steps: usize, point: Point, warm: &Settings| -> Result<_, OcpError> {
        let mut program = MultipleShooting::new(functions, grid.with_steps(steps)?, initial)?;
        let point = point.resampled(program.initial_state(), steps);
        let mut solve = |program: &mut MultipleShooting<'_>, start: Start, settings: &Settings| {
            let mut solution = program.solve(&start, settings, &mut on_iteration)?;
            attempts.append(&mut solution.attempts);
            Ok(solution)
        };
        let solution = solve(&mut program, Start::Warm(point.clone()), warm)?;
        if solution.status.is_success() || solution.status == Status::UserStop {
            return Ok(solution);
        }
        let (states, controls) = program.trajectory(&point);
        let ipopt = Options { tolerance: warm.ipopt.tolerance, ..settings.ipopt.clone() };
        let cold = Settings { ipopt, ..*settings };
        solve(&mut program, Start::Guess(Guess { states, controls }), &cold)
    };
    let on_the_way = between_settings(settings);
    for &steps in between {
        let solution = climb(steps, point, &on_the_way)?;
        if !solution.status.is_success() {
            return Ok(Solution { attempts, ..solution });
        }
        point = solution.point;
    }
    let solution = climb(grid.steps(), point, &last_settings(settings))?;
    Ok(Solution { attempts, ..solution })
}
