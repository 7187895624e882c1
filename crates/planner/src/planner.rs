//! From a scenario to a trajectory.

use std::num::NonZeroUsize;
use std::thread;
use std::time::{Duration, Instant};

use righting_ocp::{
    Attempt, AttemptEnd, Control, Iteration, OcpError, Optimizer, Solution, UsedLinearSolver,
};

use crate::formulation::Coordinates;
use crate::open_ways::open_ways;
use crate::search::Search;
use righting_results::solution::{AttemptRecord, IterationRecord, Status, UsedOptimizer};
use righting_results::trajectory::{Interval, Node, Trajectory};
use righting_scenario::error::ShapeError;
use righting_scenario::scenario::Scenario;

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
    /// Every attempt to solve, in order: the coarse starts, then the grids up to the asked one.
    pub attempts: Vec<AttemptRecord>,
    /// Who made the iterations of the last solve.
    pub optimizer: UsedOptimizer,
    /// What factorised its linear systems.
    pub linear_solver: UsedLinearSolver,
    /// What a reader should know: a saddle that was left, or, without a plan, which way is open.
    pub notes: Vec<String>,
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
    /// Evaluating functions and derivatives in the last solve.
    pub evaluate: Duration,
    /// Factorising and solving linear systems in the last solve; with MUMPS, everything in it that
    /// is not `evaluate`.
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
/// From the paper's constant guess the problem is solved on the asked grid. For any other guess,
/// several starts are compared on a coarse grid in the reduced form, and the best of those plans is
/// carried to the asked grid and form; if that fails, the plan of the constant guess is the answer.
///
/// The starts share all cores; see [`plan_with_threads`] for fewer. The plan does not depend on that.
///
/// # Errors
/// [`PlanError`] when there is nothing to optimize.
pub fn plan(
    scenario: &Scenario,
    on_iteration: &mut dyn FnMut(&IterationRecord) -> Control,
) -> Result<Plan, PlanError> {
    let cores = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    plan_with_threads(scenario, cores, on_iteration)
}

/// [`plan`] with one more start: an earlier plan of the same arm for another angle, axis, duration,
/// grid or mass.
///
/// # Errors
/// Those of [`plan`]; [`PlanError::Shape`] when the earlier plan's arm has another number of joints.
pub fn plan_from(
    scenario: &Scenario,
    earlier: &Trajectory,
    on_iteration: &mut dyn FnMut(&IterationRecord) -> Control,
) -> Result<Plan, PlanError> {
    let joints = scenario.system().joint_count();
    if earlier.joints() != joints {
        let what = "joints of the earlier plan".to_owned();
        return Err(ShapeError { what, found: earlier.joints(), needed: joints }.into());
    }
    let cores = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    search(Search::new(scenario, cores, Some(earlier), on_iteration)?, scenario)
}

/// [`plan`] with so many starts at a time at most.
///
/// # Errors
/// Those of [`plan`].
pub fn plan_with_threads(
    scenario: &Scenario,
    threads: NonZeroUsize,
    on_iteration: &mut dyn FnMut(&IterationRecord) -> Control,
) -> Result<Plan, PlanError> {
    search(Search::new(scenario, threads, None, on_iteration)?, scenario)
}

fn search(mut search: Search<'_>, scenario: &Scenario) -> Result<Plan, PlanError> {
    let started = Instant::now();
    let coarse = search.best_coarse_solution()?;
    let guess = started.elapsed();

    let started = Instant::now();
    let solution = search.finish(coarse)?;
    let (solution, is_minimum) = search.off_saddles(solution)?;
    let solve = started.elapsed();
    let evaluate = solution.timing.evaluation.total();
    let linear_algebra = match solution.timing.linear_solver {
        Some(linear_solver) => linear_solver.total(),
        None => solution.timing.total.saturating_sub(evaluate),
    };
    let status = match status(solution.status) {
        _ if search.is_interrupted() => Status::Interrupted,
        Status::Solved if !is_minimum => Status::Acceptable,
        status => status,
    };
    let trajectory = trajectory(scenario, search.coordinates(), &solution)?;
    let mut notes = search.notes;
    notes.extend(open_ways(scenario, &trajectory, status));
    Ok(Plan {
        trajectory,
        status,
        notes,
        objective: solution.objective,
        iterations: solution.iterations(),
        constraint_violation: solution.constraint_violation,
        history: solution.history.iter().map(record).collect(),
        optimizer: used_optimizer(solution.optimizer),
        linear_solver: solution.linear_solver,
        timing: PlanTiming { trace: search.trace, guess, evaluate, linear_algebra, solve },
        attempts: search.attempts.iter().map(attempt_record).collect(),
    })
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

pub(crate) fn record(iteration: &Iteration) -> IterationRecord {
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

fn attempt_record(attempt: &Attempt) -> AttemptRecord {
    let (ended, given_up) = match &attempt.end {
        AttemptEnd::Status(ended) => (Some(status(*ended)), None),
        AttemptEnd::GivenUp(reason) => (None, Some(reason.clone())),
    };
    AttemptRecord {
        steps: attempt.steps,
        optimizer: used_optimizer(attempt.optimizer),
        linear_solver: match attempt.linear_solver {
            UsedLinearSolver::Stage => "stage".to_owned(),
            UsedLinearSolver::Mumps | UsedLinearSolver::MumpsAfterStage => "mumps".to_owned(),
        },
        status: ended,
        given_up,
        iterations: attempt.iterations,
        seconds: attempt.time.as_secs_f64(),
    }
}

fn used_optimizer(optimizer: Optimizer) -> UsedOptimizer {
    match optimizer {
        Optimizer::Interior => UsedOptimizer::Interior,
        Optimizer::Ipopt => UsedOptimizer::Ipopt,
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
