//! The solves that lead to a plan.
//!
//! 1. Several initial guesses are solved on a coarse grid, in the reduced form, and ranked by their
//!    objective ([`Search::coarse_solutions`]).
//! 2. The best is carried over finer meshes to the asked grid and form ([`Search::refined`]). Where
//!    that fails, or nothing was ranked, the asked grid is solved from the constant guess.
//! 3. Where the Lagrangian curves downwards at the solution, it is no minimum: the search leaves it
//!    along that direction ([`Search::leave_saddle`]).
//! 4. Where a limit is passed between the nodes, it is stated there too, and the problem solved again
//!    ([`Search::hold_between_nodes`]).

mod batch;
mod between_nodes;
mod grids;
mod model;
mod negative_curvature;
mod portfolio;
mod settings;

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use righting_ocp::{
    Attempt, Control, Grid, InitialGuess, OcpError, OcpSolution, Settings, close_guess_settings,
};
use righting_results::IterationRecord;
use righting_results::trajectory::Trajectory;
use righting_scenario::file::Formulation;
use righting_scenario::scenario::Scenario;

use crate::formulation::{Coordinates, StageLimits};
use batch::Batch;
use model::Model;

/// The solves that lead to a plan.
pub(crate) struct Search<'a> {
    scenario: &'a Scenario,
    /// The asked form.
    model: Model,
    /// The reduced form, if initial guesses are ranked in it and it is not the asked one.
    ranking_model: Option<Model>,
    /// What both state within the steps too.
    stage_limits: StageLimits,
    /// The asked grid.
    grid: Grid,
    /// How many guesses are solved at a time at most.
    threads: NonZeroUsize,
    on_iteration: &'a mut dyn FnMut(&IterationRecord) -> Control,
    /// An earlier plan to start from too.
    earlier: Option<&'a Trajectory>,
    /// What ranking the initial guesses led to, the best first.
    coarse: Vec<OcpSolution>,
    notes: Vec<String>,
    attempts: Vec<Attempt>,
    trace: Duration,
    stop: AtomicBool,
}

/// What a search ends with.
pub(crate) struct Found {
    /// On the asked grid and in the asked form.
    pub(crate) solution: OcpSolution,
    /// What its states are.
    pub(crate) coordinates: Coordinates,
    /// Whether second-order conditions hold there, or were not asked for.
    pub(crate) is_minimum: bool,
    /// Whether the caller stopped the search.
    pub(crate) is_interrupted: bool,
    /// What a reader of the plan should know.
    pub(crate) notes: Vec<String>,
    /// Every attempt to solve, in order.
    pub(crate) attempts: Vec<Attempt>,
    /// Time spent tracing and compiling.
    pub(crate) trace: Duration,
    /// Time spent ranking initial guesses.
    pub(crate) guess: Duration,
    /// Time spent on what followed.
    pub(crate) solve: Duration,
}

impl<'a> Search<'a> {
    /// Traces and compiles the scenario's problem.
    pub(crate) fn new(
        scenario: &'a Scenario,
        threads: NonZeroUsize,
        earlier: Option<&'a Trajectory>,
        on_iteration: &'a mut dyn FnMut(&IterationRecord) -> Control,
    ) -> Result<Self, OcpError> {
        let started = Instant::now();
        let formulation = scenario.solver().formulation;
        let stage_limits = StageLimits::default();
        let model = Model::compile(scenario, formulation, &stage_limits)?;
        let ranks = portfolio::is_ranked(scenario) || earlier.is_some();
        let ranking_model = match ranks && formulation != Formulation::Reduced {
            true => Some(Model::compile(scenario, Formulation::Reduced, &stage_limits)?),
            false => None,
        };
        Ok(Self {
            scenario,
            model,
            ranking_model,
            stage_limits,
            grid: Grid::new(scenario.horizon().duration_s, scenario.horizon().steps)?,
            threads,
            on_iteration,
            earlier,
            coarse: Vec::new(),
            notes: Vec::new(),
            attempts: Vec::new(),
            trace: started.elapsed(),
            stop: AtomicBool::new(false),
        })
    }

    /// Makes the solves.
    pub(crate) fn run(mut self) -> Result<Found, OcpError> {
        let started = Instant::now();
        self.coarse = self.coarse_solutions()?;
        let guess = started.elapsed();

        let started = Instant::now();
        let refined = match self.coarse.first().cloned() {
            Some(coarse) => self.refined(coarse)?,
            None => None,
        };
        let solution = match refined {
            Some(solution) => solution,
            None => self.solved_from_constant_guess()?,
        };
        let (solution, is_minimum) = self.leave_saddle(solution)?;
        let (solution, is_minimum) = self.hold_between_nodes(solution, is_minimum)?;
        Ok(Found {
            solution,
            is_minimum,
            is_interrupted: self.is_interrupted(),
            coordinates: self.model.coordinates,
            notes: self.notes,
            attempts: self.attempts,
            trace: self.trace,
            guess,
            solve: started.elapsed(),
        })
    }

    fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// The solutions on the coarse grid, in the reduced form, the best first; none if nothing is ranked
    /// or no guess converged.
    fn coarse_solutions(&mut self) -> Result<Vec<OcpSolution>, OcpError> {
        let grid = grids::coarse(self.scenario, &self.grid)?;
        let model = self.ranking_model.as_ref().unwrap_or(&self.model);
        let guesses = model.initial_guesses(self.scenario, grid.steps());
        let cold = settings::coarse(self.scenario);
        let mut starts: Vec<(InitialGuess, Settings)> =
            portfolio::ranked_guesses(self.scenario, &guesses)
                .into_iter()
                .map(|guess| (guess, cold.clone()))
                .collect();
        if let Some(earlier) = self.earlier {
            if starts.is_empty() {
                starts.push((guesses.constant(), cold.clone()));
            }
            starts.push((guesses.along_trajectory(earlier), close_guess_settings(&cold)));
        }
        if starts.is_empty() {
            return Ok(Vec::new());
        }
        let batch = Batch { model, grid, starts: &starts };
        let mut solutions = batch.solve(self.threads, self.on_iteration, &self.stop)?;
        for solution in &mut solutions {
            self.attempts.append(&mut solution.attempts);
        }
        solutions.retain(|solution| solution.status.is_success());
        solutions.sort_by(|a, b| a.objective.total_cmp(&b.objective));
        Ok(solutions)
    }

    /// The asked grid, solved from the state held at the start.
    fn solved_from_constant_guess(&mut self) -> Result<OcpSolution, OcpError> {
        let guess = self.model.initial_guesses(self.scenario, self.grid.steps()).constant();
        let settings = settings::from_constant_guess(self.scenario);
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut solution = self.model.solve(self.grid, guess, &settings, on_iteration)?;
        self.attempts.append(&mut solution.attempts);
        Ok(solution)
    }

    /// The coarse solution carried to the asked grid and form; none if that fails on the way.
    fn refined(&mut self, coarse: OcpSolution) -> Result<Option<OcpSolution>, OcpError> {
        let mut meshes = grids::between(coarse.controls.len(), self.grid.steps());
        let mut start = coarse;
        if self.ranking_model.is_some() {
            // The forms differ in what they integrate, and so most on a coarse grid: change over on
            // the next one.
            let steps = if meshes.is_empty() { self.grid.steps() } else { meshes.remove(0) };
            start = self.in_asked_form(self.grid.with_steps(steps)?, start)?;
            if !start.status.is_success() {
                return Ok(None);
            }
        }
        let settings = settings::delivered(self.scenario);
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut solution = self.model.refine(self.grid, &meshes, start, &settings, on_iteration)?;
        self.attempts.append(&mut solution.attempts);
        let is_on_asked_grid = solution.controls.len() == self.grid.steps();
        Ok((is_on_asked_grid && solution.status.is_success()).then_some(solution))
    }

    /// A solution of the ranking model, refined to `grid` and solved there in the asked form.
    fn in_asked_form(&mut self, grid: Grid, start: OcpSolution) -> Result<OcpSolution, OcpError> {
        let Some(ranking_model) = &self.ranking_model else { return Ok(start) };
        let settings = settings::intermediate(self.scenario);
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut refined = ranking_model.refine(grid, &[], start, &settings, on_iteration)?;
        self.attempts.append(&mut refined.attempts);
        let guess = self.model.guess_from(ranking_model, &refined);
        let close = close_guess_settings(&settings);
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut solution = self.model.solve(grid, guess, &close, on_iteration)?;
        self.attempts.append(&mut solution.attempts);
        Ok(solution)
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
