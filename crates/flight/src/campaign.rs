//! One plan flown many times.

use std::time::Duration;

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use righting_planner::planner::PlanError;
use righting_planner::{Feedback, Replanner};
use righting_results::Trajectory;
use righting_scenario::{Scenario, file};
use righting_verifier::model::State;

use crate::end::End;
use crate::plant::Plant;
use crate::sensors::Sensors;
use crate::spreads::Spreads;

/// What is done about a spacecraft that is not as planned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Nothing: the plan is flown as it is.
    OpenLoop,
    /// Its gains correct every step from what is measured then.
    Feedback,
    /// The rest is planned anew every [`period`](Settings::period_s).
    Replan,
}

/// How a plan is flown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How far the plants are from the model.
    pub spreads: Spreads,
    /// What is measured.
    pub sensors: Sensors,
    /// What is done about it.
    pub control: Control,
    /// Time from one replan to the next, s; rounded to whole steps of the plan, at least one.
    pub period_s: f64,
    /// A replan that takes longer is missed, and the last plan goes on; none if there is no deadline.
    pub deadline: Option<Duration>,
    /// Seed of all draws.
    pub seed: u64,
}

impl Default for Settings {
    /// Masses and inertias off by up to 10 %, a replan a second, perfect sensors.
    fn default() -> Self {
        Self {
            spreads: Spreads { masses: 0.1, inertias: 0.1, ..Spreads::default() },
            sensors: Sensors::default(),
            control: Control::Replan,
            period_s: 1.0,
            deadline: None,
            seed: 0,
        }
    }
}

/// One plant, flown both ways.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight {
    /// Which flight, counted from zero.
    pub number: usize,
    /// The end of the plan flown as it is.
    pub open_loop: End,
    /// The end with what is done about it.
    pub flown: End,
    /// How long each replan took.
    pub replans: Vec<Duration>,
    /// Replans that were missed: not converged, too late, or nothing sensible measured.
    pub missed: usize,
}

/// A plan to be flown many times.
pub struct Campaign<'a> {
    scenario: &'a Scenario,
    plan: &'a Trajectory,
    settings: Settings,
    pilot: Pilot,
}

/// What flies a plant, made once for all flights.
enum Pilot {
    OpenLoop,
    Feedback(Box<Feedback>),
    /// As it is at the start: each flight has its own clone.
    Replan(Replanner),
}

impl<'a> Campaign<'a> {
    /// Of a plan of the scenario.
    ///
    /// # Errors
    /// Those of [`Feedback::new`] or [`Replanner::new`], as the settings have it; [`PlanError::NotReplanned`] for a
    /// plan with wheels.
    pub fn new(
        scenario: &'a Scenario,
        plan: &'a Trajectory,
        settings: Settings,
    ) -> Result<Self, PlanError> {
        if !scenario.wheels().is_empty() {
            return Err(PlanError::NotReplanned("wheels: plans with wheels are not flown"));
        }
        let pilot = match settings.control {
            Control::OpenLoop => Pilot::OpenLoop,
            Control::Feedback => Pilot::Feedback(Box::new(Feedback::new(scenario, plan)?)),
            Control::Replan => Pilot::Replan(Replanner::new(scenario, plan)?),
        };
        Ok(Self { scenario, plan, settings, pilot })
    }

    /// The first `count` flights, on all cores, in their order. Once `is_stopped`, no further one begins.
    pub fn fly(&self, count: usize, is_stopped: &(impl Fn() -> bool + Sync)) -> Vec<Flight> {
        let begun = (0..count).into_par_iter().filter(|_| !is_stopped());
        begun.map(|number| self.flight(number)).collect()
    }

    /// Flight `number`, counted from zero.
    pub fn flight(&self, number: usize) -> Flight {
        let mut draws = ChaCha8Rng::seed_from_u64(self.settings.seed);
        draws.set_stream(number as u64);
        let system = self.settings.spreads.applied(self.scenario.resolved_system(), &mut draws);
        let mut plant = self.plant(&system);
        for (step, interval) in self.plan.intervals().iter().enumerate() {
            plant.advance(&interval.joint_accelerations_rad_s2, self.step_s(step));
        }
        let open_loop = End::of(self.scenario, &plant.state());

        let mut flight =
            Flight { number, open_loop, flown: open_loop, replans: Vec::new(), missed: 0 };
        let mut plant = self.plant(&system);
        match &self.pilot {
            Pilot::OpenLoop => return flight,
            Pilot::Feedback(feedback) => self.fly_with_feedback(feedback, &mut plant, &mut draws),
            Pilot::Replan(replanner) => {
                self.fly_replanned(replanner.clone(), &mut plant, &mut draws, &mut flight);
            }
        }
        flight.flown = End::of(self.scenario, &plant.state());
        flight
    }

    fn fly_with_feedback(&self, feedback: &Feedback, plant: &mut Plant, draws: &mut ChaCha8Rng) {
        for step in 0..self.plan.steps() {
            let measured = self.settings.sensors.measure(&plant.state(), draws);
            let control = feedback.accelerations(step, &measured.as_measured());
            plant.advance(&control, self.step_s(step));
        }
    }

    fn fly_replanned(
        &self,
        mut replanner: Replanner,
        plant: &mut Plant,
        draws: &mut ChaCha8Rng,
        flight: &mut Flight,
    ) {
        let intervals = self.plan.intervals().iter();
        let controls = intervals.map(|interval| interval.joint_accelerations_rad_s2.clone());
        let mut controls: Vec<Vec<f64>> = controls.collect();
        let step_s = self.plan.end().time_s / controls.len() as f64;
        let every = ((self.settings.period_s / step_s).round() as usize).max(1);
        for step in 0..controls.len() {
            if step > 0 && step % every == 0 {
                let measured = self.settings.sensors.measure(&plant.state(), draws);
                // What was measured is refused where it is not finite: that replan is missed too.
                match replanner.replan(step, &measured.as_measured(), self.settings.deadline) {
                    Ok(Some(replan)) => {
                        flight.replans.push(replan.time);
                        controls.splice(step.., replan.accelerations_rad_s2);
                    }
                    Ok(None) | Err(_) => flight.missed += 1,
                }
            }
            plant.advance(&controls[step], self.step_s(step));
        }
    }

    fn plant(&self, system: &file::System) -> Plant {
        let environment = self.scenario.resolved().environment.as_ref();
        Plant::new(system, environment, &State::of_node(self.plan.start()))
    }

    fn step_s(&self, step: usize) -> f64 {
        let nodes = self.plan.nodes();
        nodes[step + 1].time_s - nodes[step].time_s
    }
}
