//! What is measured of a plant.

use nalgebra::Vector3;
use rand::rngs::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use righting_multibody::Quaternion;
use righting_planner::Measurement;
use righting_verifier::model::State;

/// Standard deviations of what is measured, each measurement by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensors {
    /// Of the attitude, about each axis, rad.
    pub attitude_rad: f64,
    /// Of every joint angle, rad.
    pub joint_angle_rad: f64,
    /// Of every joint rate, rad/s.
    pub joint_rate_rad_s: f64,
}

/// A measurement that is lost: no numbers.
pub(crate) fn lost(joints: usize) -> Measurement {
    Measurement {
        attitude: Quaternion::from_array([f64::NAN; 4]),
        joint_angles_rad: vec![f64::NAN; joints],
        joint_rates_rad_s: vec![f64::NAN; joints],
    }
}

impl Sensors {
    pub(crate) fn measure(&self, state: &State<'_>, draws: &mut ChaCha8Rng) -> Measurement {
        let mut noise = |deviation: f64| {
            let standard: f64 = StandardNormal.sample(draws);
            deviation * standard
        };
        let attitude = Quaternion::from_array(state.attitude_wxyz());
        // Half a small turn is a quaternion's vector part.
        let turn = Vector3::from_fn(|_, _| 0.5 * noise(self.attitude_rad));
        let turn = Quaternion::from_array([1.0, turn.x, turn.y, turn.z]);
        let mut noisy = |values: &[f64], deviation: f64| -> Vec<f64> {
            values.iter().map(|value| value + noise(deviation)).collect()
        };
        Measurement {
            attitude: attitude.product(&turn).normalized(),
            joint_angles_rad: noisy(state.joint_angles, self.joint_angle_rad),
            joint_rates_rad_s: noisy(state.joint_rates, self.joint_rate_rad_s),
        }
    }
}
