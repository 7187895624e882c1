use righting_nlp::{Control, Iteration, MultiplierInitialization, Options, Status};

use crate::error::OcpError;
use crate::grid::Grid;
use crate::initial_guess::InitialGuess;
use crate::multiple_shooting::MultipleShooting;
use crate::ocp_solution::OcpSolution;
use crate::ocp_start::OcpStart;
use crate::primal_dual_point::PrimalDualPoint;
use crate::settings::{Optimizer, Settings};
use crate::stage_functions::StageFunctions;

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

/// Settings for a grid between, whose solution is only a start.
fn between_settings(settings: &Settings) -> Settings {
    let mut between = warm_start_settings(settings, BETWEEN_BARRIER);
    between.ipopt.tolerance = settings.ipopt.tolerance.max(BETWEEN_TOLERANCE);
    // The first barrier problem is the only one.
    between.ipopt.barrier_tol_factor = 1.0;
    between.optimizer = Optimizer::Interior;
    between.judges = false;
    between
}

/// Settings for the asked grid: they begin at the barrier parameter that Ipopt ends with.
fn last_settings(settings: &Settings) -> Settings {
    warm_start_settings(settings, settings.ipopt.last_barrier_parameter())
}

/// Settings for a start with multipliers, at a barrier parameter: bounds and multipliers are taken as they
/// are, and what does not converge soon is given up.
pub fn warm_start_settings(settings: &Settings, barrier_parameter: f64) -> Settings {
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

/// Carries a solution on a coarse grid to a finer one over the same horizon (mesh refinement; Betts,
/// *Practical Methods for Optimal Control*, ch. 4), with multipliers and all, by way of grids
/// between.
#[derive(Debug, Clone, Copy)]
pub struct MeshRefinement<'a> {
    /// The problem.
    pub functions: &'a StageFunctions,
    /// The same problem for the last grid, maybe with other
    /// [substeps](StageFunctions::with_substeps).
    pub last_functions: &'a StageFunctions,
    /// x_0, all states of the problem.
    pub initial: &'a [f64],
    /// The grid to arrive at.
    pub grid: Grid,
    /// Numbers of steps of the grids between, in order.
    pub between: &'a [usize],
    /// How to solve on the last grid. Those between are solved by [`Optimizer::Interior`] and no
    /// more tightly than pays.
    pub settings: &'a Settings,
}

impl MeshRefinement<'_> {
    /// From `point`, solved on some coarser grid. Where a warm start does not converge, the motion
    /// alone is an initial guess, as cold as any. Stops at the first grid on which that fails too:
    /// its solution is then the one returned.
    ///
    /// # Errors
    /// Those of [`MultipleShooting::new`] and [`MultipleShooting::solve`].
    pub fn refine(
        &self,
        mut point: PrimalDualPoint,
        mut on_iteration: impl FnMut(&Iteration) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        let mut attempts = Vec::new();
        let coarse = between_settings(self.settings);
        for &steps in self.between {
            let mut solution =
                self.solve_on(self.functions, steps, &point, &coarse, &mut on_iteration)?;
            attempts.append(&mut solution.attempts);
            if !solution.status.is_success() {
                return Ok(OcpSolution { attempts, ..solution });
            }
            point = solution.point;
        }
        let last = last_settings(self.settings);
        let steps = self.grid.steps();
        let mut solution =
            self.solve_on(self.last_functions, steps, &point, &last, &mut on_iteration)?;
        attempts.append(&mut solution.attempts);
        Ok(OcpSolution { attempts, ..solution })
    }

    /// Solves on a grid from a point of another one: warm with these settings, and where that does
    /// not converge cold.
    fn solve_on(
        &self,
        functions: &StageFunctions,
        steps: usize,
        point: &PrimalDualPoint,
        warm: &Settings,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        let grid = self.grid.with_steps(steps)?;
        let mut program = MultipleShooting::new(functions, grid, self.initial)?;
        let point = point.resampled(&program.initial_state(&point.z), steps);
        let mut solution =
            program.solve(&OcpStart::Warm(point.clone()), warm, &mut *on_iteration)?;
        if solution.status.is_success() || solution.status == Status::UserStop {
            return Ok(solution);
        }
        let (states, controls) = program.trajectory(&point);
        let ipopt = Options { tolerance: warm.ipopt.tolerance, ..self.settings.ipopt.clone() };
        let cold = Settings { ipopt, ..*self.settings };
        let guess = OcpStart::Guess(InitialGuess { states, controls });
        let mut again = program.solve(&guess, &cold, on_iteration)?;
        again.attempts.splice(..0, solution.attempts.drain(..));
        Ok(again)
    }
}
