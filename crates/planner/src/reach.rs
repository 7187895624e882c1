//! What is possible at all: the shortest duration, or the largest angle, at which a maneuver succeeds.
//!
//! A slew succeeds when its plan passes its [verification](righting_verifier::verify), which includes the target;
//! a detumble, when in addition the rate left is within some percent of its
//! [bound](righting_analysis::detumble::rate_bound_rad_s). From the scenario's own value the search goes to easier ones
//! until one succeeds, from there a quarter harder at a time until one fails, and then halves what
//! lies between, each plan being a start for the next. A value counts as failed only once it
//! has failed from its nearest success, cold, and, where asked for, from many low-discrepancy starts.
//!
//! Of a slew that ends in its target whatever that takes, one plan that chooses its duration says first where to look: if
//! the maneuver succeeds there and fails at the next value, the search is at its end.
//!
//! Nothing says that what is harder must fail, nor that a plan that was not found does not exist:
//! the answer is the end of an unbroken row of successes, not a proof.

mod fastest;
mod frontier;
mod trial;

use righting_analysis::detumble::rate_bound_rad_s;
use righting_ocp::Control;
use righting_results::FiniteOrNull;
use righting_results::solution::{IterationRecord, Status, Terminal};
use righting_scenario::error::Error;
use righting_scenario::scenario::{LONGEST_S, Maneuver, Scenario};
use schemars::JsonSchema;
use serde::Serialize;

use crate::planned::Planned;
use crate::planner::PlanError;
use frontier::{Frontier, Line, Resolution};
use trial::Trials;

/// No duration beyond so many times the scenario's is tried.
pub const LONGEST: f64 = 16.0;
/// Nor one below this share of it.
pub const SHORTEST: f64 = 0.01;
/// A free duration nearer to its longest than this has not been chosen.
const LONGEST_SHARE: f64 = 0.99;
/// Nor an angle beyond this, deg: the other way around would be shorter.
pub const LARGEST_ANGLE_DEG: f64 = 180.0;

/// What is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// The duration of a slew or a detumble.
    Duration,
    /// The angle of a slew about its axis.
    Angle,
}

/// How to search. All values are positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachSettings {
    /// What is varied.
    pub quantity: Quantity,
    /// How far apart the last failure and the last success may stay: of durations in percent, of angles in
    /// degrees.
    pub resolution: f64,
    /// Detumble: by how much the rate left may exceed its bound, %.
    pub within_percent: f64,
    /// How many low-discrepancy starts to try before a value counts as failed; 0 for none.
    pub starts: u64,
    /// Whether a plan that chooses its duration says where to look first, where there can be one.
    pub plans_fastest: bool,
}

impl ReachSettings {
    /// The defaults for a quantity: 1 % of a duration or 0.5°, within 2 % of the bound, no other
    /// starts, and a look at the fastest plan first.
    pub fn new(quantity: Quantity) -> Self {
        let resolution = match quantity {
            Quantity::Duration => 1.0,
            Quantity::Angle => 0.5,
        };
        Self { quantity, resolution, within_percent: 2.0, starts: 0, plans_fastest: true }
    }
}

/// What a search found.
#[derive(Clone, Debug)]
pub struct Reach {
    /// What was varied.
    pub quantity: Quantity,
    /// The smallest duration, s, or largest angle, deg, of an unbroken row of successes.
    pub first_succeeding: Option<f64>,
    /// The failure next to it; none if nothing failed before the search's end.
    pub last_failing: Option<f64>,
    /// Everything tried, in order.
    pub tries: Vec<Try>,
    /// The plan of `first_succeeding`.
    pub plan: Option<Reached>,
    /// Detumble: the bound on the rate left, deg/s.
    pub bound_deg_s: Option<f64>,
    /// What a reader should know: what stands in the way of more, and how sure that is.
    pub notes: Vec<String>,
    /// Whether the caller stopped the search.
    pub is_interrupted: bool,
}

/// A plan with the scenario that it solves.
#[derive(Clone, Debug)]
pub struct Reached {
    /// The scenario, with its duration or angle.
    pub scenario: Scenario,
    /// Its plan.
    pub planned: Planned,
}

/// One duration or angle that was tried, and the best that its solves came to.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Try {
    /// Duration, s.
    pub duration_s: f64,
    /// Slew: angle, deg.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<f64>,
    /// Whether the maneuver succeeds.
    pub succeeded: bool,
    /// Whether the plan passed its verification: a detumble may, and yet leave too much.
    #[serde(rename = "verified")]
    pub is_verified: bool,
    /// How the optimizer ended.
    pub status: Status,
    /// The start that led there.
    pub start: StartedFrom,
    /// The duration or angle whose plan was a start, if any was.
    pub neighbor: Option<f64>,
    /// Optimizer iterations of all solves together.
    pub iterations: usize,
    /// Objective.
    #[serde(with = "FiniteOrNull")]
    pub objective: f64,
    /// What the last node reached.
    #[serde(flatten)]
    pub terminal: Terminal,
    /// What is wrong with it, if it failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shortfall: Option<String>,
}

impl Try {
    /// The duration, s, or the angle, deg; always positive.
    pub fn value(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Duration => self.duration_s,
            Quantity::Angle => self.angle_deg.unwrap_or_default().abs(),
        }
    }
}

impl Reach {
    /// Detumble: by how much the rate left by the best plan exceeds its bound, %; a plan whose joints
    /// still creep may end below it.
    pub fn closest_to_bound_percent(&self) -> Option<f64> {
        let bound_deg_s = self.bound_deg_s?;
        let plans = self.tries.iter().filter(|tried| tried.is_verified);
        plans
            .map(|tried| 100.0 * (tried.terminal.angular_rate_deg_s / bound_deg_s - 1.0))
            .min_by(f64::total_cmp)
    }
}

/// What a plan started from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StartedFrom {
    /// The scenario's own guess.
    Cold,
    /// A neighbor's plan, beside the scenario's own guess.
    Neighbor,
    /// The plan that chooses its duration.
    Fastest,
    /// Low-discrepancy starts.
    #[serde(rename = "random")]
    LowDiscrepancy,
}

/// How a search is getting on.
#[derive(Clone, Copy, Debug)]
pub enum Progress<'a> {
    /// A solve begins.
    Trying {
        /// The duration, s, or angle, deg.
        value: f64,
        /// What it starts from.
        start: StartedFrom,
    },
    /// An iteration of it.
    Iteration(&'a IterationRecord),
    /// A value is decided.
    Tried(&'a Try),
}

/// Why there is nothing to search.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReachError {
    /// A maneuver could not be tried.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A variant of the scenario was refused.
    #[error(transparent)]
    Scenario(#[from] Error),
    /// A detumble, or a slew that stays where it is, has no angle to vary.
    #[error("there is no angle to vary: the maneuver is {0}")]
    NoAngle(&'static str),
}

/// Searches for the shortest duration or largest angle at which the scenario's maneuver succeeds. See the
/// [module](self) for how. `watch` sees the progress and may stop it.
///
/// # Errors
/// [`ReachError`] when there is nothing to vary, a maneuver cannot be solved at all, or no motion of the
/// arm makes any of those tried. Not finding any success is none.
pub fn reach(
    scenario: &Scenario,
    settings: ReachSettings,
    watch: &mut dyn FnMut(Progress<'_>) -> Control,
) -> Result<Reach, ReachError> {
    let line = line(scenario, settings)?;
    let bound_deg_s = match scenario.maneuver() {
        Maneuver::Detumble => Some(rate_bound_rad_s(scenario).to_degrees()),
        Maneuver::Slew(_) => None,
    };
    let mut trials = Trials::new(scenario, settings, bound_deg_s, watch);
    let aim = match settings.quantity {
        Quantity::Duration if settings.plans_fastest => trials.plan_fastest()?,
        _ => None,
    };
    let mut frontier = Frontier::new(line, aim);
    while let Some(value) = frontier.next()
        && !trials.is_interrupted
        && let Some(succeeded) = trials.attempt(value)?
    {
        frontier.record(value, succeeded);
    }
    if !trials.is_interrupted && trials.impossible.len() == trials.tries.len() {
        let easiest = trials.impossible.pop();
        if let Some(reason) = easiest {
            return Err(PlanError::from(reason).into());
        }
    }
    let mut notes = Vec::new();
    if !trials.is_interrupted
        && let Some(note) = trials.what_is_in_the_way()?
    {
        notes.push(note);
    }
    if frontier.pass.is_some() && frontier.fail.is_some() {
        notes.push(
            "a value that was not tried may behave otherwise: what is harder need not fail, and \
             a plan that was not found may exist"
                .to_owned(),
        );
    }
    Ok(Reach {
        quantity: settings.quantity,
        first_succeeding: frontier.pass,
        last_failing: frontier.fail,
        bound_deg_s,
        notes,
        is_interrupted: trials.is_interrupted,
        plan: trials.successes.pop().map(|(_, reached)| reached),
        tries: trials.tries,
    })
}

/// The values that may be tried.
fn line(scenario: &Scenario, settings: ReachSettings) -> Result<Line, ReachError> {
    match (settings.quantity, scenario.maneuver()) {
        (Quantity::Duration, _) => {
            let first = scenario.horizon().duration_s;
            Ok(Line {
                first,
                easiest: (LONGEST * first).min(LONGEST_S),
                hardest: SHORTEST * first,
                resolution: Resolution::Share(settings.resolution / 100.0),
            })
        }
        (Quantity::Angle, Maneuver::Slew(_)) if !scenario.waypoints().is_empty() => {
            Err(ReachError::NoAngle("a slew with waypoints"))
        }
        (Quantity::Angle, Maneuver::Slew(slew)) => {
            let first = slew.angle_rad.abs().to_degrees();
            if first == 0.0 {
                return Err(ReachError::NoAngle("a slew of 0\u{b0}"));
            }
            Ok(Line {
                first: first.min(LARGEST_ANGLE_DEG),
                easiest: settings.resolution.min(first),
                hardest: LARGEST_ANGLE_DEG,
                resolution: Resolution::Absolute(settings.resolution),
            })
        }
        (Quantity::Angle, Maneuver::Detumble) => Err(ReachError::NoAngle("a detumble")),
    }
}
