//! Where a maneuver is measured to be on its way.

use nalgebra::Vector3;
use righting_multibody::{Quaternion, State};

use crate::scaling::Scaling;

/// Where a maneuver is.
#[derive(Clone, Copy, Debug)]
pub struct Measured<'a> {
    /// Attitude of the base, body → inertial.
    pub attitude: Quaternion<f64>,
    /// Joint angles (j), rad; of joints that slide travels, m.
    pub joint_angles_rad: &'a [f64],
    /// Joint rates (j), rad/s; m/s.
    pub joint_rates_rad_s: &'a [f64],
}

/// Where a maneuver is, or will be: [`Measured`] that owns what it says.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Attitude of the base, body → inertial.
    pub attitude: Quaternion<f64>,
    /// Joint angles (j), rad; of joints that slide travels, m.
    pub joint_angles_rad: Vec<f64>,
    /// Joint rates (j), rad/s; m/s.
    pub joint_rates_rad_s: Vec<f64>,
}

impl Measurement {
    /// The same, borrowed.
    pub fn as_measured(&self) -> Measured<'_> {
        Measured {
            attitude: self.attitude,
            joint_angles_rad: &self.joint_angles_rad,
            joint_rates_rad_s: &self.joint_rates_rad_s,
        }
    }
}

impl Measured<'_> {
    /// Whether all of it are numbers.
    pub fn is_finite(&self) -> bool {
        let joints = self.joint_angles_rad.iter().chain(self.joint_rates_rad_s);
        joints.chain(&self.attitude.to_array()).all(|value| value.is_finite())
    }

    /// The state in the measures of a maneuver, as far as it is measured: the rest of it is zero.
    pub(crate) fn state(&self, scaling: &Scaling) -> State<f64> {
        let time_s = scaling.units.time_s;
        State {
            position: Vector3::zeros(),
            attitude: self.attitude,
            velocity: Vector3::zeros(),
            angular_rate: Vector3::zeros(),
            joint_angles: scaling.joints_measured(self.joint_angles_rad, 1.0),
            joint_rates: scaling.joints_measured(self.joint_rates_rad_s, time_s),
        }
    }
}
