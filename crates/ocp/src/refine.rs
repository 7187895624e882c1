use righting_ipopt::{Control, Iteration, MultiplierInitialization, Options, Status};

use crate::error::OcpError;
use crate::grid::Grid;
use crate::nlp::MultipleShooting;
use crate::point::Point;
use crate::solution::Solution;
use crate::solve::Settings;
use crate::stage::StageFunctions;
use crate::start::Start;

/// How close to their bounds the variables and multipliers of a warm start may stay: it is nearly
/// optimal, and pushing it back inside would undo that.
const WARM_PUSH: f64 = 1e-9;
/// Barrier parameter of a warm start: nearly that of a solved problem.
const WARM_BARRIER: f64 = 1e-8;

/// The same for a guess without multipliers, which are only estimated.
const GUESS_PUSH: f64 = 1e-6;
const GUESS_BARRIER: f64 = 1e-6;

/// Settings for a start that is nearly optimal.
pub fn warm_start_settings(settings: &Settings) -> Settings {
    let ipopt = Options {
        mu_init: WARM_BARRIER,
        warm_start_bound_push: WARM_PUSH,
        warm_start_bound_frac: WARM_PUSH,
        warm_start_slack_bound_push: WARM_PUSH,
        warm_start_slack_bound_frac: WARM_PUSH,
        warm_start_mult_bound_push: WARM_PUSH,
        ..settings.ipopt.clone()
    };
    Settings { ipopt, ..*settings }
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

/// One solve on the way from a coarse grid to the asked one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rung {
    /// Number of steps of its grid.
    pub steps: usize,
    /// How it ended.
    pub status: Status,
    /// Number of iterations.
    pub iterations: usize,
}

/// Carries `point`, solved on a coarse grid over the same horizon, to `grid` by way of grids of
/// `between` steps. Stops at the first rung that fails: its solution is then the one returned, on
/// its grid.
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
) -> Result<(Solution, Vec<Rung>), OcpError> {
    let settings = warm_start_settings(settings);
    let mut rungs = Vec::with_capacity(between.len() + 1);
    let mut climb = |steps: usize, point: Point| -> Result<Solution, OcpError> {
        let mut program = MultipleShooting::new(functions, grid.with_steps(steps)?, initial)?;
        let start = Start::Warm(point.resampled(program.initial_state(), steps));
        let solution = program.solve(&start, &settings, &mut on_iteration)?;
        rungs.push(Rung { steps, status: solution.status, iterations: solution.iterations() });
        Ok(solution)
    };
    for &steps in between {
        let solution = climb(steps, point)?;
        if !solution.status.is_success() {
            return Ok((solution, rungs));
        }
        point = solution.point;
    }
    let solution = climb(grid.steps(), point)?;
    Ok((solution, rungs))
}
