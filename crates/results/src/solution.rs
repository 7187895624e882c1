//! What a solve hands back besides the trajectory: the contents of `solution.json`.

use std::path::Path;

use righting_scenario::error::Error;
use righting_scenario::json::{Document, FileKind};
use righting_scenario::{file, file_io};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::finite_or_null::FiniteOrNull;
use crate::verification::{LimitRecord, Verification};

/// Value of the field `schema`.
pub const SCHEMA: &str = "righting.solution/1";

/// The contents of `solution.json`.
///
/// A number that is not finite (the objective of a solve that broke down) is `null` in the file and
/// NaN here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "Righting solution")]
pub struct Solution {
    /// "righting.solution/1".
    pub schema: String,
    /// The scenario with its system inline and every default filled in.
    pub scenario: file::Scenario,
    /// SHA-256 of the resolved scenario's compact JSON, hexadecimal.
    pub scenario_sha256: String,
    /// What computed it.
    pub versions: Versions,
    /// How the solve ended. A plan that is not optimal may be there all the same: see
    /// [`has_plan`](Self::has_plan).
    pub status: Status,
    /// Value of the objective, in the scenario's weights.
    #[serde(with = "FiniteOrNull")]
    pub objective: f64,
    /// Number of optimizer iterations on the asked grid; those of the starts and the coarser grids
    /// before it are not among them.
    pub iterations: usize,
    /// Largest violation of any constraint of the nonlinear program where the last solve ended, unscaled.
    #[serde(with = "FiniteOrNull")]
    pub constraint_violation: f64,
    /// By how much the last solve's point misses the conditions of optimality, computed apart from the
    /// optimizer; absent in files of earlier versions, and where the problem is not defined at the point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub optimality: Option<OptimalityRecord>,
    /// The duration that was chosen, s, where the scenario leaves it free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
    /// What the last node reached.
    pub terminal: Terminal,
    /// What was reached at each waypoint, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waypoints: Vec<WaypointRecord>,
    /// Wall-clock times.
    pub timing_s: Timing,
    /// Outcome of the independent check.
    pub verification: Verification,
    /// Every limit's worst place along the way, at the nodes and between them, by the independent check.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limits: Vec<LimitRecord>,
    /// Detumble: no motion that stops the arm can leave less angular rate, deg/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound_deg_s: Option<f64>,
    /// Detumble: the angular rate that is left when the arm is simply stopped in its posture at the start,
    /// deg/s; the rate at the start if the joints are at rest there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped_deg_s: Option<f64>,
    /// Detumble: how much of that rate the plan takes out, %.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reduction_percent: Option<f64>,
    /// What masses do to the end, where the scenario asked for a plan that depends on them less.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robustness: Option<RobustnessRecord>,
    /// What a reader should know: a saddle that was left, or, without a plan, which way is open.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// Every attempt to solve, in order: the starts on a coarse grid, then finer grids up to the asked
    /// one, with what was given up on the way.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attempts: Vec<AttemptRecord>,
    /// One record an iteration, the starting point first; of the last solve if there were several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub history: Vec<IterationRecord>,
}

/// What masses that are not known exactly do to the attitude at the end, to first order, and what it costs that they do
/// less.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RobustnessRecord {
    /// Standard deviation of the attitude at the end, deg.
    pub deviation_deg: f64,
    /// That of the plan that does not try to depend less on the masses, deg.
    pub without_deg: f64,
    /// What the plan costs relative to that one.
    pub cost_ratio: f64,
}

/// What computed a solution.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Versions {
    /// This program.
    pub righting: String,
    /// Ipopt.
    pub ipopt: String,
    /// Who made the iterations of the last solve.
    #[serde(default)]
    pub optimizer: UsedOptimizer,
    /// The linear solver inside it, with its version where it has one.
    pub linear_solver: String,
}

/// Who made the iterations of a solve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum UsedOptimizer {
    /// This program's own loop.
    Interior,
    /// Ipopt, as in every file that does not say.
    #[default]
    Ipopt,
}

/// One attempt to solve the problem on one grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AttemptRecord {
    /// Number of steps of the grid.
    pub steps: usize,
    /// Who made the iterations.
    pub optimizer: UsedOptimizer,
    /// What factorised the linear systems: "stage" or "mumps".
    pub linear_solver: String,
    /// How it ended; absent where it was given up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub status: Option<Status>,
    /// Why it was given up, and another attempt made from the same start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub given_up: Option<String>,
    /// Number of iterations.
    pub iterations: usize,
    /// Wall time, s.
    pub seconds: f64,
}

/// By how much a point misses the first-order conditions of optimality: maximum norms, of the problem in the
/// planner's units, without any scaling by the optimizer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OptimalityRecord {
    /// Of the gradient of the Lagrangian, over its measure s_d (Wächter & Biegler 2006, eq. 5).
    #[serde(with = "FiniteOrNull")]
    pub stationarity: f64,
    /// Of the constraints and bounds.
    #[serde(with = "FiniteOrNull")]
    pub violation: f64,
    /// Of the products of distances from bounds and their multipliers, over their measure s_c.
    #[serde(with = "FiniteOrNull")]
    pub complementarity: f64,
}

/// How the optimizer ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Status {
    /// Converged to the tolerance.
    Solved,
    /// Converged to the looser, acceptable tolerance.
    Acceptable,
    /// Converged by the optimizer's account, but not by residuals that were computed apart from it.
    Unconfirmed,
    /// Converged to a point of locally least infeasibility.
    Infeasible,
    /// Stopped by the iteration limit.
    IterationLimit,
    /// Stopped by the time limit.
    TimeLimit,
    /// Given up because it made no progress any more.
    Stalled,
    /// Stopped by the user.
    Interrupted,
    /// The search direction became too small to make progress.
    SearchDirectionTooSmall,
    /// The iterates diverged.
    Diverging,
    /// The restoration phase failed.
    RestorationFailed,
    /// A function could not be evaluated.
    EvaluationError,
    /// The optimizer failed in any other way.
    InternalError,
}

impl Status {
    /// Whether the plan converged.
    pub fn is_acceptable(self) -> bool {
        matches!(self, Self::Solved | Self::Acceptable)
    }
}

/// What the last node reached.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Terminal {
    /// Norm of the vector part of the attitude error quaternion; 0 for a detumble.
    #[serde(with = "FiniteOrNull")]
    pub attitude_error: f64,
    /// Angle of the attitude error, deg.
    #[serde(with = "FiniteOrNull")]
    pub attitude_error_deg: f64,
    /// Norm of the base's angular rate, deg/s.
    #[serde(with = "FiniteOrNull")]
    pub angular_rate_deg_s: f64,
    /// Norm of the joint rates, all joints that turn together, deg/s.
    #[serde(with = "FiniteOrNull")]
    pub joint_rate_deg_s: f64,
    /// Norm of the speeds of all joints that slide together, m/s; only where there are any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_speed_m_s: Option<f64>,
}

/// What was reached at a waypoint: from its arrival to its departure the worst of each, at the nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WaypointRecord {
    /// When it is reached, s.
    pub arrival_s: f64,
    /// When it is left, s.
    pub departure_s: f64,
    /// Norm of the vector part of the attitude error quaternion.
    #[serde(with = "FiniteOrNull")]
    pub attitude_error: f64,
    /// Angle of the attitude error, deg.
    #[serde(with = "FiniteOrNull")]
    pub attitude_error_deg: f64,
    /// Norm of the base's angular rate, deg/s.
    #[serde(with = "FiniteOrNull")]
    pub angular_rate_deg_s: f64,
    /// Norm of the joint rates, all joints that turn together, deg/s.
    #[serde(with = "FiniteOrNull")]
    pub joint_rate_deg_s: f64,
    /// Norm of the speeds of all joints that slide together, m/s; only where there are any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_speed_m_s: Option<f64>,
}

/// Wall-clock times, s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Timing {
    /// Reading and checking the scenario.
    pub load: f64,
    /// Tracing, differentiating and compiling the stage functions.
    pub trace: f64,
    /// Finding the initial guess.
    pub guess: f64,
    /// Evaluating functions and derivatives, within `solve`.
    pub evaluate: f64,
    /// Factorising and solving linear systems, within `solve`.
    pub linear_algebra: f64,
    /// The optimizer, all told.
    pub solve: f64,
    /// The independent check.
    pub verify: f64,
    /// From the command to the plan's files; what shows the plan is drawn after them.
    pub total: f64,
}

/// The optimizer after one iteration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct IterationRecord {
    /// Number of the iteration; 0 is the starting point.
    pub iteration: usize,
    /// Objective.
    #[serde(with = "FiniteOrNull")]
    pub objective: f64,
    /// Primal infeasibility, unscaled.
    #[serde(with = "FiniteOrNull")]
    pub primal_infeasibility: f64,
    /// Dual infeasibility.
    #[serde(with = "FiniteOrNull")]
    pub dual_infeasibility: f64,
    /// Barrier parameter µ.
    #[serde(with = "FiniteOrNull")]
    pub barrier_parameter: f64,
    /// Primal step size.
    #[serde(with = "FiniteOrNull")]
    pub primal_step: f64,
    /// Dual step size.
    #[serde(with = "FiniteOrNull")]
    pub dual_step: f64,
}

impl Solution {
    /// Whether there is a plan to deliver: one that converged, or one that did not, and passes every check.
    pub fn has_plan(&self) -> bool {
        self.status.is_acceptable() || self.verification.passed
    }

    /// The largest attitude error at the end and at waypoints: the norm of its vector part, and its angle, deg.
    pub fn largest_miss(&self) -> (f64, f64) {
        let waypoints = self.waypoints.iter();
        let errors = waypoints.map(|found| (found.attitude_error, found.attitude_error_deg));
        let Terminal { attitude_error, attitude_error_deg, .. } = self.terminal;
        errors.fold((attitude_error, attitude_error_deg), |(most, most_deg), (error, deg)| {
            (most.max(error), most_deg.max(deg))
        })
    }

    /// Writes `solution.json`, whole or not at all.
    ///
    /// # Errors
    /// [`Error::Write`] if the folder is missing, read-only or full.
    pub fn write_json(&self, file: &Path) -> Result<(), Error> {
        file_io::replace(file, |writer| {
            serde_json::to_writer_pretty(&mut *writer, self)?;
            writeln!(writer)
        })
    }

    /// Reads `solution.json`.
    ///
    /// # Errors
    /// Those of reading, and the JSON path of what is wrong in the file.
    pub fn read_json(file: &Path) -> Result<Self, Error> {
        let document = Document::read(file, FileKind::Solution)?;
        document.decode()
    }
}

/// The JSON Schema (draft 2020-12) of `solution.json`.
pub fn solution_schema() -> serde_json::Value {
    schemars::schema_for!(Solution).to_value()
}
