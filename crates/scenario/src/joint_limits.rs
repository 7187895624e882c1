//! What a joint can do.

use std::f64::consts::PI;

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Location, Number};
use crate::load_limits::LOAD;

const JOINT_ANGLE_DEG: Bounds = Bounds::Between(-36_000.0, 36_000.0);
// Of a clock that runs a hundred times slower, too.
pub(crate) const RATE_DEG_S: Bounds = Bounds::Above(0.0, 3.6e6);
const ACCELERATION_DEG_S2: Bounds = Bounds::Above(0.0, 3.6e9);
const JERK_DEG_S3: Bounds = Bounds::Above(0.0, 3.6e12);

/// What a joint can do. One whose smallest angle is its largest is locked: it holds that angle,
/// whatever its rate and acceleration could be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits {
    /// Smallest angle, rad; −∞ if there is none.
    pub angle_min_rad: f64,
    /// Largest angle, rad; +∞ if there is none.
    pub angle_max_rad: f64,
    /// Largest rate in magnitude, rad/s.
    pub rate_max_rad_s: f64,
    /// Largest acceleration in magnitude, rad/s².
    pub acceleration_max_rad_s2: f64,
    /// Largest jerk in magnitude, rad/s³; +∞ if there is no limit.
    pub jerk_max_rad_s3: f64,
    /// Largest torque of the motor in magnitude, N m; +∞ if there is no limit.
    pub torque_max_n_m: f64,
}

impl JointLimits {
    /// Checks the limits of a joint of the system that was read from `place`.
    pub(crate) fn from_file(row: &file::JointRow, place: &Location) -> Result<Self, Error> {
        let place = row.at(place);
        let angle = |name: &str, value: Option<f64>, none: f64| match value {
            Some(value) => place.key(name).within(value, JOINT_ANGLE_DEG),
            None => Ok(none),
        };
        let min_deg = angle("angle_min_deg", row.angle_min_deg, f64::NEG_INFINITY)?;
        let max_deg = angle("angle_max_deg", row.angle_max_deg, f64::INFINITY)?;
        if min_deg > max_deg {
            let allowed = format!("at most angle_max_deg, {}", Number(max_deg));
            return Err(place.key("angle_min_deg").refuse(Number(min_deg), allowed));
        }
        let needed = |name: &str, value: Option<f64>, allowed: Bounds, what: &str| {
            let place = place.key(name);
            value.map_or_else(|| Err(place.missing(what)), |value| place.within(value, allowed))
        };
        let rate_deg_s = row.rate_max_deg_s;
        needed("rate_max_deg_s", rate_deg_s, RATE_DEG_S, "the largest rate, deg/s")?;
        needed(
            "acceleration_max_deg_s2",
            row.acceleration_max_deg_s2,
            ACCELERATION_DEG_S2,
            "the largest acceleration, deg/s²",
        )?;
        if let Some(jerk_deg_s3) = row.jerk_max_deg_s3 {
            place.key("jerk_max_deg_s3").within(jerk_deg_s3, JERK_DEG_S3)?;
        }
        if let Some(torque_n_m) = row.torque_max_n_m {
            place.key("torque_max_n_m").within(torque_n_m, LOAD)?;
        }
        Ok(Self::of(row))
    }

    /// The limits of a joint that was checked.
    pub(crate) fn of(row: &file::JointRow) -> Self {
        let angle_rad = |degrees: Option<f64>, none: f64| degrees.map_or(none, f64::to_radians);
        Self {
            angle_min_rad: angle_rad(row.angle_min_deg, f64::NEG_INFINITY),
            angle_max_rad: angle_rad(row.angle_max_deg, f64::INFINITY),
            rate_max_rad_s: row.rate_max_deg_s.unwrap_or(f64::INFINITY).to_radians(),
            acceleration_max_rad_s2: row
                .acceleration_max_deg_s2
                .unwrap_or(f64::INFINITY)
                .to_radians(),
            jerk_max_rad_s3: row.jerk_max_deg_s3.map_or(f64::INFINITY, f64::to_radians),
            torque_max_n_m: row.torque_max_n_m.unwrap_or(f64::INFINITY),
        }
    }

    /// Whether the joint cannot move: its smallest angle is its largest.
    pub fn is_locked(&self) -> bool {
        self.angle_min_rad == self.angle_max_rad
    }

    /// Smallest and largest angle, rad; for a joint without one of them, one turn in all.
    pub fn angle_range_rad(&self) -> (f64, f64) {
        match (self.angle_min_rad.is_finite(), self.angle_max_rad.is_finite()) {
            (true, true) => (self.angle_min_rad, self.angle_max_rad),
            (true, false) => (self.angle_min_rad, self.angle_min_rad + 2.0 * PI),
            (false, true) => (self.angle_max_rad - 2.0 * PI, self.angle_max_rad),
            (false, false) => (-PI, PI),
        }
    }
}
