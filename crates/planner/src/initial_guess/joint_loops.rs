//! Starts for slews: closed loops of the joints, of the size that the area rule asks for.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{DMatrix, DVector, Vector3};
use righting_analysis::holonomy::Curvature;
use righting_multibody::Quaternion;
use righting_ocp::InitialGuess;

use super::{InitialGuesses, LIMIT_SHARE};

/// Points of a loop at which it may begin, a quarter of it apart.
const PHASES: usize = 4;
/// Times that the plane of a loop is corrected so that the base turns about the axis wanted, and by how
/// much of what is missing each time.
const AIMINGS: usize = 30;
const AIMING_SHARE: f64 = 0.3;
/// Times that the size of a loop is corrected after trying it.
const SCALINGS: usize = 3;
/// Radius of the largest loop, all joints together, rad.
const LARGEST_RADIUS_RAD: f64 = 2.0;

/// A unit circle q = c cos θ + s sin θ in joint space; c and s are orthogonal unit vectors.
struct Circle {
    cosine: DVector<f64>,
    sine: DVector<f64>,
    /// How far the base turns about the axis wanted, a unit of area.
    turn_per_area: f64,
}

impl InitialGuesses<'_> {
    /// Loops that turn the base towards `target`, once around or a few times, from each quarter of
    /// the loop. The joints come back to where they were; the attitude is interpolated (slerp), which
    /// leads to better plans, in fewer iterations, than the attitude that the loop makes.
    ///
    /// Those with these numbers, `(turns − 1) · 4 + quarter`. None where no small loop around the first
    /// posture turns the base about the axis.
    pub(crate) fn joint_loops(
        &self,
        target: &Quaternion<f64>,
        numbers: &[usize],
    ) -> Vec<InitialGuess> {
        let initial = self.scenario.initial();
        let (axis, angle_rad) = initial.attitude.conjugate().product(target).to_axis_angle();
        let Some(circle) = self.best_circle(&axis) else { return Vec::new() };
        numbers
            .iter()
            .map(|number| {
                let (turns, phase) = (number / PHASES + 1, number % PHASES);
                let circle = circle.started_at(phase as f64 * FRAC_PI_2);
                let looped = self.scaled(&circle, turns, &axis, angle_rad);
                self.turning_about(looped, &axis, angle_rad)
            })
            .collect()
    }

    /// Loops that turn the base by `angle_rad` about `axis` once around, from each quarter of the loop;
    /// none where no small loop does.
    pub(super) fn single_loops(&self, axis: &Vector3<f64>, angle_rad: f64) -> Vec<InitialGuess> {
        let Some(circle) = self.best_circle(axis) else { return Vec::new() };
        let phases = (0..PHASES).map(|phase| circle.started_at(phase as f64 * FRAC_PI_2));
        phases.map(|circle| self.scaled(&circle, 1, axis, angle_rad)).collect()
    }

    /// The circle of the joints that move which turns the base about `axis` best.
    fn best_circle(&self, axis: &Vector3<f64>) -> Option<Circle> {
        let angles = &self.scenario.initial().joint_angles_rad;
        let curvature = Curvature::at(&self.scenario.system().model, angles);
        Circle::best(&curvature, |joint| !self.coordinates.is_locked(joint), axis)
    }

    /// The loop of the size at which it turns the base by `angle_rad` about `axis`, or as large a one
    /// as the joints allow.
    fn scaled(
        &self,
        circle: &Circle,
        turns: usize,
        axis: &Vector3<f64>,
        angle_rad: f64,
    ) -> InitialGuess {
        let start = self.scenario.initial().attitude;
        let area = angle_rad / (turns as f64 * circle.turn_per_area);
        let mut radius = (area / PI).sqrt().min(LARGEST_RADIUS_RAD);
        let mut guess = self.around(circle, radius, turns);
        for _ in 0..SCALINGS {
            let end = self.coordinates.free_floating_state(guess.states.row(self.steps)).attitude;
            let (about, by_rad) = start.conjugate().product(&end).to_axis_angle();
            let turned_rad = by_rad * about.dot(axis);
            let factor = match turned_rad > 0.0 {
                true => (angle_rad / turned_rad).sqrt().clamp(0.5, 2.0),
                false => 0.5,
            };
            radius = (radius * factor).min(LARGEST_RADIUS_RAD);
            guess = self.around(circle, radius, turns);
        }
        guess
    }

    /// The joints go around the circle through the first posture, from rest to rest.
    fn around(&self, circle: &Circle, radius: f64, turns: usize) -> InitialGuess {
        let mut guess = self.constant();
        let step_s = self.scenario.horizon().duration_s / self.steps as f64;
        let initial = &self.scenario.initial().joint_angles_rad;
        for (joint, limits) in self.scenario.system().joint_limits.iter().enumerate() {
            let lowest = (LIMIT_SHARE * (limits.angle_min_rad - initial[joint])).min(0.0);
            let highest = (LIMIT_SHARE * (limits.angle_max_rad - initial[joint])).max(0.0);
            let moved = |time_steps: f64| {
                let s = (time_steps / self.steps as f64).clamp(0.0, 1.0);
                let theta = turns as f64 * (TAU * s - (TAU * s).sin());
                let (cosine, sine) = (circle.cosine[joint], circle.sine[joint]);
                let angle = radius * (cosine * (theta.cos() - 1.0) + sine * theta.sin());
                angle.clamp(lowest, highest)
            };
            let most = limits.acceleration_max_rad_s2;
            self.accelerate(&mut guess, joint, |steps| {
                let [before, here, after] = [steps - 1.0, steps, steps + 1.0].map(moved);
                let acceleration = (before - 2.0 * here + after) / step_s.powi(2);
                acceleration.clamp(-most, most)
            });
        }
        self.simulated(guess)
    }

    /// The same joint motion while the base turns evenly to `target`, from rest to rest.
    pub(crate) fn turning_to(&self, guess: InitialGuess, target: &Quaternion<f64>) -> InitialGuess {
        let start = self.scenario.initial().attitude;
        let (axis, angle_rad) = start.conjugate().product(target).to_axis_angle();
        self.turning_about(guess, &axis, angle_rad)
    }

    /// The same joint motion while the base turns evenly along every leg of a slew with waypoints, from rest to
    /// rest, and rests between them.
    pub(crate) fn turning_along_legs(&self, mut guess: InitialGuess) -> InitialGuess {
        let legs = self.scenario.legs();
        for node in 1..=self.steps {
            let share = node as f64 / self.steps as f64;
            let leg = legs.iter().find(|leg| share < leg.end).or(legs.last());
            let Some(leg) = leg else { break };
            let (axis, angle_rad) = leg.from.conjugate().product(&leg.target).to_axis_angle();
            let of_leg = ((share - leg.start) / (leg.end - leg.start)).clamp(0.0, 1.0);
            let turned = 0.5 * (1.0 - (PI * of_leg).cos());
            let turn = Quaternion::from_axis_angle(&axis, angle_rad * turned);
            self.turn(&mut guess, node, leg.from.product(&turn));
        }
        guess
    }

    /// Sets the base's attitude at a node.
    fn turn(&self, guess: &mut InitialGuess, node: usize, attitude: Quaternion<f64>) {
        let mut state = self.coordinates.free_floating_state(guess.states.row(node));
        state.attitude = attitude;
        let mut row = self.coordinates.of_free_floating_state(&state, self.time(node));
        self.coordinates.copy_driven(guess.states.row(node), &mut row);
        guess.states.row_mut(node).copy_from_slice(&row);
    }

    /// The same joint motion while the base turns evenly about `axis`, from rest to rest.
    fn turning_about(
        &self,
        mut guess: InitialGuess,
        axis: &Vector3<f64>,
        angle_rad: f64,
    ) -> InitialGuess {
        let start = self.scenario.initial().attitude;
        for node in 1..=self.steps {
            let turned = 0.5 * (1.0 - (PI * node as f64 / self.steps as f64).cos());
            let turn = Quaternion::from_axis_angle(axis, angle_rad * turned);
            self.turn(&mut guess, node, start.product(&turn));
        }
        guess
    }
}

impl Circle {
    /// The circle that turns the base about `axis` and nothing else, as far as that can be, by as
    /// much as possible.
    ///
    /// A circle turns it by Σ_ij c_i s_j F_ij a unit of area. Along a direction λ that is cᵀ(λ·F)s,
    /// most for the leading singular vectors of the antisymmetric λ·F; λ is moved until their circle
    /// turns the base about the axis.
    fn best(
        curvature: &Curvature,
        moves: impl Fn(usize) -> bool,
        axis: &Vector3<f64>,
    ) -> Option<Self> {
        let joints = curvature.joints();
        let mut aim = *axis;
        let mut best: Option<(f64, Self)> = None;
        for _ in 0..AIMINGS {
            let entry = |i: usize, j: usize| match moves(i) && moves(j) {
                true => curvature.between(i, j).dot(&aim),
                false => 0.0,
            };
            let decomposition = DMatrix::from_fn(joints, joints, entry).svd(true, true);
            let (left, right) = (decomposition.u?, decomposition.v_t?);
            let (cosine, sine) = (left.column(0).into_owned(), right.row(0).transpose());
            let turned = curvature.turned(&cosine, &sine);
            let turn_per_area = turned.dot(axis);
            if turn_per_area <= 0.0 {
                break;
            }
            let missing = axis - turned.normalize();
            if best.as_ref().is_none_or(|(least, _)| missing.norm() < *least) {
                best = Some((missing.norm(), Self { cosine, sine, turn_per_area }));
            }
            aim = (aim + AIMING_SHARE * missing).normalize();
        }
        best.map(|(_, circle)| circle)
    }

    /// The same circle, counted from another of its points.
    fn started_at(&self, phase: f64) -> Self {
        let (sin, cos) = phase.sin_cos();
        Self {
            cosine: &self.cosine * cos + &self.sine * sin,
            sine: &self.sine * cos - &self.cosine * sin,
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::formulation::{FormulatedManeuver, StageLimits};
    use righting_scenario::file::Formulation;
    use righting_scenario::scenario::Scenario;

    const STEPS: usize = 200;

    /// Calls with the starts of a slew of the 4-DOF arm, bent.
    fn with_guesses(check: impl FnOnce(&InitialGuesses<'_>)) {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/slew_4dof.json");
        let mut changed = Scenario::read(&file).unwrap().resolved().clone();
        changed.initial.joint_angles_deg = vec![20.0, 30.0, -20.0, 10.0];
        let scenario = Scenario::from_file(changed, &file).unwrap();
        let FormulatedManeuver { coordinates, initial, .. } =
            FormulatedManeuver::in_form(&scenario, Formulation::Reduced, &StageLimits::asked());
        check(&InitialGuesses {
            scenario: &scenario,
            coordinates: &coordinates,
            initial: &initial,
            steps: STEPS,
            substeps: 1,
        });
    }

    fn curvature(guesses: &InitialGuesses<'_>) -> Curvature {
        let scenario = guesses.scenario;
        Curvature::at(&scenario.system().model, &scenario.initial().joint_angles_rad)
    }

    #[test]
    fn a_small_loop_turns_the_base_by_its_area_times_the_curvature() {
        with_guesses(|guesses| {
            let curvature = curvature(guesses);
            for (i, j) in [(0, 1), (1, 2), (0, 3)] {
                let unit = |joint| DVector::from_fn(4, |k, _| f64::from(u8::from(k == joint)));
                let (cosine, sine) = (unit(i), unit(j));
                let circle = Circle { cosine, sine, turn_per_area: 1.0 };
                let radius = 0.05;
                let guess = guesses.around(&circle, radius, 1);
                let end = guesses.coordinates.free_floating_state(guess.states.row(STEPS));
                let (axis, angle_rad) = end.attitude.to_axis_angle();
                let predicted = curvature.between(i, j) * (PI * radius * radius);
                let error = (axis * angle_rad - predicted).norm();
                assert!(error < 0.1 * predicted.norm(), "{i} {j}: {error:e} {predicted}");
                let moved = end.joint_angles[i] - guesses.scenario.initial().joint_angles_rad[i];
                assert!(moved.abs() < 1e-3 * radius, "the joints come back: {moved:e}");
            }
        });
    }

    #[test]
    fn a_loop_has_the_size_that_turns_the_base_as_far_as_asked() {
        with_guesses(|guesses| {
            // Small loops from this posture hardly turn the base about x or y alone.
            for axis in [[0.0, 0.6, 0.8], [-0.6, 0.64, 0.48]] {
                let axis = Vector3::from(axis);
                let circle = Circle::best(&curvature(guesses), |_| true, &axis).unwrap();
                let angle_rad = 2e-3;
                let guess = guesses.scaled(&circle, 1, &axis, angle_rad);
                let end = guesses.coordinates.free_floating_state(guess.states.row(STEPS));
                let (about, by_rad) = end.attitude.to_axis_angle();
                let turned_rad = about.dot(&axis) * by_rad;
                assert!((turned_rad / angle_rad - 1.0).abs() < 1e-4, "{axis}: {turned_rad:e}");
            }
        });
    }

    #[test]
    fn a_loop_s_attitude_ends_at_the_target() {
        with_guesses(|guesses| {
            let axis = Vector3::new(0.0, 0.6, 0.8);
            let target = Quaternion::from_axis_angle(&axis, 1.2);
            let loops = guesses.joint_loops(&target, &[0, 5, 11]);
            assert_eq!(loops.len(), 3);
            for guess in loops {
                let end = guesses.coordinates.free_floating_state(guess.states.row(STEPS));
                assert!(end.attitude.angle_to(&target) < 1e-9);
            }
        });
    }
}
