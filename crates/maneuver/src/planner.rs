//! From a scenario to a trajectory.

use std::time::{Duration, Instant};

use righting_ocp::{
    Control, Grid, Guess, Iteration, LinearSolver, MultipleShooting, OcpError, Options, Rung,
    Settings, Solution, StageFunctions, Start, UsedLinearSolver, refine,
};

use crate::error::ShapeError;
use crate::file::{self, Guess as ScenarioGuess, NamedGuess, RandomStarts};
use crate::formulation::{Coordinates, FormulatedManeuver};
use crate::scenario::{MAX_STARTS, Scenario};
use crate::solution::{IterationRecord, Status};
use crate::starts::Swings;
use crate::trajectory::{Interval, Node, Trajectory};

/// Steps of the grid on which starts are compared.
const COARSE_STEPS: usize = 60;
/// Swings that the automatic guess tries beside the constant one.
const AUTO_SWINGS: usize = 4;

/// A plan that was computed, converged or not.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The trajectory on the scenario's grid.
    pub trajectory: Trajectory,
    /// How the optimizer ended.
    pub status: Status,
    /// Value of the objective, in the scenario's weights.
    pub objective: f64,
    /// Number of optimizer iterations.
    pub iterations: usize,
    /// Largest violation of any constraint of the nonlinear program, unscaled.
    pub constraint_violation: f64,
    /// One record an iteration of the last solve, the starting point first.
    pub history: Vec<IterationRecord>,
    /// Every solve on the way, in order: the coarse starts, then the grids up to the asked one.
    pub rungs: Vec<Rung>,
    /// What factorised the linear systems of the last solve.
    pub linear_solver: UsedLinearSolver,
    /// Where the time went.
    pub timing: PlanTiming,
}

/// Wall-clock times of a plan.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlanTiming {
    /// Tracing, differentiating and compiling the stage functions.
    pub trace: Duration,
    /// Finding the initial guess.
    pub guess: Duration,
    /// Evaluating functions and derivatives, within `solve`.
    pub evaluate: Duration,
    /// Factorising and solving linear systems, within `solve`; with MUMPS, everything in `solve`
    /// that is not `evaluate`.
    pub linear_algebra: Duration,
    /// The optimizer, all told.
    pub solve: Duration,
}

/// Why there is no plan at all. A plan that did not converge is one, with its [`Status`].
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The optimal control problem was refused.
    #[error(transparent)]
    Ocp(#[from] OcpError),
    /// The parts of the trajectory do not fit together.
    #[error(transparent)]
    Shape(#[from] ShapeError),
}

/// Plans the maneuver of a scenario. `on_iteration` sees the optimizer's progress and may stop it:
/// the plan is then [`Status::Interrupted`].
///
/// From the paper's constant guess the problem is solved on the asked grid. Any other guess is
/// solved on a coarse grid from several starts first, and the best of those plans is carried to the
/// asked grid; if that fails, the plan of the constant guess is the answer.
///
/// # Errors
/// [`PlanError`] when there is nothing to optimize.
pub fn plan(
    scenario: &Scenario,
    on_iteration: &mut dyn FnMut(&IterationRecord) -> Control,
) -> Result<Plan, PlanError> {
    let started = Instant::now();
    let formulated = FormulatedManeuver::new(scenario);
    let functions = StageFunctions::compile(&formulated.problem)?;
    let mut timing = PlanTiming { trace: started.elapsed(), ..PlanTiming::default() };
    let mut search = Search {
        scenario,
        formulated: &formulated,
        functions: &functions,
        grid: Grid::new(scenario.horizon().duration_s, scenario.horizon().steps)?,
        on_iteration,
        rungs: Vec::new(),
        interrupted: false,
    };

    let started = Instant::now();
    let coarse = search.best_coarse_solution()?;
    timing.guess = started.elapsed();

    let started = Instant::now();
    let solution = search.finish(coarse)?;
    timing.solve = started.elapsed();
    timing.evaluate = solution.timing.evaluation.total();
    timing.linear_algebra = match solution.timing.linear_solver {
        Some(linear_solver) => linear_solver.total(),
        None => solution.timing.total.saturating_sub(timing.evaluate),
    };
    Ok(Plan {
        trajectory: trajectory(scenario, &formulated.coordinates, &solution)?,
        status: if search.interrupted { Status::Interrupted } else { status(solution.status) },
        objective: solution.objective,
        iterations: solution.iterations(),
        constraint_violation: solution.constraint_violation,
        history: solution.history.iter().map(record).collect(),
        rungs: search.rungs,
        linear_solver: solution.linear_solver,
        timing,
    })
}

/// The solves that lead to a plan.
struct Search<'a> {
    scenario: &'a Scenario,
    formulated: &'a FormulatedManeuver,
    functions: &'a StageFunctions,
    /// The asked grid.
    grid: Grid,
    on_iteration: &'a mut dyn FnMut(&IterationRecord) -> Control,
    rungs: Vec<Rung>,
    interrupted: bool,
}

impl Search<'_> {
    fn settings(&self) -> Settings {
        let solver = self.scenario.solver();
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

    fn swings(&self, steps: usize) -> Swings<'_> {
        Swings {
            scenario: self.scenario,
            coordinates: &self.formulated.coordinates,
            initial: &self.formulated.initial,
            steps,
        }
    }

    /// The starts on the coarse grid; none if the asked grid is solved at once.
    fn starts(&self, steps: usize) -> Vec<Guess> {
        let swings = self.swings(steps);
        let (first, count) = match self.scenario.solver().guess {
            ScenarioGuess::Named(NamedGuess::Constant) => return Vec::new(),
            ScenarioGuess::Named(NamedGuess::Auto) => (0, AUTO_SWINGS),
            ScenarioGuess::Starts(RandomStarts { starts, seed }) => {
                (seed.wrapping_mul(MAX_STARTS) % (1 << 40), starts as usize)
            }
        };
        std::iter::once(swings.constant()).chain(swings.from(first).take(count)).collect()
    }

    fn solve_on(&mut self, steps: usize, guess: Guess) -> Result<Solution, OcpError> {
        let grid = self.grid.with_steps(steps)?;
        let mut program = MultipleShooting::new(self.functions, grid, &self.formulated.initial)?;
        let settings = self.settings();
        let solution = program.solve(&Start::Guess(guess), &settings, |iteration| {
            (self.on_iteration)(&record(iteration))
        })?;
        self.note(Rung { steps, status: solution.status, iterations: solution.iterations() });
        Ok(solution)
    }

    fn note(&mut self, rung: Rung) {
        self.interrupted |= rung.status == righting_ocp::Status::UserStop;
        self.rungs.push(rung);
    }

    fn best_coarse_solution(&mut self) -> Result<Option<Solution>, OcpError> {
        let steps = self.grid.steps().min(COARSE_STEPS);
        let mut best: Option<Solution> = None;
        for guess in self.starts(steps) {
            let solution = self.solve_on(steps, guess)?;
            if self.interrupted {
                return Ok(Some(best.unwrap_or(solution)));
            }
            let better = best.as_ref().is_none_or(|best| solution.objective < best.objective);
            if solution.status.is_success() && better {
                best = Some(solution);
            }
        }
        Ok(best)
    }

    /// The plan on the asked grid, from the best coarse one if there is one.
    fn finish(&mut self, coarse: Option<Solution>) -> Result<Solution, OcpError> {
        let steps = self.grid.steps();
        if let Some(coarse) = coarse {
            if self.interrupted {
                return self.carried(coarse);
            }
            if coarse.controls.len() == steps {
                return Ok(coarse);
            }
            let settings = self.settings();
            let (solution, rungs) = refine(
                self.functions,
                self.grid,
                &[],
                &self.formulated.initial,
                coarse.point,
                &settings,
                |iteration| (self.on_iteration)(&record(iteration)),
            )?;
            rungs.into_iter().for_each(|rung| self.note(rung));
            if solution.status.is_success() || self.interrupted {
                return Ok(solution);
            }
        }
        let constant = self.swings(steps).constant();
        self.solve_on(steps, constant)
    }

    /// A coarse solution shown on the asked grid as it is.
    fn carried(&self, coarse: Solution) -> Result<Solution, OcpError> {
        let program = MultipleShooting::new(self.functions, self.grid, &self.formulated.initial)?;
        let point = coarse.point.resampled(program.initial_state(), self.grid.steps());
        let (states, controls) = program.trajectory(&point);
        Ok(Solution { states, controls, point, ..coarse })
    }
}

/// The whole motion, with the torques that it takes and their power.
fn trajectory(
    scenario: &Scenario,
    coordinates: &Coordinates,
    solution: &Solution,
) -> Result<Trajectory, ShapeError> {
    let system = &scenario.system().model;
    let steps = scenario.horizon().steps;
    let mut nodes = Vec::with_capacity(steps + 1);
    let mut intervals = Vec::with_capacity(steps);
    for k in 0..=steps {
        let state = coordinates.free_floating_state(solution.states.row(k));
        let accelerations = solution.controls.row(k.min(steps - 1));
        let torques = system.joint_torques(
            &state.angular_rate,
            &state.joint_angles,
            &state.joint_rates,
            accelerations,
        );
        nodes.push(Node {
            time_s: scenario.horizon().time_s(k),
            position_m: state.position.into(),
            attitude: state.attitude.to_array(),
            velocity_m_s: state.velocity.into(),
            angular_rate_rad_s: state.angular_rate.into(),
            power_w: torques
                .iter()
                .zip(&state.joint_rates)
                .map(|(torque, rate)| torque * rate)
                .sum(),
            joint_angles_rad: state.joint_angles,
            joint_rates_rad_s: state.joint_rates,
        });
        if k < steps {
            intervals.push(Interval {
                joint_accelerations_rad_s2: accelerations.to_vec(),
                joint_torques_n_m: torques,
            });
        }
    }
    Trajectory::new(nodes, intervals)
}

fn record(iteration: &Iteration) -> IterationRecord {
    IterationRecord {
        iteration: iteration.iteration,
        objective: iteration.objective,
        primal_infeasibility: iteration.primal_infeasibility,
        dual_infeasibility: iteration.dual_infeasibility,
        barrier_parameter: iteration.mu,
        primal_step: iteration.alpha_primal,
        dual_step: iteration.alpha_dual,
    }
}

fn status(status: righting_ocp::Status) -> Status {
    use righting_ocp::Status as Ipopt;
    match status {
        Ipopt::Solved => Status::Solved,
        Ipopt::Acceptable | Ipopt::FeasiblePointFound => Status::Acceptable,
        Ipopt::Infeasible => Status::Infeasible,
        Ipopt::IterationLimit => Status::IterationLimit,
        Ipopt::CpuTimeLimit | Ipopt::WallTimeLimit => Status::TimeLimit,
        Ipopt::UserStop => Status::Interrupted,
        Ipopt::SearchDirectionTooSmall => Status::SearchDirectionTooSmall,
        Ipopt::Diverging => Status::Diverging,
        Ipopt::RestorationFailed => Status::RestorationFailed,
        Ipopt::InvalidNumber => Status::EvaluationError,
        _ => Status::InternalError,
    }
}
