//! One plan flown many times.

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use righting_planner::planner::PlanError;
use righting_results::Trajectory;
use righting_scenario::file::SystemReference;
use righting_scenario::{Scenario, file};
use righting_verifier::model::State;

use crate::end::End;
use crate::flight::Flight;
use crate::guidance::{Guidance, Log};
use crate::joint_drives::DrivenJoints;
use crate::plant::Plant;
use crate::recording::{Motion, Recording, RecordingError};
use crate::sensors::lost;
use crate::settings::Settings;

/// Streams of a generator that flights take: masses and sensors from the one of their number, drives from the one
/// so far after it.
const DRIVES_STREAM: u64 = 1 << 32;

/// A plan to be flown many times.
pub struct Campaign<'a> {
    scenario: &'a Scenario,
    plan: &'a Trajectory,
    settings: Settings,
    /// As it is at the start: each flight has its own clone.
    guidance: Guidance,
}

impl<'a> Campaign<'a> {
    /// Of a plan of the scenario.
    ///
    /// # Errors
    /// Those of [`Guidance::new`]; [`PlanError::NotReplanned`] for a plan with wheels.
    pub fn new(
        scenario: &'a Scenario,
        plan: &'a Trajectory,
        settings: Settings,
    ) -> Result<Self, PlanError> {
        if !scenario.wheels().is_empty() {
            return Err(PlanError::NotReplanned("wheels: plans with wheels are not flown"));
        }
        let guidance = Guidance::new(scenario, plan, &settings)?;
        Ok(Self { scenario, plan, settings, guidance })
    }

    /// The first `count` flights, on all cores, in their order. Once `is_stopped`, no further one begins.
    pub fn fly(&self, count: usize, is_stopped: &(impl Fn() -> bool + Sync)) -> Vec<Flight> {
        let begun = (0..count).into_par_iter().filter(|_| !is_stopped());
        begun.map(|number| self.flight(number)).collect()
    }

    /// Flight `number`, counted from zero.
    pub fn flight(&self, number: usize) -> Flight {
        let (system, draws) = self.spacecraft(number);
        let open_loop = self.fly_open_loop(&system, number, &mut |_, _| ());
        let (flown, log) = self.fly_guided(&system, number, draws, &mut |_, _| ());
        Flight { number, open_loop: Some(open_loop), flown, log }
    }

    /// Flight `number` with all of its motions.
    ///
    /// # Errors
    /// [`RecordingError`].
    pub fn recorded(&self, number: usize) -> Result<Recording, RecordingError> {
        let (system, draws) = self.spacecraft(number);
        let plant = SystemReference::Inline(Box::new(system.clone()));
        let scenario = self.scenario.varied(|file| file.system = plant)?;
        let mut motion = Motion::default();
        let open_loop_end = self.fly_open_loop(&system, number, &mut |t, x| motion.push(t, x));
        let open_loop = motion.trajectory(&scenario)?;
        let mut motion = Motion::default();
        let (flown_end, log) =
            self.fly_guided(&system, number, draws, &mut |t, x| motion.push(t, x));
        let flown = motion.trajectory(&scenario)?;
        if !open_loop_end.is_finite() || !flown_end.is_finite() {
            return Err(RecordingError::Lost);
        }
        let flight = Flight { number, open_loop: Some(open_loop_end), flown: flown_end, log };
        Ok(Recording { flight, scenario, open_loop, flown })
    }

    /// The system of a flight, and what its sensors draw from.
    fn spacecraft(&self, number: usize) -> (file::System, ChaCha8Rng) {
        let mut draws = self.stream(number as u64);
        let system = self.settings.spreads.applied(self.scenario.resolved_system(), &mut draws);
        (system, draws)
    }

    fn stream(&self, stream: u64) -> ChaCha8Rng {
        let mut draws = ChaCha8Rng::seed_from_u64(self.settings.seed);
        draws.set_stream(stream);
        draws
    }

    fn fly_open_loop(
        &self,
        system: &file::System,
        number: usize,
        record: &mut dyn FnMut(f64, &State<'_>),
    ) -> End {
        let (mut plant, mut joints) = self.plant(system, number);
        for (step, interval) in self.plan.intervals().iter().enumerate() {
            record(self.guidance.time_s(step), &plant.state());
            self.advance(&mut plant, &mut joints, &interval.joint_accelerations_rad_s2, step);
        }
        record(self.plan.end().time_s, &plant.state());
        End::of(self.scenario, &plant.state())
    }

    fn fly_guided(
        &self,
        system: &file::System,
        number: usize,
        mut draws: ChaCha8Rng,
        record: &mut dyn FnMut(f64, &State<'_>),
    ) -> (End, Log) {
        let Settings { faults, sensors, .. } = self.settings;
        let (mut plant, mut joints) = self.plant(system, number);
        let mut guidance = self.guidance.clone();
        for step in 0..guidance.steps() {
            record(guidance.time_s(step), &plant.state());
            let measured = guidance.asks_for_measurement(step).then(|| {
                let is_lost = faults.loses_measurement(&mut draws);
                let measured = sensors.measure(&plant.state(), &mut draws);
                if is_lost { lost(self.plan.joints()) } else { measured }
            });
            let misses = guidance.is_replanned(step) && faults.misses_replan(&mut draws);
            let measured = measured.as_ref().map(|measured| measured.as_measured());
            let commands = guidance.command(step, measured, misses);
            self.advance(&mut plant, &mut joints, &commands, step);
        }
        record(self.plan.end().time_s, &plant.state());
        (End::of(self.scenario, &plant.state()), guidance.log().clone())
    }

    fn plant(&self, system: &file::System, number: usize) -> (Plant, DrivenJoints) {
        let environment = self.scenario.resolved().environment.as_ref();
        let plant = Plant::new(system, environment, &State::of_node(self.plan.start()));
        let Settings { drives, faults, .. } = self.settings;
        let draws = self.stream(DRIVES_STREAM + number as u64);
        let joints = DrivenJoints::new(drives, faults.stuck, self.plan.joints(), draws);
        (plant, joints)
    }

    fn advance(&self, plant: &mut Plant, joints: &mut DrivenJoints, commands: &[f64], step: usize) {
        let times = [self.guidance.time_s(step), self.guidance.step_s(step)];
        let pushes = joints.follow(commands, plant.state().joint_rates, times);
        pushes.iter().for_each(|push| plant.advance(&push.accelerations, push.duration_s));
    }
}
