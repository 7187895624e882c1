//! From a scenario to a finished, verified plan.

use std::num::NonZeroUsize;
use std::thread;
use std::time::{Duration, Instant};

use righting_analysis::Impossible;
use righting_multibody::ModelError;
use righting_ocp::{Control, OcpError};
use righting_results::trajectory::Trajectory;
use righting_results::{AttemptRecord, IterationRecord};
use righting_scenario::error::ShapeError;
use righting_scenario::{Maneuver, Scenario};
use righting_verifier::verify;

use crate::library::PlanLibrary;
use crate::planned::{Ending, Planned};
use crate::remedies::remedies;
use crate::scaling::Scaling;
use crate::search::{Earlier, Search};
use crate::sequence;

/// How often a maneuver that costs far more than estimated is measured anew.
const MOST_MEASURINGS: usize = 3;

/// Trying remedies takes at most so many times as long as the plan itself, and a second.
const REMEDY_SHARE: u32 = 2;
const REMEDY_TIME: Duration = Duration::from_secs(1);

/// Plans maneuvers and verifies what it planned.
///
/// From the paper's constant guess the problem is solved on the asked grid. For any other guess,
/// several initial guesses are ranked on a coarse grid in the reduced form, and the best of those
/// solutions is carried to the asked grid and form; if that fails, the solution from the constant guess
/// is the answer. Ipopt makes the last solve unless the scenario asks otherwise.
///
/// ```
/// use std::num::NonZeroUsize;
/// use std::path::Path;
/// use std::time::Duration;
///
/// use righting_ocp::Control;
/// use righting_planner::Planner;
/// use righting_scenario::Scenario;
///
/// let scenario = Scenario::read(Path::new("../../scenarios/slew_2dof.json"))?;
/// let mut planner = Planner::new().threads(NonZeroUsize::MIN).time_limit(Duration::from_secs(60));
/// let planned = planner.plan(&scenario, &mut |_| Control::Continue)?;
/// assert!(planned.solution.verification.passed);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Planner<'a> {
    threads: NonZeroUsize,
    earlier: Option<&'a Trajectory>,
    library: Option<&'a mut PlanLibrary>,
    time_limit: Option<Duration>,
    tries_remedies: bool,
    remedy_time: Duration,
    program: String,
}

impl Default for Planner<'_> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'a> Planner<'a> {
    /// One that uses all cores, starts from the scenario's guesses alone and takes the time it needs.
    pub fn new() -> Self {
        Self {
            threads: thread::available_parallelism().unwrap_or(NonZeroUsize::MIN),
            earlier: None,
            library: None,
            time_limit: None,
            tries_remedies: true,
            remedy_time: REMEDY_TIME,
            program: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }

    /// Solves so many ranked guesses at a time at most. The plan does not depend on it.
    pub fn threads(mut self, threads: NonZeroUsize) -> Self {
        self.threads = threads;
        self
    }

    /// Starts from an earlier plan too: of the same arm for another angle, axis, duration, grid or mass.
    pub fn warm_start(mut self, earlier: &'a Trajectory) -> Self {
        self.earlier = Some(earlier);
        self
    }

    /// Starts from the nearest plan of a library too, unless there is a [`warm_start`](Self::warm_start).
    /// A note of the solution says which.
    pub fn library(mut self, library: &'a mut PlanLibrary) -> Self {
        self.library = Some(library);
        self
    }

    /// Stops a plan that takes longer; its status is then
    /// [`TimeLimit`](righting_results::Status::TimeLimit). Checked once an iteration.
    pub fn time_limit(mut self, limit: Duration) -> Self {
        self.time_limit = Some(limit);
        self
    }

    /// Does not try what would help where a plan misses its target or there is none: that takes up to a few
    /// more plans, and its outcome stands in the notes.
    pub fn without_remedies(mut self) -> Self {
        self.tries_remedies = false;
        self
    }

    /// Takes so much time to try what would help, beside twice that of the plan; a second if nothing is said.
    pub fn remedy_time(mut self, time: Duration) -> Self {
        self.remedy_time = time;
        self
    }

    /// What `versions.righting` of the solution says; this crate's version if nothing is said.
    pub fn program(mut self, version: &str) -> Self {
        version.clone_into(&mut self.program);
        self
    }

    /// Plans the maneuver of a scenario and verifies the plan. `observer` sees every iteration and may
    /// stop the solve, whose status is then [`Interrupted`](righting_results::Status::Interrupted).
    ///
    /// Not converging is a status of the solution; so is failing the verification.
    ///
    /// # Errors
    /// [`PlanError::Ocp`] when there is nothing to optimize, [`PlanError::Shape`] when the earlier plan's
    /// arm has another number of joints, [`PlanError::Impossible`] when no motion of the arm makes the
    /// maneuver: that is known before anything is solved.
    pub fn plan(
        &mut self,
        scenario: &Scenario,
        observer: &mut dyn FnMut(&IterationRecord) -> Control,
    ) -> Result<Planned, PlanError> {
        let started = Instant::now();
        let (nearest, note) = match (self.earlier, &mut self.library) {
            (None, Some(library)) => {
                let nearest = library.nearest(scenario);
                let note = library.note(nearest.as_ref());
                (nearest, Some(note))
            }
            _ => (None, None),
        };
        let earlier = self.earlier.or(nearest.as_ref().map(|near| &near.trajectory));
        require_same_joints(scenario, earlier)?;
        if let Some(reason) = Impossible::of(scenario) {
            return Err(reason.into());
        }

        let limit = [self.time_limit, scenario.solver().time_limit].into_iter().flatten().min();
        let mut is_late = false;
        let mut watched = |record: &IterationRecord| {
            is_late |= limit.is_some_and(|limit| started.elapsed() > limit);
            if is_late { Control::Stop } else { observer(record) }
        };
        let is_of_this = earlier.is_some_and(|earlier| is_plan_of(scenario, earlier));
        let mut first_attempts = Vec::new();
        let first = match earlier {
            None => self.first_motion(scenario, &mut watched, &mut first_attempts),
            Some(_) => None,
        };
        let earlier = earlier.or(first.as_ref());

        let (mut measured, mut scaling) = Scaling::applied(scenario)?;
        let earlier = earlier.map(|earlier| scaling.trajectory(earlier));
        let mut search = |measured: &Scenario, scaling: &Scaling| {
            let earlier = earlier.as_ref().map(|plan| Earlier { plan, is_of_this });
            let mut watched = |record: &IterationRecord| watched(&scaling.record(record));
            Search::new(measured, self.threads, earlier, &mut watched)?.run()
        };
        let mut found = search(&measured, &scaling)?;
        for _ in 0..MOST_MEASURINGS {
            let Some(again) = scaling.after(scenario, &measured, &found)? else { break };
            let attempts = std::mem::take(&mut found.attempts);
            (measured, scaling) = again;
            found = search(&measured, &scaling)?;
            found.attempts.splice(..0, attempts);
        }
        found.notes.splice(..0, note);
        let ending = match (found.is_interrupted, is_late) {
            (false, _) => Ending::Finished,
            (true, true) => Ending::TimeLimit,
            (true, false) => Ending::Interrupted,
        };
        let mut planned = Planned::new(scenario, &scaling, found, ending, &self.program)?;
        planned.solution.attempts.splice(..0, first_attempts);
        if self.tries_remedies {
            let threads = self.threads;
            let deadline = started.elapsed() * (1 + REMEDY_SHARE) + self.remedy_time;
            let limit = limit.map_or(deadline, |limit| limit.min(deadline));
            planned.solution.notes.extend(remedies(scenario, &planned, |changed| {
                let mut is_stopped = false;
                let mut watched = |record: &IterationRecord| {
                    let late = started.elapsed() > limit;
                    let control = if late { Control::Stop } else { observer(record) };
                    is_stopped |= control == Control::Stop;
                    control
                };
                let mut planner = Planner::new().threads(threads).without_remedies();
                let tried = planner.plan(changed, &mut watched).ok();
                tried.filter(|_| !is_stopped)
            }));
        }
        Ok(planned)
    }
}

impl Planner<'_> {
    /// A motion to start from where a simpler maneuver leads to one: over waypoints that of the legs one after the other,
    /// for a detumble on which something acts from outside that of the detumble on which nothing does: its attitude
    /// plays no part, which makes a far better search. None where those were not all planned. Adds the attempts to plan
    /// them.
    fn first_motion(
        &self,
        scenario: &Scenario,
        observer: &mut dyn FnMut(&IterationRecord) -> Control,
        attempts: &mut Vec<AttemptRecord>,
    ) -> Option<Trajectory> {
        let mut plan = |simpler: &Scenario| {
            let mut planner = Planner::new().threads(self.threads).without_remedies();
            let planned = planner.plan(simpler, observer).ok()?;
            attempts.extend(planned.solution.attempts.iter().cloned());
            Some(planned)
        };
        if !scenario.waypoints().is_empty() {
            return sequence::of_legs(scenario, plan);
        }
        let is_disturbed = scenario.acting_environment().is_some() && !scenario.solver().is_paper();
        if *scenario.maneuver() == Maneuver::Detumble && is_disturbed {
            let undisturbed = scenario.varied(|file| file.environment = None).ok()?;
            let planned = plan(&undisturbed)?;
            let is_plan = planned.solution.status.is_acceptable();
            return is_plan.then_some(planned.trajectory);
        }
        None
    }
}

pub(crate) fn require_same_joints(
    scenario: &Scenario,
    earlier: Option<&Trajectory>,
) -> Result<(), ShapeError> {
    let needed = scenario.system().joint_count();
    match earlier.map(Trajectory::joints) {
        Some(found) if found != needed => {
            Err(ShapeError { what: "joints of the earlier plan".to_owned(), found, needed })
        }
        _ => Ok(()),
    }
}

/// Whether a motion is a plan of this very scenario: on its grid, from its start, and verified.
fn is_plan_of(scenario: &Scenario, earlier: &Trajectory) -> bool {
    let horizon = scenario.horizon();
    let is_on_grid = earlier.steps() == horizon.steps
        && earlier.end().time_s == horizon.time_s(horizon.steps)
        && scenario.free_duration().is_none();
    is_on_grid && verify(scenario, earlier).passed
}

/// Why there is no plan at all. A plan that did not converge is one, with its status.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The optimal control problem was refused.
    #[error(transparent)]
    Ocp(#[from] OcpError),
    /// The system is beyond all measure.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The parts of the trajectory do not fit together.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// There is no feedback for such a maneuver, for a reason.
    #[error("{0}")]
    NoFeedback(&'static str),
    /// No motion of the arm makes the maneuver.
    #[error(transparent)]
    Impossible(#[from] Impossible),
    /// A plan of this kind is not planned anew on the way.
    #[error("{0}")]
    NotReplanned(&'static str),
}
