//! The solves that lead to a plan: several starts on a coarse grid, the best one refined.

mod model;
mod parallel;

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use righting_ocp::{
    Control, Grid, Guess, LinearSolver, OcpError, Options, Rung, Settings, Solution,
    close_guess_settings,
};

use crate::file::{self, Formulation, NamedGuess, RandomStarts};
use crate::formulation::Coordinates;
use crate::scenario::{MAX_STARTS, Scenario};
use crate::solution::IterationRecord;
use model::Model;
use parallel::Batch;

/// Steps of the grid on which starts are compared: coarse enough that five of them cost less than
/// the asked grid, fine enough to tell the optima apart.
const COARSE_STEPS: usize = 20;
/// Tolerance there: the next grid corrects more than that.
const COARSE_TOLERANCE: f64 = 1e-4;
/// Iterations after which a start on the coarse grid is given up.
const COARSE_ITERATIONS: u32 = 300;
/// How much finer than the grid before it a grid may be.
const REFINEMENT: usize = 6;
/// Swings that the automatic guess tries beside the constant one.
const AUTO_SWINGS: usize = 4;

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
    /// Every solve so far.
    pub(crate) rungs: Vec<Rung>,
    /// Time spent tracing and compiling.
    pub(crate) trace: Duration,
    stop: AtomicBool,
}

impl<'a> Search<'a> {
    pub(crate) fn new(
        scenario: &'a Scenario,
        threads: NonZeroUsize,
        on_iteration: &'a mut dyn FnMut(&IterationRecord) -> Control,
    ) -> Result<Self, OcpError> {
        let started = Instant::now();
        let solver = scenario.solver();
        let model = Model::compile(scenario, solver.formulation)?;
        let scouts = solver.formulation != Formulation::Reduced && swing_count(scenario) > 0;
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
            rungs: Vec::new(),
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

    /// The best plan on the coarse grid, in the reduced form; none if the asked grid is solved at
    /// once or no start converged.
    pub(crate) fn best_coarse_solution(&mut self) -> Result<Option<Solution>, OcpError> {
        let grid = self.grid.with_steps(self.grid.steps().min(COARSE_STEPS))?;
        let scout = self.scout.as_ref().unwrap_or(&self.model);
        let swings = scout.swings(self.scenario, grid.steps());
        let count = swing_count(self.scenario);
        if count == 0 {
            return Ok(None);
        }
        let starts: Vec<Guess> = std::iter::once(swings.constant())
            .chain(swings.from(first_swing(self.scenario)).take(count))
            .collect();
        let mut settings = settings(self.scenario);
        settings.ipopt.tolerance = settings.ipopt.tolerance.max(COARSE_TOLERANCE);
        settings.ipopt.max_iterations = settings.ipopt.max_iterations.min(COARSE_ITERATIONS);
        let batch = Batch { model: scout, grid, starts: &starts, settings: &settings };
        let solutions = batch.solve(self.threads, self.on_iteration, &self.stop)?;
        let mut best: Option<Solution> = None;
        for solution in solutions {
            let (status, iterations) = (solution.status, solution.iterations());
            self.rungs.push(Rung { steps: grid.steps(), status, iterations });
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
        let settings = settings(self.scenario);
        let solution = self.model.solve(
            self.grid,
            guess,
            &settings,
            stoppable(self.on_iteration, &self.stop),
        )?;
        self.rungs.push(Rung {
            steps: self.grid.steps(),
            status: solution.status,
            iterations: solution.iterations(),
        });
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
            let (scouted, rungs) = scout.refine(
                grid,
                &[],
                start,
                &settings,
                stoppable(self.on_iteration, &self.stop),
            )?;
            self.rungs.extend(rungs);
            let guess = self.model.guess_from(scout, &scouted);
            let close = close_guess_settings(&settings);
            start =
                self.model.solve(grid, guess, &close, stoppable(self.on_iteration, &self.stop))?;
            self.rungs.push(Rung {
                steps: grid.steps(),
                status: start.status,
                iterations: start.iterations(),
            });
            if !start.status.is_success() {
                return Ok(None);
            }
        }
        let (solution, rungs) = self.model.refine(
            self.grid,
            &between,
            start,
            &settings,
            stoppable(self.on_iteration, &self.stop),
        )?;
        self.rungs.extend(rungs);
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

fn settings(scenario: &Scenario) -> Settings {
    let solver = scenario.solver();
    Settings {
        ipopt: Options {
            tolerance: solver.tolerance,
            max_iterations: solver.max_iterations as u32,
            ..Options::default()
        },
        linear_solver: match solver.linear_solver {
            file::LinearSolver::Auto => LinearSolver::Auto,
            file::LinearSolver::Mumps => LinearSolver::Mumps,
            file::LinearSolver::Stage => LinearSolver::Stage,
        },
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
