//! Slews that the wheels make, with the arm where it is.

use nalgebra::{DVector, Matrix3xX, Vector3};
use righting_ocp::InitialGuess;
use righting_scenario::scenario::{Maneuver, REFERENCE_INTERVAL_S};

use super::InitialGuesses;

/// Singular values of the wheels' axes below this share of the largest are none.
const RANK: f64 = 1e-9;
/// A momentum counts as one that the wheels can store where they store it to within this share.
const STRAY: f64 = 1e-3;
/// ∫τ² of the least effort from rest to rest for a unit of momentum and of time, and its largest rate and torque.
const REST_TO_REST: f64 = 12.0;
const PEAK_RATE: f64 = 1.5;
const PEAK_TORQUE: f64 = 6.0;

impl InitialGuesses<'_> {
    /// A guess in which the base turns along its way as the guess has it, and the wheels take the momentum that
    /// this needs as far as they can; none where no wheel works.
    pub(crate) fn driven_by_wheels(&self, mut guess: InitialGuess) -> Option<InitialGuess> {
        let wheels = self.coordinates.wheel_set().working();
        if wheels.is_empty() {
            return None;
        }
        let system = &self.scenario.system().model;
        let states = self.coordinates.wheels();
        let step_s = self.step_s();
        let in_store = self.coordinates.wheel_momentum(self.initial);
        let attitude = |guess: &InitialGuess, node: usize| {
            self.coordinates.attitude_of(guess.states.row(node)).normalized()
        };
        let total = attitude(&guess, 0).to_inertial(&in_store)
            + self.scenario.initial().angular_momentum_n_m_s;
        let of_failed = self.coordinates.wheel_set().stored(&vec![0.0; wheels.len()]);
        let least_shares = self.least_shares();
        let mut before: Vec<f64> = guess.states.row(0)[states.clone()].to_vec();
        for node in 1..=self.steps {
            let here = attitude(&guess, node);
            let rate = match node < self.steps {
                // From the attitudes on both sides.
                true => {
                    let [back, on] = [node - 1, node + 1].map(|node| attitude(&guess, node));
                    let (axis, angle_rad) = back.conjugate().product(&on).to_axis_angle();
                    axis * (angle_rad / (2.0 * step_s))
                }
                false => Vector3::zeros(),
            };
            let posture = self.coordinates.joint_angles(guess.states.row(node)).to_vec();
            let wanted = here.to_body(&total) - system.locked_inertia(&posture) * rate - of_failed;
            let shares = least_shares(&wanted);
            let row = guess.states.row_mut(node);
            for (index, wheel) in wheels.iter().enumerate() {
                let most = wheel.rate_max * step_s;
                let reached = shares[index].clamp(before[index] - most, before[index] + most);
                row[states.start + index] = reached.clamp(-1.0, 1.0);
            }
            let after = row[states.clone()].to_vec();
            let rates = &mut guess.controls.row_mut(node - 1)[self.coordinates.first_wheel()..];
            for (rate, (after, before)) in rates.iter_mut().zip(after.iter().zip(&before)) {
                *rate = (after - before) / step_s;
            }
            before = after;
        }
        Some(guess)
    }

    /// About ∫‖τ‖² dt, over [`REFERENCE_INTERVAL_S`], with which the wheels alone make a slew; none where they cannot.
    pub(crate) fn wheel_effort(&self, smallest_rad: f64) -> Option<f64> {
        let Maneuver::Slew(slew) = self.scenario.maneuver() else { return None };
        let wheels = self.coordinates.wheel_set().working();
        if wheels.is_empty() {
            return None;
        }
        let posture = &self.scenario.initial().joint_angles_rad;
        let inertia = self.scenario.system().model.locked_inertia(posture);
        let needed = inertia * slew.axis * slew.angle_rad.abs().max(smallest_rad);
        let shares = self.least_shares()(&needed);
        let pairs = wheels.iter().zip(shares.iter());
        let stored: Vector3<f64> = pairs.clone().map(|(wheel, share)| wheel.full * *share).sum();
        let duration_s = self.scenario.horizon().duration_s;
        let is_within = pairs.clone().all(|(wheel, share)| {
            PEAK_RATE * share.abs() <= duration_s
                && PEAK_TORQUE * share.abs() <= wheel.rate_max * duration_s.powi(2)
        });
        let is_along = (stored - needed).norm() <= STRAY * needed.norm();
        (is_along && is_within).then(|| {
            let squares: f64 =
                pairs.map(|(wheel, share)| (wheel.momentum_max * share).powi(2)).sum();
            REST_TO_REST * squares / duration_s.powi(3) / REFERENCE_INTERVAL_S
        })
    }

    /// What gives the smallest shares of the wheels that work whose momentum is as near to a vector in body axes as it
    /// can be.
    fn least_shares(&self) -> impl Fn(&Vector3<f64>) -> DVector<f64> {
        let wheels = self.coordinates.wheel_set().working();
        let columns: Vec<Vector3<f64>> = wheels.iter().map(|wheel| wheel.full).collect();
        let full = Matrix3xX::from_columns(&columns);
        let decomposition = full.svd(true, true);
        let most = decomposition.singular_values.max();
        let count = wheels.len();
        move |wanted| {
            let solved = decomposition.solve(wanted, RANK * most);
            solved.unwrap_or_else(|_| DVector::zeros(count))
        }
    }
}
