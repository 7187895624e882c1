//! What a slew takes at least, about: before anything is solved.

use nalgebra::{Matrix3xX, Vector3};
use righting_analysis::holonomy::connection;
use righting_ocp::InitialGuess;
use righting_scenario::scenario::{Maneuver, REFERENCE_INTERVAL_S};

use super::InitialGuesses;

/// A motion along a straight line in joint space counts where it turns the base about the axis to within
/// this share of the angle.
const STRAY: f64 = 0.1;
/// Singular values of the connection below this share of the largest are none.
const RANK: f64 = 1e-6;
/// ∫ü² of the least effort from rest to rest, for a unit of length and of time.
const REST_TO_REST: f64 = 12.0;

impl InitialGuesses<'_> {
    /// About the least ∫‖q̈‖² dt, over [`REFERENCE_INTERVAL_S`], with which the base turns as far as a slew
    /// asks, `smallest_rad` at the least: of closed loops, and of the straight line in joint space that
    /// turns it so to first order.
    pub(crate) fn least_effort(&self, smallest_rad: f64) -> f64 {
        let Maneuver::Slew(slew) = self.scenario.maneuver() else { return 1.0 };
        let axis = slew.axis * slew.angle_rad.signum();
        let angle_rad = slew.angle_rad.abs().max(smallest_rad);
        let duration_s = self.scenario.horizon().duration_s;
        let line = self.straight_line(&(axis * angle_rad));
        let line = line.map(|length_rad| REST_TO_REST * length_rad.powi(2) / duration_s.powi(3));
        let step_s = duration_s / self.steps as f64;
        let of_loop = |guess: &InitialGuess| {
            let accelerations = (0..self.steps).flat_map(|step| {
                self.coordinates.accelerations(guess.states.row(step), guess.controls.row(step))
            });
            accelerations.map(|u| u * u).sum::<f64>() * step_s
        };
        let loops = self.single_loops(&axis, angle_rad);
        let least = loops.iter().map(of_loop).chain(line).fold(f64::INFINITY, f64::min);
        let least = match least.is_finite() && least > 0.0 {
            true => least,
            // Nothing turns it so from here; a radian of joint motion is as good a measure as any.
            false => REST_TO_REST / duration_s.powi(3),
        };
        (least + self.posture_effort(duration_s)) / REFERENCE_INTERVAL_S
    }

    /// The least ∫‖q̈‖² dt with which the joints come to the posture at the end, as far as it is given.
    fn posture_effort(&self, duration_s: f64) -> f64 {
        let start = &self.scenario.initial().joint_angles_rad;
        let ways = start.iter().zip(self.scenario.end_angles_rad());
        let squares = ways.filter_map(|(start, end)| Some(((*end)? - start).powi(2)));
        REST_TO_REST * squares.sum::<f64>() / duration_s.powi(3)
    }

    /// The length of the shortest joint motion that turns the base by `turn_rad` to first order.
    fn straight_line(&self, turn_rad: &Vector3<f64>) -> Option<f64> {
        let angles = &self.scenario.initial().joint_angles_rad;
        let mut columns = connection(&self.scenario.system().model, angles);
        for (joint, column) in columns.iter_mut().enumerate() {
            if self.coordinates.is_locked(joint) {
                column.fill(0.0);
            }
        }
        let connection = Matrix3xX::from_columns(&columns);
        let decomposition = connection.clone().svd(true, true);
        let most = decomposition.singular_values.max();
        let motion = decomposition.solve(turn_rad, RANK * most).ok()?;
        let stray = (connection * &motion - turn_rad).norm();
        (most > 0.0 && stray <= STRAY * turn_rad.norm()).then(|| motion.norm())
    }
}
