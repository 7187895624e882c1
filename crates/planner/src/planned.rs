//! A plan as it is delivered: its trajectory, and everything else that is known of it.

use std::time::{Duration, Instant};

use righting_analysis::detumble::rate_bound_rad_s;
use righting_ocp::{Attempt, AttemptEnd, Iteration, Optimizer, UsedLinearSolver};
use righting_results::solution::SCHEMA;
use righting_results::{
    AttemptRecord, IterationRecord, OptimalityRecord, RobustnessRecord, Solution, Status, Terminal,
    Timing, Trajectory, UsedOptimizer, Versions, WaypointRecord, objective,
};
use righting_scenario::error::ShapeError;
use righting_scenario::{Maneuver, Scenario};

use crate::delivered::Delivered;
use crate::hints::hints;
use crate::scaling::Scaling;
use crate::search::Found;

/// A plan that was computed, converged or not, and verified: where it did not converge, the cheapest motion on the
/// way that passes every check, if there is one.
#[derive(Clone, Debug)]
pub struct Planned {
    /// How it ended, what it reached, and the record of its verification. Of its times, `load` and
    /// `total` are the caller's to fill in.
    pub solution: Solution,
    /// The trajectory on the scenario's grid.
    pub trajectory: Trajectory,
}

/// What a plan says that did not converge.
const NOT_OPTIMAL: &str =
    "not optimal: the cheapest motion found until then that passes every check";

/// What ended a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The last solve, however it ended.
    Finished,
    /// The observer.
    Interrupted,
    /// The clock.
    TimeLimit,
}

impl Planned {
    pub(crate) fn new(
        asked: &Scenario,
        scaling: &Scaling,
        found: Found,
        ending: Ending,
        program: &str,
    ) -> Result<Self, ShapeError> {
        let status = match (ending, status(found.solution.status)) {
            (Ending::Interrupted, _) => Status::Interrupted,
            (Ending::TimeLimit, _) => Status::TimeLimit,
            (Ending::Finished, Status::Interrupted) => Status::Stalled,
            (Ending::Finished, Status::Solved) if !found.is_minimum => Status::Acceptable,
            (Ending::Finished, status) => status,
        };
        let checking = Instant::now();
        let delivered = match status.is_acceptable() {
            true => Delivered::converged(asked, scaling, &found)?,
            false => Delivered::best_of_unconverged(asked, scaling, &found)?,
        };
        let Delivered { scenario, duration_s, trajectory, verification } = delivered;
        let scenario = &scenario;
        let timing_s = timing(&found, checking.elapsed());
        let terminal = Terminal::reached(scenario, &trajectory);
        let is_detumble = *scenario.maneuver() == Maneuver::Detumble;
        let mut notes = [scenario.notes(), &found.notes].concat();
        notes.extend(match (status.is_acceptable(), verification.passed) {
            (false, true) => vec![NOT_OPTIMAL.to_owned()],
            _ => hints(scenario, &trajectory, status),
        });
        let solution = Solution {
            schema: SCHEMA.to_owned(),
            scenario: scenario.resolved().clone(),
            scenario_sha256: scenario.resolved().sha256(),
            versions: versions(&found.solution, program),
            status,
            objective: objective(scenario, &trajectory),
            iterations: found.solution.iterations(),
            constraint_violation: found.solution.constraint_violation,
            optimality: found.solution.residuals.map(|residuals| OptimalityRecord {
                stationarity: residuals.stationarity,
                violation: residuals.violation,
                complementarity: residuals.complementarity,
            }),
            duration_s,
            terminal,
            waypoints: WaypointRecord::reached(scenario, &trajectory),
            timing_s,
            limits: verification.limits(),
            verification,
            bound_deg_s: is_detumble.then(|| rate_bound_rad_s(scenario).to_degrees()),
            stopped_deg_s: is_detumble.then(|| scenario.stopped_rate_rad_s().to_degrees()),
            reduction_percent: is_detumble.then(|| terminal.reduction_percent(scenario)),
            robustness: found.spread.map(|spread| RobustnessRecord {
                deviation_deg: spread.deviation_rad.to_degrees(),
                without_deg: spread.without_rad.to_degrees(),
                cost_ratio: spread.cost / spread.cost_without,
            }),
            notes,
            attempts: found.attempts.iter().map(attempt_record).collect(),
            history: {
                let history = found.solution.history.iter();
                history.map(|iteration| scaling.record(&record(iteration))).collect()
            },
        };
        Ok(Self { solution, trajectory })
    }
}

fn timing(found: &Found, verify: Duration) -> Timing {
    let solve = &found.solution.timing;
    let evaluate = solve.evaluation.total();
    // With MUMPS, everything in the solve that is not evaluation.
    let linear_algebra = match solve.linear_solver {
        Some(linear_solver) => linear_solver.total(),
        None => solve.total.saturating_sub(evaluate),
    };
    Timing {
        load: 0.0,
        trace: found.trace.as_secs_f64(),
        guess: found.guess.as_secs_f64(),
        evaluate: evaluate.as_secs_f64(),
        linear_algebra: linear_algebra.as_secs_f64(),
        solve: found.solve.as_secs_f64(),
        verify: verify.as_secs_f64(),
        total: 0.0,
    }
}

fn versions(solution: &righting_ocp::OcpSolution, program: &str) -> Versions {
    let found = righting_ipopt::versions();
    let mumps = found.libraries.iter().find(|library| library.name == "MUMPS");
    let mumps = mumps.and_then(|library| library.version.as_deref()).unwrap_or("of any version");
    Versions {
        righting: program.to_owned(),
        ipopt: found.ipopt.clone(),
        optimizer: used_optimizer(solution.optimizer),
        linear_solver: match solution.linear_solver {
            UsedLinearSolver::Stage => "stage".to_owned(),
            UsedLinearSolver::Mumps => format!("mumps {mumps}"),
            UsedLinearSolver::MumpsAfterStage => format!("mumps {mumps}, after stage"),
        },
    }
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
        Ipopt::Unconfirmed => Status::Unconfirmed,
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
