//! One case after the other, in one thread.

use std::io;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use righting_ocp::Control;
use righting_planner::{PlanError, Planned, Planner};
use righting_results::{SOLUTION_FILE, Solution, Status, TRAJECTORY_FILE, Trajectory};
use righting_scenario::Scenario;
use righting_verifier::simulate;
use serde_json::Value;

use crate::case::CaseId;
use crate::outcome::{CaseStatus, Flown, Outcome, Trouble};
use crate::worker::Setup;

/// What errors call a scenario that stands in no file.
const NO_FILE: &str = "case";

/// Evaluates cases as a sweep asks for.
pub(crate) struct Evaluator {
    time_limit: Duration,
    /// The plan to fly, or why there is none; planned when the first case needs it.
    flown: Option<Result<Trajectory, Outcome>>,
    /// The scenario to plan once and fly in every case; none if every case is planned.
    planned: Option<Value>,
    /// Where plans are kept; none if they are not.
    plans: Option<PathBuf>,
}

impl Evaluator {
    pub fn new(setup: Setup) -> Self {
        let time_limit = Duration::from_secs_f64(setup.time_limit_s);
        Self { time_limit, flown: None, planned: setup.planned, plans: setup.plans }
    }

    /// What a case comes to, and how long its plan took.
    ///
    /// # Errors
    /// Those of writing its plan, where plans are kept.
    pub fn evaluate(
        &mut self,
        case_id: CaseId,
        scenario: &Value,
    ) -> io::Result<(Outcome, Duration)> {
        let started = Instant::now();
        let outcome = match checked(scenario) {
            Err(refused) => refused,
            Ok(scenario) => match self.planned.take() {
                Some(base) => {
                    let outcome = self.flown_in(&base, &scenario);
                    self.planned = Some(base);
                    outcome
                }
                None => match self.plan(&scenario) {
                    Err(outcome) => outcome,
                    Ok(planned) => {
                        if let Some(plans) = &self.plans {
                            keep(&plans.join(case_id.to_string()), &scenario, &planned)?;
                        }
                        outcome_of(&planned.solution)
                    }
                },
            },
        };
        Ok((outcome, started.elapsed()))
    }

    fn plan(&self, scenario: &Scenario) -> Result<Planned, Outcome> {
        // Cases are what runs in parallel, not the starts of one.
        let mut planner = Planner::new()
            .without_remedies()
            .threads(NonZeroUsize::MIN)
            .time_limit(self.time_limit);
        match planner.plan(scenario, &mut |_| Control::Continue) {
            Err(PlanError::Impossible(reason)) => {
                Err(Outcome::of_trouble(Trouble::Impossible, reason.to_string()))
            }
            Err(error) => Err(Outcome::of_trouble(Trouble::NotPlanned, error.to_string())),
            Ok(planned) if planned.solution.status == Status::TimeLimit => {
                Err(Outcome::out_of_time(self.time_limit.as_secs_f64()))
            }
            Ok(planned) => Ok(planned),
        }
    }

    fn flown_in(&mut self, base: &Value, scenario: &Scenario) -> Outcome {
        if self.flown.is_none() {
            self.flown = Some(self.plan_to_fly(base));
        }
        let plan = match self.flown.as_ref() {
            Some(Ok(plan)) => plan,
            Some(Err(outcome)) => return outcome.clone(),
            None => unreachable!("planned just now"),
        };
        let (terminal, verification) = simulate(scenario, plan);
        Outcome {
            status: CaseStatus::Flown(Flown::Flown),
            verified: verification.passed,
            attitude_error: terminal.attitude_error,
            final_rate_deg_s: terminal.angular_rate_deg_s,
            joint_rate_deg_s: terminal.joint_rate_deg_s,
            objective: f64::NAN,
            iterations: 0,
            reason: verification.failures().next().map(ToString::to_string),
        }
    }

    fn plan_to_fly(&self, base: &Value) -> Result<Trajectory, Outcome> {
        let Planned { solution, trajectory } = self.plan(&checked(base)?)?;
        if solution.verification.passed {
            return Ok(trajectory);
        }
        let outcome = outcome_of(&solution);
        let reason = outcome.reason.unwrap_or_default();
        let reason = format!("no plan to fly: {}: {reason}", outcome.status);
        Err(Outcome::of_trouble(Trouble::NotPlanned, reason))
    }
}

fn outcome_of(solution: &Solution) -> Outcome {
    let verified = solution.verification.passed;
    let failed = solution.verification.failures().next();
    let reason = match failed {
        Some(check) => Some(check.to_string()),
        None if verified => None,
        None => solution.notes.first().cloned(),
    };
    Outcome {
        status: CaseStatus::Optimizer(solution.status),
        verified,
        attitude_error: solution.terminal.attitude_error,
        final_rate_deg_s: solution.terminal.angular_rate_deg_s,
        joint_rate_deg_s: solution.terminal.joint_rate_deg_s,
        objective: solution.objective,
        iterations: solution.iterations,
        reason: reason.filter(|reason| !reason.is_empty()),
    }
}

/// Writes a plan to a folder of its own, as `righting solve` does but for what shows it.
fn keep(folder: &Path, scenario: &Scenario, planned: &Planned) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let Planned { solution, trajectory } = planned;
    let kinds = scenario.system().model.joint_kinds();
    trajectory.write_csv(&kinds, &folder.join(TRAJECTORY_FILE)).map_err(io::Error::other)?;
    solution.write_json(&folder.join(SOLUTION_FILE)).map_err(io::Error::other)
}

/// The scenario, or the case refused.
fn checked(scenario: &Value) -> Result<Scenario, Outcome> {
    Scenario::parse(&scenario.to_string(), Path::new(NO_FILE)).map_err(|error| {
        let text = error.to_string();
        let text = text.strip_prefix("case: ").unwrap_or(&text);
        Outcome::of_trouble(Trouble::Refused, text)
    })
}
