//! Initial guesses: trajectories to start the optimizer from.

mod effort;
mod joint_loops;
mod wheels;

use std::f64::consts::PI;

use righting_multibody::{Quaternion, State};
use righting_ocp::{InitialGuess, RungeKutta4, Samples};
use righting_results::trajectory::Trajectory;
use righting_scenario::halton::Halton;
use righting_scenario::scenario::Scenario;

use crate::formulation::Coordinates;
use crate::symmetry::{Mirror, reversed};

/// How far a low-discrepancy guess takes a joint without limits, rad.
const FREE_JOINT_RAD: f64 = 2.0;
/// So much nearer to the target an image of an earlier plan must end to be taken in its place, rad.
const NEARER_RAD: f64 = 1e-3;
/// Share of the way to a joint's limit that a guess may take.
const LIMIT_SHARE: f64 = 0.8;

/// The initial guesses of a maneuver on a grid.
pub(crate) struct InitialGuesses<'a> {
    pub(crate) scenario: &'a Scenario,
    pub(crate) coordinates: &'a Coordinates,
    /// x_0.
    pub(crate) initial: &'a [f64],
    pub(crate) steps: usize,
    /// Runge–Kutta steps in each step of the grid, for motions that are simulated.
    pub(crate) substeps: usize,
}

impl InitialGuesses<'_> {
    /// The state held at the start, no control: the paper's guess.
    pub(crate) fn constant(&self) -> InitialGuess {
        let controls = self.coordinates.control_dimension();
        let mut guess = InitialGuess::constant(self.initial, controls, self.steps);
        for node in 1..=self.steps {
            self.coordinates.set_time(guess.states.row_mut(node), self.time(node));
        }
        guess
    }

    /// The time of a node.
    fn time(&self, node: usize) -> f64 {
        self.scenario.horizon().duration_s * node as f64 / self.steps as f64
    }

    /// Low-discrepancy guesses `first`, `first + 1`, … without end; each is the same every time. Every
    /// joint moves smoothly, rest to rest, to somewhere within its limits, and some of the way back. The
    /// ends are points of a Halton sequence; joints whose angle at the end is given go on to there. The base's
    /// attitude is held.
    pub(crate) fn low_discrepancy(&self, first: u64) -> impl Iterator<Item = InitialGuess> {
        let joints = self.scenario.system().joint_count();
        // Two points a guess: how far each joint goes, and how much of it stays.
        let mut points = Halton::starting_after(joints, 2 * first);
        std::iter::from_fn(move || Some(self.with_joints_to(&points.next()?, &points.next()?)))
    }

    /// The `count` of the first `screened` low-discrepancy guesses after which the base turns slowest,
    /// simulated.
    pub(crate) fn least_final_rate(&self, screened: usize, count: usize) -> Vec<InitialGuess> {
        let mut simulated: Vec<(f64, InitialGuess)> = self
            .low_discrepancy(0)
            .take(screened)
            .map(|guess| self.simulated(guess))
            .map(|guess| {
                let end = self.coordinates.free_floating_state(guess.states.row(self.steps));
                (end.angular_rate.norm(), guess)
            })
            .collect();
        simulated.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        simulated.into_iter().take(count).map(|(_, guess)| guess).collect()
    }

    /// Length of a step of the grid.
    pub(crate) fn step_s(&self) -> f64 {
        self.scenario.horizon().duration_s / self.steps as f64
    }

    /// The motion that the guess's controls make: its base turns as momentum has it.
    pub(crate) fn simulated(&self, mut guess: InitialGuess) -> InitialGuess {
        self.simulate(&mut guess, 0, self.step_s(), self.substeps);
        guess
    }

    /// A motion with another guess's joint motion, as a share of it, on top.
    pub(crate) fn displaced(
        &self,
        states: &Samples,
        controls: &Samples,
        by: &InitialGuess,
        share: f64,
    ) -> InitialGuess {
        let mut guess = InitialGuess { states: states.clone(), controls: controls.clone() };
        let joints = self.coordinates.driven_states();
        for node in 1..=self.steps {
            let row = &mut guess.states.row_mut(node)[joints.clone()];
            let change =
                by.states.row(node)[joints.clone()].iter().zip(&self.initial[joints.clone()]);
            row.iter_mut().zip(change).for_each(|(x, (there, here))| *x += share * (there - here));
        }
        for step in 0..self.steps {
            let row = guess.controls.row_mut(step).iter_mut();
            row.zip(by.controls.row(step)).for_each(|(u, change)| *u += share * change);
        }
        self.to_end_posture(guess)
    }

    /// Fills in the states that follow after the first `steps` steps, whose length is `step_s` and each of which
    /// is integrated in so many Runge–Kutta steps.
    pub(crate) fn simulate(
        &self,
        guess: &mut InitialGuess,
        steps: usize,
        step_s: f64,
        substeps: usize,
    ) {
        let step_s = step_s / substeps as f64;
        let mut x = guess.states.row(steps).to_vec();
        let mut point = x.clone();
        let mut method = RungeKutta4::new(x.len());
        for step in steps..self.steps {
            let u = guess.controls.row(step);
            for _ in 0..substeps {
                let next = method.step(step_s, &x, |stage| {
                    stage.write_point(&mut point);
                    stage.set_rates(&self.coordinates.rates(&point, u));
                });
                x.copy_from_slice(next);
            }
            guess.states.row_mut(step + 1).copy_from_slice(&x);
        }
    }

    /// The motion of an earlier plan of the same arm, or its image where that ends nearer to the
    /// target, stretched to this horizon and shifted to this maneuver's first posture.
    pub(crate) fn along_trajectory(&self, plan: &Trajectory) -> InitialGuess {
        let mut guess = self.constant();
        let image = self.nearest_image(plan);
        let plan = image.as_ref().unwrap_or(plan);
        let shift: Vec<f64> = self
            .coordinates
            .joint_angles(self.initial)
            .iter()
            .zip(&plan.start().joint_angles_rad)
            .map(|(here, there)| here - there)
            .collect();
        let old_steps = plan.steps();
        let faster = plan.end().time_s / self.scenario.horizon().duration_s;
        let wheels = self.coordinates.wheel_set();
        let has_wheels = plan.wheels() == self.scenario.wheels().len();
        for node in 1..=self.steps {
            let position = node as f64 * old_steps as f64 / self.steps as f64;
            let before = (position.floor() as usize).min(old_steps - 1);
            let share = position - before as f64;
            let [a, b] = [before, before + 1].map(|node| plan.nodes()[node].state().to_vec());
            let blend: Vec<f64> =
                a.iter().zip(&b).map(|(a, b)| (1.0 - share) * a + share * b).collect();
            let mut state = State::from_slice(&blend).expect("a state of the same arm");
            state.attitude = state.attitude.normalized();
            state.joint_angles.iter_mut().zip(&shift).for_each(|(angle, shift)| *angle += shift);
            state.joint_rates.iter_mut().for_each(|rate| *rate *= faster);
            let shares = match has_wheels {
                true => {
                    let [a, b] = [before, before + 1]
                        .map(|node| wheels.shares(&plan.nodes()[node].wheel_momenta_n_m_s));
                    a.iter().zip(&b).map(|(a, b)| a + share * (b - a)).collect()
                }
                false => wheels.at_start(),
            };
            let row = self.coordinates.of_state_and_wheels(&state, &shares, self.time(node));
            guess.states.row_mut(node).copy_from_slice(&row);
        }
        self.give_torques_of_wheels(&mut guess);
        for joint in 0..plan.joints() {
            self.accelerate(&mut guess, joint, |steps| {
                let phase = steps / self.steps as f64;
                acceleration_at(plan, joint, phase) * faster * faster
            });
        }
        self.to_end_posture(guess)
    }

    /// Sets the controls of the wheels that work to what takes their momenta from node to node.
    fn give_torques_of_wheels(&self, guess: &mut InitialGuess) {
        let (first, step_s) = (self.coordinates.first_wheel(), self.step_s());
        for (place, state) in self.coordinates.wheels().enumerate() {
            for node in 1..=self.steps {
                let [before, after] = [node - 1, node].map(|node| guess.states.row(node)[state]);
                guess.controls.row_mut(node - 1)[first + place] = (after - before) / step_s;
            }
        }
    }

    /// Adds a joint's acceleration, a function of time counted in steps: held at its values in the middles of
    /// the steps, or, where accelerations are states, linear between those at the nodes and zero at both ends.
    fn accelerate(
        &self,
        guess: &mut InitialGuess,
        joint: usize,
        acceleration: impl Fn(f64) -> f64,
    ) {
        let Some(state) = self.coordinates.joint_acceleration(joint) else {
            for step in 0..self.steps {
                guess.controls.row_mut(step)[joint] += acceleration(step as f64 + 0.5);
            }
            return;
        };
        let step_s = self.scenario.horizon().duration_s / self.steps as f64;
        let mut before = 0.0;
        for node in 1..=self.steps {
            let here = if node < self.steps { acceleration(node as f64) } else { 0.0 };
            guess.states.row_mut(node)[state] += here;
            guess.controls.row_mut(node - 1)[joint] += (here - before) / step_s;
            before = here;
        }
    }

    /// The earlier plan of a slew backwards or in a mirror, if that ends nearer to the target.
    fn nearest_image(&self, plan: &Trajectory) -> Option<Trajectory> {
        let slew = self.scenario.maneuver().slew()?;
        if !self.scenario.waypoints().is_empty() || plan.wheels() > 0 {
            return None;
        }
        let wanted = self.scenario.initial().attitude.conjugate().product(&slew.target);
        let miss = |motion: &Trajectory| {
            let [start, end] = [motion.start(), motion.end()]
                .map(|node| Quaternion::from_array(node.attitude).normalized());
            start.conjugate().product(&end).angle_to(&wanted)
        };
        let backwards = reversed(plan);
        let mirrors = Mirror::all(self.scenario.system());
        let seen = mirrors.iter().flat_map(|mirror| [mirror.image(plan), mirror.image(&backwards)]);
        let mut images: Vec<Trajectory> = seen.collect();
        images.insert(0, backwards);
        images.retain(|image| miss(image) < miss(plan) - NEARER_RAD);
        images.into_iter().min_by(|a, b| miss(a).total_cmp(&miss(b)))
    }

    /// A guess with a smooth motion of the joints on top that brings those whose angle at the end is given
    /// there, from rest to rest; the base's attitude stays as it was.
    pub(crate) fn to_end_posture(&self, mut guess: InitialGuess) -> InitialGuess {
        let end = guess.states.row(self.steps);
        let missing = self.scenario.end_angles_rad().iter().enumerate().map(|(joint, angle)| {
            angle.map_or(0.0, |angle| angle - end[self.coordinates.joint_angle(joint)])
        });
        let missing: Vec<f64> = missing.collect();
        if missing.iter().any(|&missing| missing != 0.0) {
            let duration_s = self.scenario.horizon().duration_s;
            let motions =
                missing.iter().map(|&amplitude| Motion { amplitude, back: 0.0, duration_s });
            self.add(&motions.collect::<Vec<_>>(), &mut guess);
        }
        guess
    }

    fn with_joints_to(&self, reach: &[f64], back: &[f64]) -> InitialGuess {
        let duration_s = self.scenario.horizon().duration_s;
        let limits = &self.scenario.system().joint_limits;
        let motions = limits.iter().enumerate().map(|(joint, limits)| {
            let start = self.initial[self.coordinates.joint_angle(joint)];
            let signed = 2.0 * reach[joint] - 1.0;
            let room = match signed > 0.0 {
                true => limits.angle_max_rad - start,
                false => start - limits.angle_min_rad,
            };
            let amplitude = signed * room.clamp(0.0, FREE_JOINT_RAD) * LIMIT_SHARE;
            Motion { amplitude, back: back[joint], duration_s }
        });
        let mut guess = self.constant();
        let rates = self.coordinates.joint_rate(0)..self.coordinates.joint_rate(limits.len());
        for node in 1..=self.steps {
            guess.states.row_mut(node)[rates.clone()].fill(0.0);
        }
        self.add(&motions.collect::<Vec<_>>(), &mut guess);
        self.to_end_posture(guess)
    }

    /// Adds motions of the joints to a guess.
    fn add(&self, motions: &[Motion], guess: &mut InitialGuess) {
        for (joint, motion) in motions.iter().enumerate() {
            let (angle, rate) =
                (self.coordinates.joint_angle(joint), self.coordinates.joint_rate(joint));
            for node in 1..=self.steps {
                let row = guess.states.row_mut(node);
                let phase = node as f64 / self.steps as f64;
                row[angle] += motion.angle(phase);
                row[rate] += motion.rate(phase);
            }
            self.accelerate(guess, joint, |steps| motion.acceleration(steps / self.steps as f64));
        }
    }
}

/// A joint's acceleration at a share of a plan's duration; of one that is held, where it changes, the new one.
fn acceleration_at(plan: &Trajectory, joint: usize, phase: f64) -> f64 {
    let position = phase * plan.steps() as f64;
    let before = (position.floor() as usize).min(plan.steps() - 1);
    let [from_s, to_s] = [before, before + 1].map(|node| plan.nodes()[node].time_s);
    let interval = &plan.intervals()[before];
    let after_s = (position - before as f64) * (to_s - from_s);
    interval.joint_accelerations_rad_s2[joint] + after_s * interval.joint_jerk_rad_s3(joint)
}

/// `amplitude · ((1 − b) (1 − cos πs)/2 + b sin² πs)` at the share s of the duration.
struct Motion {
    amplitude: f64,
    /// b: 0 stays there, 1 comes back.
    back: f64,
    duration_s: f64,
}

impl Motion {
    fn angle(&self, s: f64) -> f64 {
        let (stay, back) = (0.5 * (1.0 - (PI * s).cos()), (PI * s).sin().powi(2));
        self.amplitude * ((1.0 - self.back) * stay + self.back * back)
    }

    fn rate(&self, s: f64) -> f64 {
        let (stay, back) = (0.5 * (PI * s).sin(), (2.0 * PI * s).sin());
        self.amplitude * PI * ((1.0 - self.back) * stay + self.back * back) / self.duration_s
    }

    fn acceleration(&self, s: f64) -> f64 {
        let (stay, back) = (0.5 * (PI * s).cos(), 2.0 * (2.0 * PI * s).cos());
        self.amplitude * PI * PI * ((1.0 - self.back) * stay + self.back * back)
            / self.duration_s.powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_and_accelerations_are_the_derivatives_of_the_angle() {
        let motion = Motion { amplitude: 0.7, back: 0.3, duration_s: 5.0 };
        let step = 1e-5;
        for s in [0.0, 0.1, 0.5, 0.83, 1.0] {
            let difference =
                |f: &dyn Fn(f64) -> f64| (f(s + step) - f(s - step)) / (2.0 * step * 5.0);
            assert!((motion.rate(s) - difference(&|s| motion.angle(s))).abs() < 1e-8);
            assert!((motion.acceleration(s) - difference(&|s| motion.rate(s))).abs() < 1e-8);
        }
        assert!(motion.rate(0.0).abs() < 1e-15 && motion.rate(1.0).abs() < 1e-15);
    }
}
