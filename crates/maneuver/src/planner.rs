//! From a scenario to a trajectory.

use std::time::{Duration, Instant};

use righting_ocp::{
    Control, Grid, Guess, Iteration, MultipleShooting, OcpError, Options, StageFunctions, Start,
};

use crate::error::ShapeError;
use crate::formulation::{Coordinates, FormulatedManeuver};
use crate::scenario::Scenario;
use crate::solution::{IterationRecord, Status};
use crate::trajectory::{Interval, Node, Trajectory};

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
    /// One record an iteration, the starting point first.
    pub history: Vec<IterationRecord>,
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
/// # Errors
/// [`PlanError`] when there is nothing to optimize.
pub fn plan(
    scenario: &Scenario,
    on_iteration: &mut dyn FnMut(&IterationRecord) -> Control,
) -> Result<Plan, PlanError> {
    let started = Instant::now();
    let FormulatedManeuver { problem, coordinates, initial } = FormulatedManeuver::new(scenario);
    let functions = StageFunctions::compile(&problem)?;
    let trace = started.elapsed();

    let started = Instant::now();
    let horizon = scenario.horizon();
    let grid = Grid::new(horizon.duration_s, horizon.steps)?;
    let mut program = MultipleShooting::new(&functions, grid, &initial)?;
    let joints = scenario.system().joint_count();
    let start = Start::Guess(Guess::constant(&initial, joints, horizon.steps));
    let guess = started.elapsed();

    let started = Instant::now();
    let settings = scenario.solver();
    let options = Options {
        tolerance: settings.tolerance,
        max_iterations: settings.max_iterations as u32,
        ..Options::default()
    };
    let mut history = Vec::new();
    let solution = program.solve(&start, &options, |iteration| {
        let record = record(iteration);
        history.push(record);
        on_iteration(&record)
    })?;
    let solve = started.elapsed();
    let evaluate = solution.timing.evaluation.total();
    Ok(Plan {
        trajectory: trajectory(scenario, &coordinates, &solution)?,
        status: status(solution.status),
        objective: solution.objective,
        iterations: solution.history.len().saturating_sub(1),
        constraint_violation: solution.constraint_violation,
        history,
        timing: PlanTiming {
            trace,
            guess,
            evaluate,
            linear_algebra: solution
                .timing
                .linear_solver
                .map_or(solve.saturating_sub(evaluate), |timing| timing.total()),
            solve,
        },
    })
}

/// The whole motion, with the torques that it takes and their power.
fn trajectory(
    scenario: &Scenario,
    coordinates: &Coordinates,
    solution: &righting_ocp::Solution,
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
            power_w: torques.iter().zip(&state.joint_rates).map(|(torque, rate)| torque * rate).sum(),
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
