//! Weights of a scenario's objective.

use crate::error::Error;
use crate::file;
use crate::horizon::Horizon;
use crate::json::{Bounds, Location, Number};
use crate::maneuver::Maneuver;

/// The interval that the weight of the control is measured by, s: ∫‖q̈‖² dt over so much of it. On the
/// paper's grid, whose intervals are of this length, that is its sum over the steps.
pub const REFERENCE_INTERVAL_S: f64 = 0.05;

/// The weight of a duration that is free, where none is given.
const FREE_TIME: f64 = 1.0;

const WEIGHT: Bounds = Bounds::Between(0.0, 1e20);

/// Weights of the objective: `control` multiplies the integral over time of the squared joint
/// accelerations, divided by [`REFERENCE_INTERVAL_S`], `time` a duration that is free, each other one the
/// squared norm of its error at the last node. SI and radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// Joint accelerations.
    pub control: f64,
    /// Duration; zero where it is given.
    pub time: f64,
    /// Position of the base.
    pub position: f64,
    /// Vector part of the attitude error quaternion.
    pub attitude: f64,
    /// Velocity of the base.
    pub velocity: f64,
    /// Angular rate of the base.
    pub angular_rate: f64,
    /// Departure of the joint angles from their start.
    pub joint_angle: f64,
    /// Joint rates.
    pub joint_rate: f64,
    /// Torques of the wheels, as `control`.
    pub wheel_torque: f64,
    /// Momenta of the wheels.
    pub wheel_momentum: f64,
}

impl file::Weights {
    /// Whether any weight of the end is given.
    pub(crate) fn has_end(&self) -> bool {
        let Self {
            control: _,
            time: _,
            position,
            attitude,
            velocity,
            angular_rate,
            joint_angle,
            joint_rate,
            wheel_torque: _,
            wheel_momentum: _,
        } = self;
        [position, attitude, velocity, angular_rate, joint_angle, joint_rate]
            .iter()
            .any(|weight| weight.is_some())
    }
}

impl Weights {
    /// Checks weights that were read from `place`; those not given are the maneuver's defaults.
    pub(crate) fn from_file(
        weights: &file::Weights,
        maneuver: &Maneuver,
        (is_duration_free, has_wheels): (bool, bool),
        place: &Location,
    ) -> Result<Weights, Error> {
        for (name, given) in
            [("wheel_torque", weights.wheel_torque), ("wheel_momentum", weights.wheel_momentum)]
        {
            if let (Some(given), false) = (given, has_wheels) {
                return Err(place
                    .key(name)
                    .refuse(Number(given), "none where there are no wheels"));
            }
        }
        if let (Some(time), false) = (weights.time, is_duration_free) {
            let allowed = "none where the duration is given: horizon.duration_s {\"min\", \"max\"}";
            return Err(place.key("time").refuse(Number(time), allowed));
        }
        let defaults = Weights::defaults(maneuver);
        let weight = |name: &str, given: Option<f64>, default: f64| match given {
            Some(value) => place.key(name).within(value, WEIGHT),
            None => Ok(default),
        };
        Ok(Weights {
            control: weight("control", weights.control, defaults.control)?,
            time: weight("time", weights.time, if is_duration_free { FREE_TIME } else { 0.0 })?,
            position: weight("position", weights.position, defaults.position)?,
            attitude: weight("attitude", weights.attitude, defaults.attitude)?,
            velocity: weight("velocity", weights.velocity, defaults.velocity)?,
            angular_rate: weight("angular_rate", weights.angular_rate, defaults.angular_rate)?,
            joint_angle: weight("joint_angle", weights.joint_angle, defaults.joint_angle)?,
            joint_rate: weight("joint_rate", weights.joint_rate, defaults.joint_rate)?,
            wheel_torque: weight("wheel_torque", weights.wheel_torque, defaults.wheel_torque)?,
            wheel_momentum: weight(
                "wheel_momentum",
                weights.wheel_momentum,
                defaults.wheel_momentum,
            )?,
        })
    }

    /// What the control's weight multiplies the sum over a horizon's steps of the squared joint
    /// accelerations by.
    pub fn control_per_step(&self, horizon: Horizon) -> f64 {
        self.control * (horizon.step_s() / REFERENCE_INTERVAL_S)
    }

    /// What the weight of the wheels' torques multiplies the sum of their squares by, as
    /// [`control_per_step`](Self::control_per_step).
    pub fn wheel_torque_per_step(&self, horizon: Horizon) -> f64 {
        self.wheel_torque * (horizon.step_s() / REFERENCE_INTERVAL_S)
    }

    /// The weights of a scenario that gives none.
    pub fn defaults(maneuver: &Maneuver) -> Self {
        let none = Self {
            control: 0.01,
            time: 0.0,
            position: 0.0,
            attitude: 0.0,
            velocity: 0.0,
            angular_rate: 100.0,
            joint_angle: 0.0,
            joint_rate: 0.0,
            wheel_torque: 0.01,
            wheel_momentum: 0.0,
        };
        match maneuver {
            Maneuver::Slew(_) => Self { attitude: 1000.0, joint_rate: 100.0, ..none },
            Maneuver::Detumble => Self { joint_rate: 1000.0, ..none },
        }
    }

    pub(crate) fn to_file(self, is_duration_free: bool, has_wheels: bool) -> file::Weights {
        file::Weights {
            control: Some(self.control),
            time: is_duration_free.then_some(self.time),
            position: Some(self.position),
            attitude: Some(self.attitude),
            velocity: Some(self.velocity),
            angular_rate: Some(self.angular_rate),
            joint_angle: Some(self.joint_angle),
            joint_rate: Some(self.joint_rate),
            wheel_torque: has_wheels.then_some(self.wheel_torque),
            wheel_momentum: has_wheels.then_some(self.wheel_momentum),
        }
    }
}
