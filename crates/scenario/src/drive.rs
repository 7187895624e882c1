//! Joint drives: friction, rotor, gear and motor between a joint and what it draws.
//!
//! With τ the torque that moves the arm, b the friction, J the rotor's inertia and n the gear ratio, the
//! drive gives
//!
//! ```text
//! τ_d = τ + b q̇ + n² J q̈
//! ```
//!
//! at the joint (Siciliano et al., *Robotics: Modelling, Planning and Control*, section 7.2.2; the rotor's
//! spin is taken along with its joint, as an inertia of the joint alone: its momentum about the other axes
//! and in the base's balance is left out).

use righting_scalar::Scalar;

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Location};
use crate::load_limits::LOAD;

const FRICTION_N_M_S: Bounds = Bounds::Between(0.0, 1e30);
const ROTOR_INERTIA_KG_M2: Bounds = Bounds::Between(0.0, 1e30);
const GEAR_RATIO: Bounds = Bounds::Above(0.0, 1e6);
const EFFICIENCY: Bounds = Bounds::Above(0.0, 1.0);
const RESISTANCE_OHM: Bounds = Bounds::Above(0.0, 1e9);
const POWER_W: Bounds = Bounds::Between(0.0, 1e9);

/// What stands between a joint and its motor's supply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Viscous friction b at the joint, N m s.
    pub viscous_friction_n_m_s: f64,
    /// Inertia J of the rotor about its axis, before the gear, kg m².
    pub rotor_inertia_kg_m2: f64,
    /// Turns n of the motor a turn of the joint.
    pub gear_ratio: f64,
    /// Share of the power that passes the gear.
    pub gear_efficiency: f64,
    /// The motor, where it is known.
    pub motor: Option<Motor>,
    /// Power of the electronics, W.
    pub idle_power_w: f64,
    /// Power that holds a joint that stands still, W; `None` where the motor holds it.
    pub holding_power_w: Option<f64>,
}

/// A direct-current motor, or a brushless one as its drive sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Torque an ampere, N m/A, which is also the voltage a rad/s.
    pub torque_constant_n_m_a: f64,
    /// Resistance of the windings, Ω.
    pub resistance_ohm: f64,
}

impl Default for Drive {
    /// A drive that adds nothing.
    fn default() -> Self {
        Self {
            viscous_friction_n_m_s: 0.0,
            rotor_inertia_kg_m2: 0.0,
            gear_ratio: 1.0,
            gear_efficiency: 1.0,
            motor: None,
            idle_power_w: 0.0,
            holding_power_w: None,
        }
    }
}

impl Drive {
    /// Checks the drive of a joint of the system that was read from `place`.
    pub(crate) fn of_joint(row: &file::JointRow, place: &Location) -> Result<Self, Error> {
        let drive_place = row.at(place).key("drive");
        row.drive.as_ref().map_or(Ok(Self::default()), |drive| Self::from_file(drive, &drive_place))
    }

    fn from_file(drive: &file::Drive, place: &Location) -> Result<Self, Error> {
        let usual = Self::default();
        let value = |name: &str, value: Option<f64>, allowed: Bounds, usual: f64| match value {
            Some(value) => place.key(name).within(value, allowed),
            None => Ok(usual),
        };
        let motor = match (drive.torque_constant_n_m_a, drive.resistance_ohm) {
            (None, None) => None,
            (Some(constant), Some(resistance)) => Some(Motor {
                torque_constant_n_m_a: place.key("torque_constant_n_m_a").within(constant, LOAD)?,
                resistance_ohm: place.key("resistance_ohm").within(resistance, RESISTANCE_OHM)?,
            }),
            (Some(_), None) => {
                let what = "the resistance of the windings, which goes with torque_constant_n_m_a";
                return Err(place.key("resistance_ohm").missing(what));
            }
            (None, Some(_)) => {
                let what = "the motor's torque an ampere, which goes with resistance_ohm";
                return Err(place.key("torque_constant_n_m_a").missing(what));
            }
        };
        let file::Drive { viscous_friction_n_m_s: friction, rotor_inertia_kg_m2: rotor, .. } =
            *drive;
        Ok(Self {
            viscous_friction_n_m_s: value(
                "viscous_friction_n_m_s",
                friction,
                FRICTION_N_M_S,
                usual.viscous_friction_n_m_s,
            )?,
            rotor_inertia_kg_m2: value(
                "rotor_inertia_kg_m2",
                rotor,
                ROTOR_INERTIA_KG_M2,
                usual.rotor_inertia_kg_m2,
            )?,
            gear_ratio: value("gear_ratio", drive.gear_ratio, GEAR_RATIO, usual.gear_ratio)?,
            gear_efficiency: value(
                "gear_efficiency",
                drive.gear_efficiency,
                EFFICIENCY,
                usual.gear_efficiency,
            )?,
            motor,
            idle_power_w: value("idle_power_w", drive.idle_power_w, POWER_W, usual.idle_power_w)?,
            holding_power_w: drive
                .holding_power_w
                .map(|power_w| place.key("holding_power_w").within(power_w, POWER_W))
                .transpose()?,
        })
    }

    /// The rotor's inertia as the joint feels it, n² J, kg m².
    pub fn reflected_inertia_kg_m2(&self) -> f64 {
        self.gear_ratio.powi(2) * self.rotor_inertia_kg_m2
    }

    /// The torque τ_d that the drive gives at the joint (N m) where `torque` moves the arm, at a joint rate
    /// (rad/s) and acceleration (rad/s²).
    pub fn torque<T: Scalar>(&self, torque: T, rate: T, acceleration: T) -> T {
        let mut sum = torque;
        if self.viscous_friction_n_m_s > 0.0 {
            sum += rate * self.viscous_friction_n_m_s;
        }
        let reflected = self.reflected_inertia_kg_m2();
        if reflected > 0.0 {
            sum += acceleration * reflected;
        }
        sum
    }
}
