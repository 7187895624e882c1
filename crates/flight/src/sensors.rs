//! What is measured of a plant.

use nalgebra::Vector3;
use rand::rngs::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use righting_multibody::Quaternion;
use righting_planner::Measured;
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

/// A measurement.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measurement {
    pub attitude: Quaternion<f64>,
    pub joint_angles_rad: Vec<f64>,
    pub joint_rates_rad_s: Vec<f64>,
}

impl Measurement {
    pub(crate) fn as_measured(&self) -> Measured<'_> {
        Measured {
            attitude: self.attitude,
            joint_angles_rad: &self.joint_angles_rad,
            joint_rates_rad_s: &self.joint_rates_rad_s,
        }
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
