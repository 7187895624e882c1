//! Solving one variant of a scenario until it succeeds or has had every chance.

use righting_analysis::Impossible;
use righting_ocp::Control;
use righting_results::solution::{IterationRecord, Status, Terminal};
use righting_scenario::file::{self, Guess, LowDiscrepancyStarts};
use righting_scenario::scenario::Scenario;

use super::fastest::fastest;
use super::{Progress, Quantity, ReachError, ReachSettings, Reached, StartedFrom, Try};
use crate::planner::Planner;

/// To see whether effort stands in the way, its weight is multiplied by this.
const CHEAP_EFFORT: f64 = 1e-3;

/// The tries of a search.
pub(super) struct Trials<'a> {
    scenario: &'a Scenario,
    settings: ReachSettings,
    /// Detumble: the rate that is good enough, deg/s.
    goal_deg_s: Option<f64>,
    watch: &'a mut dyn FnMut(Progress<'_>) -> Control,
    pub(super) tries: Vec<Try>,
    /// The plan that chose its duration, and that, s.
    fastest: Option<(f64, Reached)>,
    /// Each harder than the one before.
    pub(super) successes: Vec<(f64, Reached)>,
    /// The easiest one.
    failure: Option<(f64, Reached)>,
    /// Of the tries, those that no motion of the arm makes, and why.
    pub(super) impossible: Vec<Impossible>,
    pub(super) is_interrupted: bool,
}

impl<'a> Trials<'a> {
    pub(super) fn new(
        scenario: &'a Scenario,
        settings: ReachSettings,
        bound_deg_s: Option<f64>,
        watch: &'a mut dyn FnMut(Progress<'_>) -> Control,
    ) -> Self {
        Self {
            scenario,
            settings,
            goal_deg_s: bound_deg_s.map(|bound| bound * (1.0 + settings.within_percent / 100.0)),
            watch,
            tries: Vec::new(),
            fastest: None,
            successes: Vec::new(),
            failure: None,
            impossible: Vec::new(),
            is_interrupted: false,
        }
    }

    /// Plans the maneuver with a duration that the plan chooses, where that can be done; gives that duration, s.
    pub(super) fn plan_fastest(&mut self) -> Result<Option<f64>, ReachError> {
        if Impossible::of(self.scenario).is_some() {
            return Ok(None);
        }
        let watch = &mut *self.watch;
        let value = self.scenario.horizon().duration_s;
        let mut stop =
            watch(Progress::Trying { value, start: StartedFrom::Fastest }) == Control::Stop;
        let found = fastest(self.scenario, &mut |record| {
            stop |= watch(Progress::Iteration(record)) == Control::Stop;
            if stop { Control::Stop } else { Control::Continue }
        })?;
        self.is_interrupted |= stop;
        let chosen_s = |reached: &Reached| reached.planned.solution.duration_s;
        self.fastest = found.and_then(|reached| Some((chosen_s(&reached)?, reached)));
        Ok(self.fastest.as_ref().map(|(duration_s, _)| *duration_s))
    }

    /// Whether the maneuver with this duration, s, or angle, deg, succeeds; none if the caller
    /// stopped its solve.
    pub(super) fn attempt(&mut self, value: f64) -> Result<Option<bool>, ReachError> {
        let scenario = match self.variant(value) {
            Ok(scenario) => scenario,
            // What is asked is a scenario; another value need not be one: its target may be inside a cone.
            Err(refused) if !self.tries.is_empty() => {
                let shortfall = format!("refused: {refused}");
                self.fails_unsolved(not_solved(self.scenario, self.settings, value, shortfall));
                return Ok(Some(false));
            }
            Err(refused) => return Err(refused),
        };
        if let Some(reason) = Impossible::of(&scenario) {
            let shortfall = format!("impossible: {reason}");
            self.fails_unsolved(not_solved(&scenario, self.settings, value, shortfall));
            self.impossible.push(reason);
            return Ok(Some(false));
        }
        let nearest = self.successes.last().or(self.fastest.as_ref());
        let neighbor = nearest.map(|(value, _)| *value);
        let mut starts = vec![StartedFrom::Cold];
        if neighbor.is_some() {
            let is_success = !self.successes.is_empty();
            let warm = if is_success { StartedFrom::Neighbor } else { StartedFrom::Fastest };
            starts.insert(0, warm);
        }
        if self.settings.starts > 0 {
            starts.push(StartedFrom::LowDiscrepancy);
        }
        let mut iterations = 0;
        let mut best: Option<(StartedFrom, Reached)> = None;
        for start in starts {
            let found = self.solve(&scenario, value, start)?;
            if self.is_interrupted {
                return Ok(None);
            }
            iterations += found
                .planned
                .solution
                .attempts
                .iter()
                .map(|attempt| attempt.iterations)
                .sum::<usize>();
            let succeeded = self.succeeds(&found);
            if succeeded || best.as_ref().is_none_or(|(_, best)| self.misses_less(&found, best)) {
                best = Some((start, found));
            }
            if succeeded {
                break;
            }
        }
        let Some((start, found)) = best else { return Ok(None) };
        let tried = self.tried(start, neighbor, iterations, &found);
        let succeeded = tried.succeeded;
        let control = (self.watch)(Progress::Tried(&tried));
        self.tries.push(tried);
        match succeeded {
            true => self.successes.push((value, found)),
            false => self.failure = Some((value, found)),
        }
        self.is_interrupted |= control == Control::Stop;
        Ok(Some(succeeded))
    }

    /// What keeps the easiest failure from succeeding: effort that costs too much, or a limit of the
    /// arm.
    pub(super) fn what_is_in_the_way(&mut self) -> Result<Option<String>, ReachError> {
        let Some((value, failed)) = self.failure.take() else { return Ok(None) };
        let weight = CHEAP_EFFORT * failed.scenario.weights().control;
        if !failed.planned.solution.status.is_acceptable() || weight == 0.0 {
            return Ok(None);
        }
        let cheap = failed.scenario.varied(|file| file.weights.control = Some(weight))?;
        let watch = &mut *self.watch;
        let mut planner = Planner::new().without_remedies().warm_start(&failed.planned.trajectory);
        let planned = planner.plan(&cheap, &mut |record| watch(Progress::Iteration(record)))?;
        let found = Reached { scenario: cheap, planned };
        if found.planned.solution.status == Status::Interrupted {
            self.is_interrupted = true;
            return Ok(None);
        }
        let at = self.shown(value);
        let note = match self.succeeds(&found) {
            true => format!(
                "{at} fails because effort costs too much, not because of the arm: it succeeds \
                 with weights.control {weight:.1e}"
            ),
            false => format!("{at} fails even with weights.control {weight:.1e}"),
        };
        Ok(Some(note))
    }

    fn variant(&self, value: f64) -> Result<Scenario, ReachError> {
        Ok(self.scenario.varied(|file| match self.settings.quantity {
            Quantity::Duration => {
                file.horizon.duration_s =
                    file::Duration::Given(file.horizon.duration_s.longest_s());
                file.stretch_to_s(value);
                file.weights.time = None;
            }
            Quantity::Angle => {
                let asked = file.slew_axis_and_angle_deg();
                file.maneuver.target_attitude = None;
                file.maneuver.axis = asked.map(|(axis, _)| axis);
                file.maneuver.angle_deg = asked.map(|(_, angle_deg)| value.copysign(angle_deg));
            }
        })?)
    }

    /// Takes down a try that need not be solved to be known to fail.
    fn fails_unsolved(&mut self, tried: Try) {
        let control = (self.watch)(Progress::Tried(&tried));
        self.tries.push(tried);
        self.is_interrupted |= control == Control::Stop;
    }

    fn solve(
        &mut self,
        scenario: &Scenario,
        value: f64,
        start: StartedFrom,
    ) -> Result<Reached, ReachError> {
        let watch = &mut *self.watch;
        let mut stop = watch(Progress::Trying { value, start }) == Control::Stop;
        let mut on_iteration = |record: &IterationRecord| {
            stop |= watch(Progress::Iteration(record)) == Control::Stop;
            if stop { Control::Stop } else { Control::Continue }
        };
        let nearest = self.successes.last().or(self.fastest.as_ref());
        let planned = match (start, nearest) {
            (StartedFrom::Neighbor | StartedFrom::Fastest, Some((_, neighbor))) => {
                let mut planner =
                    Planner::new().without_remedies().warm_start(&neighbor.planned.trajectory);
                planner.plan(scenario, &mut on_iteration)?
            }
            (StartedFrom::LowDiscrepancy, _) => {
                let starts = self.settings.starts;
                let guess = Guess::Starts(LowDiscrepancyStarts { starts, seed: 0 });
                let many = scenario.varied(|file| file.solver.guess = Some(guess))?;
                Planner::new().without_remedies().plan(&many, &mut on_iteration)?
            }
            _ => Planner::new().without_remedies().plan(scenario, &mut on_iteration)?,
        };
        self.is_interrupted |= stop || planned.solution.status == Status::Interrupted;
        Ok(Reached { scenario: scenario.clone(), planned })
    }

    fn succeeds(&self, found: &Reached) -> bool {
        found.planned.solution.verification.passed
            && self.goal_deg_s.is_none_or(|goal| terminal(found).angular_rate_deg_s <= goal)
    }

    /// Whether a failed plan comes closer than another: a converged one does, then what it misses
    /// decides.
    fn misses_less(&self, a: &Reached, b: &Reached) -> bool {
        let rank = |found: &Reached| {
            let terminal = terminal(found);
            let missed = match self.goal_deg_s {
                Some(_) => terminal.angular_rate_deg_s,
                None => terminal.attitude_error,
            };
            (!found.planned.solution.status.is_acceptable(), missed)
        };
        let ((a_failed, a_missed), (b_failed, b_missed)) = (rank(a), rank(b));
        a_failed.cmp(&b_failed).then(a_missed.total_cmp(&b_missed)).is_lt()
    }

    fn tried(
        &self,
        start: StartedFrom,
        neighbor: Option<f64>,
        iterations: usize,
        found: &Reached,
    ) -> Try {
        let terminal = terminal(found);
        let succeeded = self.succeeds(found);
        let shortfall = match (succeeded, found.planned.solution.verification.failures().next()) {
            (true, _) => None,
            (false, _) if !found.planned.solution.status.is_acceptable() => {
                Some("no plan".to_owned())
            }
            (false, Some(check)) => Some(check.to_string()),
            (false, None) => self.goal_deg_s.map(|goal| {
                let left = terminal.angular_rate_deg_s;
                format!("angular rate at the end: {left:.3} deg/s, at most {goal:.3}")
            }),
        };
        Try {
            duration_s: found.scenario.horizon().duration_s,
            angle_deg: angle_deg(&found.scenario),
            succeeded,
            is_verified: found.planned.solution.verification.passed,
            status: found.planned.solution.status,
            start,
            neighbor,
            iterations,
            objective: found.planned.solution.objective,
            terminal,
            shortfall,
        }
    }

    fn shown(&self, value: f64) -> String {
        match self.settings.quantity {
            Quantity::Duration => format!("{value} s"),
            Quantity::Angle => format!("{value}\u{b0}"),
        }
    }
}

/// The try of a variant of a scenario that need not be solved to be known to fail.
fn not_solved(scenario: &Scenario, settings: ReachSettings, value: f64, shortfall: String) -> Try {
    let unknown = f64::NAN;
    let (duration_s, angle_deg) = match settings.quantity {
        Quantity::Duration => (value, angle_deg(scenario)),
        Quantity::Angle => {
            let signed = |asked: f64| value.copysign(asked);
            (scenario.horizon().duration_s, angle_deg(scenario).map(signed))
        }
    };
    Try {
        duration_s,
        angle_deg,
        succeeded: false,
        is_verified: false,
        status: Status::Infeasible,
        start: StartedFrom::Cold,
        neighbor: None,
        iterations: 0,
        objective: unknown,
        terminal: Terminal {
            attitude_error: unknown,
            attitude_error_deg: unknown,
            angular_rate_deg_s: unknown,
            joint_rate_deg_s: unknown,
            joint_speed_m_s: None,
        },
        shortfall: Some(shortfall),
    }
}

/// The angle of a slew as its scenario has it, deg.
fn angle_deg(scenario: &Scenario) -> Option<f64> {
    scenario.resolved().slew_axis_and_angle_deg().map(|(_, angle_deg)| angle_deg)
}

fn terminal(found: &Reached) -> Terminal {
    found.planned.solution.terminal
}
