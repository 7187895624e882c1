//! The solves that lead to a plan.
//!
//! 1. Several initial guesses are solved on a coarse grid, in the reduced form, and ranked by their
//!    objective ([`Search::coarse_solutions`]).
//! 2. The best is carried over finer meshes to the asked grid and form ([`Search::refined`]). Where
//!    that fails, or nothing was ranked, the asked grid is solved from the constant guess.
//! 3. Where the asked steps are too long for how the base turns, they are integrated in several, and the
//!    solution follows ([`Search::integrated_well`]).
//! 4. Where the Lagrangian curves downwards at the solution, it is no minimum: the search leaves it
//!    along that direction ([`Search::leave_saddle`]).
//! 5. Where a limit is passed between the nodes, it is stated there too, and the problem solved again
//!    ([`Search::hold_between_nodes`]).
//! 6. Where masses are not known exactly, the asked grid is solved once more, with what they do to the end among
//!    the costs ([`Search::made_robust`]).

mod accuracy;
mod batch;
mod between_nodes;
mod grids;
mod hold;
mod hops;
mod incumbents;
mod model;
mod negative_curvature;
mod portfolio;
mod robust;
pub(crate) mod settings;
mod stall;

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rayon::{ThreadPool, ThreadPoolBuilder};
use righting_ocp::{
    Attempt, Control, Grid, InitialGuess, OcpError, OcpSolution, Settings, close_guess_settings,
};
use righting_results::IterationRecord;
use righting_results::trajectory::Trajectory;
use righting_scenario::file::Formulation;
use righting_scenario::scenario::Scenario;

use crate::formulation::{Clearances, Cones, Coordinates, Loads, StageLimits};
use batch::Batch;
use grids::Ranking;

pub(crate) use accuracy::substeps_of_spin;
pub(crate) use incumbents::Motion;
pub(crate) use model::Model;
pub(crate) use robust::SpreadOfEnd;

/// How many coarse solutions are carried to the asked grid, at most, until one gets there.
const MOST_REFINED: usize = 3;

/// What a plan says that was to depend less on masses.
const NOT_ROBUST: &str =
    "robustness: no plan was found that depends less on the masses; this one does not try to";

/// The solves that lead to a plan.
pub(crate) struct Search<'a> {
    scenario: &'a Scenario,
    /// The asked form.
    model: Model,
    /// The reduced form, if initial guesses are ranked in it and it is not the asked one.
    ranking_model: Option<Model>,
    /// What both state within the steps too.
    stage_limits: StageLimits,
    /// The distances that the joints decide.
    clearances: Clearances,
    /// What joints, mount and base bear.
    loads: Loads,
    /// The cones of the instruments.
    cones: Cones,
    /// The asked grid.
    grid: Grid,
    /// What guesses are ranked on.
    ranking: Ranking,
    /// The scenario as it is ranked.
    ranked: Scenario,
    /// The threads that solve guesses; none where the machine gives none, or nothing is ranked.
    pool: Option<ThreadPool>,
    on_iteration: &'a mut dyn FnMut(&IterationRecord) -> Control,
    /// An earlier plan to start from too.
    earlier: Option<Earlier<'a>>,
    /// What ranking the initial guesses led to, the best first.
    coarse: Vec<OcpSolution>,
    /// Where solves of the asked grid ended, but for the last.
    kept: Vec<Motion>,
    notes: Vec<String>,
    attempts: Vec<Attempt>,
    trace: Duration,
    stop: AtomicBool,
}

/// An earlier plan that a search starts from.
#[derive(Clone, Copy)]
pub(crate) struct Earlier<'a> {
    pub(crate) plan: &'a Trajectory,
    /// Whether it is a plan of the very problem: then nothing else is tried where its solve succeeds.
    pub(crate) is_of_this: bool,
}

/// What a search ends with.
pub(crate) struct Found {
    /// On the asked grid and in the asked form.
    pub(crate) solution: OcpSolution,
    /// What its states are.
    pub(crate) coordinates: Coordinates,
    /// Whether second-order conditions hold there, or were not asked for.
    pub(crate) is_minimum: bool,
    /// What masses do to its end, where the scenario asked for a plan that depends on them less.
    pub(crate) spread: Option<SpreadOfEnd>,
    /// Whether the caller stopped the search.
    pub(crate) is_interrupted: bool,
    /// Motions on the asked grid that may be plans, where the search did not end with one.
    pub(crate) incumbents: Vec<Motion>,
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

impl Found {
    /// The duration of a motion as a share of the longest, where it was free.
    pub(crate) fn duration_share(&self, motion: &Motion) -> Option<f64> {
        self.coordinates.duration().map(|index| motion.states.row(0)[index])
    }
}

impl<'a> Search<'a> {
    /// Traces and compiles the scenario's problem.
    pub(crate) fn new(
        scenario: &'a Scenario,
        threads: NonZeroUsize,
        earlier: Option<Earlier<'a>>,
        on_iteration: &'a mut dyn FnMut(&IterationRecord) -> Control,
    ) -> Result<Self, OcpError> {
        let started = Instant::now();
        let stage_limits = StageLimits::asked();
        let ranking = Ranking::of(scenario);
        let substeps = accuracy::substeps_of_spin(scenario);
        let ranks = portfolio::is_ranked(scenario) || earlier.is_some();
        let pool = ThreadPoolBuilder::new().num_threads(threads.get());
        let is_ranked_apart = ranks && scenario.solver().formulation != Formulation::Reduced;
        let (model, ranking_model) =
            compiled(scenario, ranking, &stage_limits, substeps, is_ranked_apart)?;
        Ok(Self {
            scenario,
            model,
            ranking_model,
            stage_limits,
            clearances: Clearances::new(scenario),
            loads: Loads::new(scenario),
            cones: Cones::new(scenario),
            ranking,
            ranked: ranking.scenario(scenario),
            grid: Grid::new(scenario.horizon().duration_s, scenario.horizon().steps)?,
            pool: ranks.then(|| pool.build().ok()).flatten(),
            on_iteration,
            earlier,
            coarse: Vec::new(),
            kept: Vec::new(),
            notes: Vec::new(),
            attempts: Vec::new(),
            trace: started.elapsed(),
            stop: AtomicBool::new(false),
        })
    }

    /// Makes the solves.
    pub(crate) fn run(mut self) -> Result<Found, OcpError> {
        let started = Instant::now();
        let continued = self.continued()?;
        if continued.is_none() {
            self.coarse = self.coarse_solutions()?;
        }
        let guess = started.elapsed();

        let started = Instant::now();
        // A plan that is gone on with is one over the whole horizon.
        let is_part = continued.is_none() && self.ranking.asked_steps < self.grid.steps();
        let mut found = continued;
        for place in 0..self.coarse.len().min(MOST_REFINED) {
            let solution = self.coarse[place].clone();
            found = if is_part { self.held_after(solution)? } else { self.refined(solution)? };
            if found.is_some() || self.is_interrupted() {
                break;
            }
        }
        let (solution, is_minimum) = match found {
            Some(solution) if is_part => (solution, true),
            Some(solution) => self.finished(solution)?,
            None => {
                let solution = self.solved_from_constant_guess()?;
                self.finished(solution)?
            }
        };
        let (solution, is_minimum, spread) = self.less_spread(solution, is_minimum);
        let has_plan = solution.status.is_success() && !self.is_interrupted();
        Ok(Found {
            incumbents: if has_plan { Vec::new() } else { self.incumbents(&solution) },
            solution,
            is_minimum,
            spread,
            is_interrupted: self.is_interrupted(),
            coordinates: self.model.coordinates,
            notes: self.notes,
            attempts: self.attempts,
            trace: self.trace,
            guess,
            solve: started.elapsed(),
        })
    }

    /// The asked grid solved from a plan of this very problem, if there is one and that succeeds.
    fn continued(&mut self) -> Result<Option<OcpSolution>, OcpError> {
        let Some(Earlier { plan, is_of_this: true }) = self.earlier else { return Ok(None) };
        let guesses = self.model.initial_guesses(self.scenario, self.grid.steps());
        let guess = guesses.along_trajectory(plan);
        let settings = settings::from_own_plan(settings::delivered(self.scenario));
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut solution = self.model.solve(self.grid, guess, &settings, on_iteration)?;
        self.attempts.append(&mut solution.attempts);
        Ok(solution.status.is_success().then_some(solution))
    }

    /// A solution on the asked grid, integrated well, within its limits between the nodes and, if there is
    /// one, at a minimum; false beside it says that it is at none.
    fn finished(&mut self, solution: OcpSolution) -> Result<(OcpSolution, bool), OcpError> {
        let solution = self.integrated_well(solution, self.grid)?;
        let (solution, is_minimum) = self.leave_saddle(solution)?;
        self.hold_between_nodes(self.grid, solution, is_minimum)
    }

    /// A solution that depends less on masses, where the scenario asks for one and there is one; otherwise the
    /// solution itself, and a note.
    fn less_spread(
        &mut self,
        solution: OcpSolution,
        is_minimum: bool,
    ) -> (OcpSolution, bool, Option<SpreadOfEnd>) {
        let Some(robustness) = self.scenario.robustness() else {
            return (solution, is_minimum, None);
        };
        if !solution.status.is_success() || self.is_interrupted() {
            return (solution, is_minimum, None);
        }
        match self.made_robust(robustness, &solution) {
            Ok(Some((robust, spread))) if self.passed_limits(&robust).is_empty() => {
                (robust, true, Some(spread))
            }
            Ok(_) | Err(_) => {
                self.notes.push(NOT_ROBUST.to_owned());
                (solution, is_minimum, None)
            }
        }
    }

    fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// The solutions on the grid of ranking, in the reduced form, the best first; none if nothing is
    /// ranked or no guess converged.
    fn coarse_solutions(&mut self) -> Result<Vec<OcpSolution>, OcpError> {
        let grid = self.ranking.grid(&self.grid)?;
        let model = self.ranking_model.as_ref().unwrap_or(&self.model);
        let guesses = model.initial_guesses(&self.ranked, grid.steps());
        let cold = settings::coarse(self.scenario);
        let start = |guess| (guess, cold.clone());
        let mut first = portfolio::ranked_guesses(&self.ranked, &guesses, 0);
        if first.is_empty() && self.earlier.is_some() {
            first.push(guesses.constant());
        }
        if first.is_empty() {
            return Ok(Vec::new());
        }
        let mut first: Vec<(InitialGuess, Settings)> = first.into_iter().map(start).collect();
        if let Some(earlier) = self.earlier {
            first.push((guesses.along_trajectory(earlier.plan), close_guess_settings(&cold)));
        }
        let mut solutions = self.converged(grid, first)?;
        let agreed = portfolio::agree(&solutions);
        for number in 1.. {
            if agreed || self.is_interrupted() {
                break;
            }
            let model = self.ranking_model.as_ref().unwrap_or(&self.model);
            let guesses = model.initial_guesses(&self.ranked, grid.steps());
            let batch = portfolio::ranked_guesses(&self.ranked, &guesses, number);
            if batch.is_empty() {
                break;
            }
            let batch = batch.into_iter().map(start).collect();
            solutions.append(&mut self.converged(grid, batch)?);
        }
        self.hop(grid, &mut solutions, portfolio::patience(self.scenario, agreed))?;
        solutions.sort_by(|a, b| a.objective.total_cmp(&b.objective));
        Ok(solutions)
    }

    /// The solutions from a batch of starts that converge; what the grid cannot follow is no start.
    fn converged(
        &mut self,
        grid: Grid,
        mut starts: Vec<(InitialGuess, Settings)>,
    ) -> Result<Vec<OcpSolution>, OcpError> {
        starts.retain(|(guess, _)| guess.states.first_not_finite().is_none());
        let model = self.ranking_model.as_ref().unwrap_or(&self.model);
        let batch = Batch::new(model, grid, &starts);
        let mut solutions = batch.solve(self.pool.as_ref(), self.on_iteration, &self.stop)?;
        for solution in &mut solutions {
            self.attempts.append(&mut solution.attempts);
        }
        solutions.retain(|solution| solution.status.is_success());
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
        self.refined_to(self.grid, coarse)
    }

    /// The coarse solution carried to `grid`, with the steps of the asked one, and the asked form.
    fn refined_to(
        &mut self,
        grid: Grid,
        coarse: OcpSolution,
    ) -> Result<Option<OcpSolution>, OcpError> {
        let mut meshes = grids::between(coarse.controls.len(), grid.steps());
        let mut start = coarse;
        if self.ranking_model.is_some() {
            // The forms differ in what they integrate, and so most on a coarse grid: change over on
            // the next one.
            let steps = if meshes.is_empty() { grid.steps() } else { meshes.remove(0) };
            start = self.in_asked_form(grid.with_steps(steps)?, start)?;
            if !start.status.is_success() {
                return Ok(None);
            }
        }
        let settings = settings::delivered(self.scenario);
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut solution = self.model.refine(grid, &meshes, start, &settings, on_iteration)?;
        self.attempts.append(&mut solution.attempts);
        self.keep(&solution);
        let has_arrived = solution.controls.len() == grid.steps();
        Ok((has_arrived && solution.status.is_success()).then_some(solution))
    }

    /// A solution of the ranking model, refined to `grid` and solved there in the asked form.
    fn in_asked_form(&mut self, grid: Grid, start: OcpSolution) -> Result<OcpSolution, OcpError> {
        let Some(ranking_model) = &self.ranking_model else { return Ok(start) };
        let settings = settings::intermediate(self.scenario);
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut refined = ranking_model.refine(grid, &[], start, &settings, on_iteration)?;
        self.attempts.append(&mut refined.attempts);
        let guess = self.model.guess_along(ranking_model, &refined.states, &refined.controls);
        let close = close_guess_settings(&settings);
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut solution = self.model.solve(grid, guess, &close, on_iteration)?;
        self.attempts.append(&mut solution.attempts);
        Ok(solution)
    }
}

/// The model in the asked form, whose steps take so many Runge–Kutta steps, and one in the reduced form if
/// guesses are ranked in that apart.
fn compiled(
    scenario: &Scenario,
    ranking: Ranking,
    stage_limits: &StageLimits,
    substeps: NonZeroUsize,
    is_ranked_apart: bool,
) -> Result<(Model, Option<Model>), OcpError> {
    let in_form = |form| Model::compile(scenario, form, ranking.substeps, stage_limits);
    let mut model = in_form(scenario.solver().formulation)?;
    if substeps > NonZeroUsize::MIN {
        model.take_substeps(substeps)?;
    }
    let apart = is_ranked_apart.then(|| in_form(Formulation::Reduced)).transpose()?;
    Ok((model, apart))
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
