//! What flies a spacecraft: it is told what is measured, and says what the joints shall do.

use std::time::{Duration, Instant};

use righting_multibody::MassFactors;
use righting_planner::planner::PlanError;
use righting_planner::{Feedback, MassEstimate, Measured, Replanner};
use righting_results::Trajectory;
use righting_scenario::Scenario;

use crate::settings::Settings;

/// Masses are taken into the planner's model when an estimate has changed by more than this share of them.
const NEWS: f64 = 1e-2;

/// What flies a spacecraft along a plan: made once, and cloned for every flight.
///
/// Without an error it never stops: what is not measured, or not planned anew in time, leaves the last good plan as it
/// is.
#[derive(Clone)]
pub struct Guidance {
    commands: Vec<Vec<f64>>,
    /// Times of the nodes, s.
    times_s: Vec<f64>,
    feedback: Option<Feedback>,
    replanner: Option<Replanner>,
    masses: Option<Masses>,
    /// Steps from one replan to the next.
    every: usize,
    /// Steps from a measurement to the first step of its replan.
    delay: usize,
    deadline: Option<Duration>,
    log: Log,
}

/// What happened to the guidance on a flight.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Log {
    /// How long each replan took.
    pub replans: Vec<Duration>,
    /// Replans that were missed: not converged, too late, or without a measurement.
    pub missed: usize,
    /// Measurements that were asked for and lost.
    pub lost: usize,
}

#[derive(Clone)]
struct Masses {
    estimate: MassEstimate,
    /// Those that the replanner has.
    taken: Vec<MassFactors>,
}

impl Guidance {
    /// Along a plan of the scenario.
    ///
    /// # Errors
    /// Those of [`Feedback::new`] and [`Replanner::new`], as the settings have it.
    pub fn new(
        scenario: &Scenario,
        plan: &Trajectory,
        settings: &Settings,
    ) -> Result<Self, PlanError> {
        let Settings { control, sensors, .. } = settings;
        let intervals = plan.intervals().iter();
        let commands: Vec<Vec<f64>> =
            intervals.map(|interval| interval.joint_accelerations_rad_s2.clone()).collect();
        let step_s = plan.end().time_s / commands.len() as f64;
        let steps_in = |seconds: f64| (seconds / step_s).round() as usize;
        let estimates = settings.estimates_masses && control.has_replans();
        let masses = estimates.then(|| {
            let estimate = MassEstimate::new(scenario, plan, sensors.attitude_rad);
            Masses { taken: estimate.factors(), estimate }
        });
        Ok(Self {
            times_s: plan.nodes().iter().map(|node| node.time_s).collect(),
            feedback: match control.has_feedback() {
                true => Some(Feedback::new(scenario, plan)?),
                false => None,
            },
            replanner: match control.has_replans() {
                true => Some(Replanner::new(scenario, plan)?),
                false => None,
            },
            masses,
            every: steps_in(settings.period_s).max(1),
            delay: steps_in(settings.delay_s),
            deadline: settings.deadline,
            commands,
            log: Log::default(),
        })
    }

    /// Number of steps.
    pub fn steps(&self) -> usize {
        self.commands.len()
    }

    /// When a node is, s; a step begins at the node of its number.
    pub fn time_s(&self, node: usize) -> f64 {
        self.times_s[node]
    }

    /// Duration of a step, s.
    pub fn step_s(&self, step: usize) -> f64 {
        self.times_s[step + 1] - self.times_s[step]
    }

    /// Whether what is measured at the beginning of a step would make a difference.
    pub fn asks_for_measurement(&self, step: usize) -> bool {
        self.feedback.is_some() || self.is_replanned(step)
    }

    /// Whether the rest is planned anew from the beginning of a step.
    pub fn is_replanned(&self, step: usize) -> bool {
        let is_due = step > 0 && step.is_multiple_of(self.every);
        self.replanner.is_some() && is_due && step + self.delay < self.steps()
    }

    /// What the joints shall do in a step (j, rad/s²) that begins where it is measured; `misses_replan` says that a
    /// replan that is due is not made in time.
    ///
    /// What is not finite counts as not measured.
    ///
    /// # Panics
    /// There is no such step, or not one joint value a joint.
    pub fn command(
        &mut self,
        step: usize,
        measured: Option<Measured<'_>>,
        misses_replan: bool,
    ) -> Vec<f64> {
        let measured = measured.filter(Measured::is_finite);
        if self.asks_for_measurement(step) && measured.is_none() {
            self.log.lost += 1;
        }
        if self.is_replanned(step) {
            let replanned = match measured {
                Some(measured) if !misses_replan => self.replan(step, &measured),
                _ => None,
            };
            match replanned {
                Some(time) => self.log.replans.push(time),
                None => self.log.missed += 1,
            }
        }
        match (&self.feedback, &measured) {
            (Some(feedback), Some(measured)) => feedback.accelerations(step, measured),
            _ => self.commands[step].clone(),
        }
    }

    /// What happened so far.
    pub fn log(&self) -> &Log {
        &self.log
    }

    /// Plans the rest anew and says how long it took; none where it is missed.
    fn replan(&mut self, step: usize, measured: &Measured<'_>) -> Option<Duration> {
        let started = Instant::now();
        let replanner = self.replanner.as_mut()?;
        let mut here = *measured;
        if let Some(masses) = &mut self.masses {
            masses.take_in(self.times_s[step], &mut here, replanner);
        }
        let first = step + self.delay;
        let there = replanner.ahead(step, &here, &self.commands[step..first]).pop()?;
        let there = there.as_measured();
        let deadline = self.deadline.map(|deadline| deadline.saturating_sub(started.elapsed()));
        let replan = replanner.replan(first, &there, deadline).ok()??;
        self.commands.splice(first.., replan.accelerations_rad_s2);
        if let Some(feedback) = &mut self.feedback {
            let last = (first + self.every + self.delay).min(self.commands.len());
            let commands = &self.commands[first..last];
            feedback.follow(first, &replanner.ahead(first, &there, commands), commands);
        }
        Some(started.elapsed())
    }
}

impl Masses {
    /// Takes in what is measured at a time, s: its attitude becomes the estimated one, and the replanner's masses do where
    /// that is news. Masses that no system can have teach nothing.
    fn take_in(&mut self, time_s: f64, measured: &mut Measured<'_>, replanner: &mut Replanner) {
        if self.estimate.observe(time_s, measured).is_err() {
            return;
        }
        measured.attitude = self.estimate.attitude();
        let factors = self.estimate.factors();
        if !differ(&factors, &self.taken) {
            return;
        }
        self.taken = factors;
        if let Ok(scenario) = self.estimate.scenario()
            && let Ok(adapted) = replanner.adapted(&scenario)
        {
            *replanner = adapted;
        }
    }
}

/// Whether masses or inertias differ by more than what is no news.
fn differ(factors: &[MassFactors], others: &[MassFactors]) -> bool {
    factors
        .iter()
        .zip(others)
        .any(|(a, b)| (a.mass - b.mass).abs() > NEWS || (a.inertia - b.inertia).abs() > NEWS)
}
