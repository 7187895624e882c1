//! The solves that lead to a plan: several starts on a coarse grid, the best one refined.

mod model;
mod parallel;
mod saddle;

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use righting_ocp::{
    Attempt, Control, Grid, Guess, LinearSolver, OcpError, Optimizer, Options, Settings, Solution,
    close_guess_settings,
};

use crate::formulation::Coordinates;
use crate::starts::Swings;
use model::Model;
use parallel::Batch;
use righting_results::solution::IterationRecord;
use righting_results::trajectory::Trajectory;
use righting_scenario::file::{self, Formulation, NamedGuess, RandomStarts};
use righting_scenario::scenario::{MAX_STARTS, Maneuver, Scenario};

/// Steps of the grid on which starts are compared: coarse enough that five of them cost less than
/// the asked grid, fine enough to tell the optima apart.
const COARSE_STEPS: usize = 20;
/// A long maneuver takes more of them: so far may the fastest joint turn in one, rad. Beyond that the
/// steps integrate so poorly that the order of the optima changes.
const COARSE_TURN_RAD: f64 = 0.46;
/// But no more than these.
const MOST_COARSE_STEPS: usize = 120;
/// Tolerance there: tight enough for the barrier not to change the order of small objectives …
const COARSE_TOLERANCE: f64 = 1e-7;
/// … and of a detumble, what not to act would cost times this, …
const DETUMBLE_TOLERANCE: f64 = 1e-6;
/// … up to this.
const MOST_DETUMBLE_TOLERANCE: f64 = 2e-5;
/// Iterations after which a start on the coarse grid is given up.
const COARSE_ITERATIONS: u32 = 300;
/// A step that is still too long there after so many halvings is taken all the same.
const COARSE_HALVINGS: i32 = 5;
/// After so many shortened steps Ipopt's watchdog tries full ones (by itself after 10). Detumbles end in
/// curved valleys, along which the line search would creep.
const WATCHDOG_TRIGGER: u32 = 3;
/// And so many of them (by itself 3): a step out of the valley takes some to come back to its floor.
const WATCHDOG_TRIALS: u32 = 8;
/// How much finer than the grid before it a grid may be.
const REFINEMENT: usize = 6;
/// Swings that the automatic guess tries beside the constant one.
const AUTO_SWINGS: usize = 4;

/// Of how many swings a detumble's automatic guess tries those that slow the base most.
const SCREENED_SWINGS: usize = 32;
/// From here on a slew has so many optima that more starts pay: loops of the joints.
const LARGE_SLEW_RAD: f64 = 0.5;
/// Where no loop turns the base about the axis, so many more swings, rolled out.
const LARGE_SLEW_SWINGS: usize = 5;

/// The solves that lead to a plan.
pub(crate) struct Search<'a> {
    scenario: &'a Scenario,
    /// The asked form.
    model: Model,
    /// The reduced form, if starts are compared in it and it is not the asked one.
    scout: Option<Model>,
    /// The asked grid.
    grid: Grid,
    /// How many starts are solved at a time at most.
    threads: NonZeroUsize,
    on_iteration: &'a mut dyn FnMut(&IterationRecord) -> Control,
    /// An earlier plan to start from too.
    neighbor: Option<&'a Trajectory>,
    /// What a reader of the plan should know.
    pub(crate) notes: Vec<String>,
    /// Every solve so far.
    pub(crate) attempts: Vec<Attempt>,
    /// Time spent tracing and compiling.
    pub(crate) trace: Duration,
    stop: AtomicBool,
}

impl<'a> Search<'a> {
    pub(crate) fn new(
        scenario: &'a Scenario,
        threads: NonZeroUsize,
        neighbor: Option<&'a Trajectory>,
        on_iteration: &'a mut dyn FnMut(&IterationRecord) -> Control,
    ) -> Result<Self, OcpError> {
        let started = Instant::now();
        let solver = scenario.solver();
        let model = Model::compile(scenario, solver.formulation)?;
        let compares = swing_count(scenario) > 0 || neighbor.is_some();
        let scouts = solver.formulation != Formulation::Reduced && compares;
        let scout = match scouts {
            true => Some(Model::compile(scenario, Formulation::Reduced)?),
            false => None,
        };
        Ok(Self {
            scenario,
            model,
            scout,
            grid: Grid::new(scenario.horizon().duration_s, scenario.horizon().steps)?,
            threads,
            on_iteration,
            neighbor,
            notes: Vec::new(),
            attempts: Vec::new(),
            trace: started.elapsed(),
            stop: AtomicBool::new(false),
        })
    }

    /// The coordinates of the plan's solution.
    pub(crate) fn coordinates(&self) -> &Coordinates {
        &self.model.coordinates
    }

    /// Whether the caller stopped the search.
    pub(crate) fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn coarse_grid(&self) -> Result<Grid, OcpError> {
        let rates = self.scenario.system().joint_limits.iter().map(|limits| limits.rate_max_rad_s);
        let turn_rad = self.grid.duration_s() * rates.fold(0.0, f64::max);
        let steps = (turn_rad / COARSE_TURN_RAD).ceil() as usize;
        let steps = steps.clamp(COARSE_STEPS, MOST_COARSE_STEPS);
        self.grid.with_steps(self.grid.steps().min(steps))
    }

    /// The best plan on the coarse grid, in the reduced form; none if the asked grid is solved at
    /// once or no start converged.
    pub(crate) fn best_coarse_solution(&mut self) -> Result<Option<Solution>, OcpError> {
        let grid = self.coarse_grid()?;
        let scout = self.scout.as_ref().unwrap_or(&self.model);
        let swings = scout.swings(self.scenario, grid.steps());
        let cold = coarse_settings(self.scenario);
        let mut starts: Vec<(Guess, Settings)> = guesses(self.scenario, &swings)
            .into_iter()
            .map(|guess| (guess, cold.clone()))
            .collect();
        if let Some(neighbor) = self.neighbor {
            if starts.is_empty() {
                starts.push((swings.constant(), cold.clone()));
            }
            starts.push((swings.along(neighbor), close_guess_settings(&cold)));
        }
        if starts.is_empty() {
            return Ok(None);
        }
        let batch = Batch { model: scout, grid, starts: &starts };
        let solutions = batch.solve(self.threads, self.on_iteration, &self.stop)?;
        let mut best: Option<Solution> = None;
        for mut solution in solutions {
            let status = solution.status;
            self.attempts.append(&mut solution.attempts);
            let better = best.as_ref().is_none_or(|best| solution.objective < best.objective);
            if status.is_success() && better {
                best = Some(solution);
            }
        }
        Ok(best)
    }

    /// The plan on the asked grid and in the asked form, from the best coarse one if there is one.
    pub(crate) fn finish(&mut self, coarse: Option<Solution>) -> Result<Solution, OcpError> {
        if let Some(coarse) = coarse
            && let Some(solution) = self.refined(coarse)?
        {
            return Ok(solution);
        }
        let guess = self.model.swings(self.scenario, self.grid.steps()).constant();
        let settings = match self.scenario.solver().guess {
            file::Guess::Named(NamedGuess::Constant) => paper_settings(self.scenario),
            _ => settings(self.scenario),
        };
        let mut solution = self.model.solve(
            self.grid,
            guess,
            &settings,
            stoppable(self.on_iteration, &self.stop),
        )?;
        self.attempts.append(&mut solution.attempts);
        Ok(solution)
    }

    /// The coarse plan carried to the asked grid and form; none if that fails on the way.
    fn refined(&mut self, coarse: Solution) -> Result<Option<Solution>, OcpError> {
        let settings = settings(self.scenario);
        let mut between = rungs_between(coarse.controls.len(), self.grid.steps());
        let mut start = coarse;
        if let Some(scout) = &self.scout {
            // The forms differ in what they integrate, and so most on a coarse grid: change over on
            // the next one.
            let grid = self.grid.with_steps(match between.is_empty() {
                true => self.grid.steps(),
                false => between.remove(0),
            })?;
            let mut scouted = scout.refine(
                grid,
                &[],
                start,
                &start_settings(self.scenario),
                stoppable(self.on_iteration, &self.stop),
            )?;
            self.attempts.append(&mut scouted.attempts);
            let guess = self.model.guess_from(scout, &scouted);
            let close = close_guess_settings(&start_settings(self.scenario));
            start =
                self.model.solve(grid, guess, &close, stoppable(self.on_iteration, &self.stop))?;
            self.attempts.append(&mut start.attempts);
            if !start.status.is_success() {
                return Ok(None);
            }
        }
        let mut solution = self.model.refine(
            self.grid,
            &between,
            start,
            &settings,
            stoppable(self.on_iteration, &self.stop),
        )?;
        self.attempts.append(&mut solution.attempts);
        let on_asked_grid = solution.controls.len() == self.grid.steps();
        Ok((on_asked_grid && solution.status.is_success()).then_some(solution))
    }
}

/// Passes iterations on until one is answered with a stop.
fn stoppable<'a>(
    on_iteration: &'a mut dyn FnMut(&IterationRecord) -> Control,
    stop: &'a AtomicBool,
) -> impl FnMut(IterationRecord) -> Control + 'a {
    move |record| {
        if !stop.load(Ordering::Relaxed) && on_iteration(&record) == Control::Continue {
            return Control::Continue;
        }
        stop.store(true, Ordering::Relaxed);
        Control::Stop
    }
}

/// The starts that the scenario asks for; none if nothing is compared.
fn guesses(scenario: &Scenario, swings: &Swings<'_>) -> Vec<Guess> {
    let count = swing_count(scenario);
    if count == 0 {
        return Vec::new();
    }
    let mut guesses = vec![swings.constant()];
    let is_auto = scenario.solver().guess == file::Guess::Named(NamedGuess::Auto);
    match scenario.maneuver() {
        Maneuver::Detumble if is_auto => guesses.extend(swings.slowest(SCREENED_SWINGS, count)),
        Maneuver::Slew(slew) if is_auto => {
            guesses.extend(swings.from(0).take(count));
            if slew.target.angle_to(&scenario.initial().attitude) > LARGE_SLEW_RAD {
                let loops = swings.loops(&slew.target);
                if loops.is_empty() {
                    let more = swings.from(count as u64).take(LARGE_SLEW_SWINGS);
                    guesses.extend(more.map(|swing| swings.rolled_out(swing)));
                }
                guesses.extend(loops);
            }
        }
        _ => guesses.extend(swings.from(first_swing(scenario)).take(count)),
    }
    guesses
}

fn coarse_settings(scenario: &Scenario) -> Settings {
    let mut settings = start_settings(scenario);
    settings.ipopt.tolerance = settings.ipopt.tolerance.max(coarse_tolerance(scenario));
    settings.ipopt.max_iterations = settings.ipopt.max_iterations.min(COARSE_ITERATIONS);
    // From so far away corrections of single steps save none.
    settings.ipopt.max_soc = 0;
    settings.ipopt.accept_after_max_steps = COARSE_HALVINGS;
    settings.retry_at_iteration_limit = false;
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

/// Of a solve whose solution is only a start of another one.
fn start_settings(scenario: &Scenario) -> Settings {
    Settings { optimizer: Optimizer::Interior, ..settings(scenario) }
}

/// Of a solve that ends in a plan.
fn settings(scenario: &Scenario) -> Settings {
    let paper = paper_settings(scenario);
    Settings {
        ipopt: Options {
            watchdog_shortened_iter_trigger: WATCHDOG_TRIGGER,
            watchdog_trial_iter_max: WATCHDOG_TRIALS,
            // Blocks of dense factors leave residuals near rounding: over the shipped maneuvers Ipopt's
            // check of every step changes no iteration and takes a quarter of the time.
            fast_step_computation: true,
            ..paper.ipopt
        },
        ..paper
    }
}

/// Ipopt as it is by itself, as the paper used it.
fn paper_settings(scenario: &Scenario) -> Settings {
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
            file::LinearSolver::Auto => LinearSolver::Auto,
            file::LinearSolver::Mumps => LinearSolver::Mumps,
            file::LinearSolver::Stage => LinearSolver::Stage,
        },
        ..Settings::default()
    }
}

/// How many swings are tried beside the constant guess; zero if nothing is compared.
fn swing_count(scenario: &Scenario) -> usize {
    match scenario.solver().guess {
        file::Guess::Named(NamedGuess::Constant) => 0,
        file::Guess::Named(NamedGuess::Auto) => AUTO_SWINGS,
        file::Guess::Starts(RandomStarts { starts, .. }) => starts as usize,
    }
}

/// Each seed has its own stretch of the sequence of swings.
fn first_swing(scenario: &Scenario) -> u64 {
    match scenario.solver().guess {
        file::Guess::Starts(RandomStarts { seed, .. }) => seed.wrapping_mul(MAX_STARTS) % (1 << 40),
        file::Guess::Named(_) => 0,
    }
}

/// The numbers of steps on the way from a coarse grid to a fine one.
fn rungs_between(coarse: usize, fine: usize) -> Vec<usize> {
    let mut rungs: Vec<usize> =
        std::iter::successors(Some(fine), |&steps| Some(steps.div_ceil(REFINEMENT)))
            .skip(1)
            .take_while(|&steps| steps > coarse)
            .collect();
    rungs.reverse();
    rungs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_grid_is_much_finer_than_the_one_before() {
        assert_eq!(rungs_between(20, 600), [100]);
        assert_eq!(rungs_between(20, 9600), [45, 267, 1600]);
        assert!(rungs_between(20, 120).is_empty());
        assert!(rungs_between(7, 7).is_empty());
    }
}
