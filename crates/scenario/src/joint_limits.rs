//! What a joint can do.

use std::f64::consts::PI;

use righting_multibody::JointKind;

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Location, Number};
use crate::load_limits::LOAD;
use crate::system_description::LENGTH_M;

/// Coordinates that joints may have, deg or m.
pub(crate) fn coordinates(kind: JointKind) -> Bounds {
    match kind {
        JointKind::Revolute => Bounds::Between(-36_000.0, 36_000.0),
        JointKind::Prismatic => LENGTH_M,
    }
}

// Of a clock that runs a hundred times slower, too.
pub(crate) const RATE_DEG_S: Bounds = Bounds::Above(0.0, 3.6e6);
const ACCELERATION_DEG_S2: Bounds = Bounds::Above(0.0, 3.6e9);
const JERK_DEG_S3: Bounds = Bounds::Above(0.0, 3.6e12);
const SPEED_M_S: Bounds = Bounds::Above(0.0, 1e12);
const ACCELERATION_M_S2: Bounds = Bounds::Above(0.0, 1e15);
const JERK_M_S3: Bounds = Bounds::Above(0.0, 1e18);

/// What a joint can do. One whose smallest angle is its largest is locked: it holds that angle,
/// whatever its rate and acceleration could be.
///
/// Of a joint that slides, angles are travels in m and torques forces in N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits {
    /// What the joint's coordinate is.
    pub kind: JointKind,
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
        let words = row.words();
        let slides = row.kind == JointKind::Prismatic;
        let end = |name: &str, value: Option<f64>, none: f64| match value {
            Some(value) => place.key(name).within(value, coordinates(row.kind)),
            None if slides => Err(place.key(name).missing("where the joint's travel ends, m")),
            None => Ok(none),
        };
        let min = end(words.min, row.min, f64::NEG_INFINITY)?;
        let max = end(words.max, row.max, f64::INFINITY)?;
        if min > max {
            let allowed = format!("at most {}, {}", words.max, Number(max));
            return Err(place.key(words.min).refuse(Number(min), allowed));
        }
        let needed = |name: &str, value: Option<f64>, allowed: Bounds, what: &str| {
            let place = place.key(name);
            value.map_or_else(|| Err(place.missing(what)), |value| place.within(value, allowed))
        };
        let (rates, accelerations, jerks) = match row.kind {
            JointKind::Revolute => (RATE_DEG_S, ACCELERATION_DEG_S2, JERK_DEG_S3),
            JointKind::Prismatic => (SPEED_M_S, ACCELERATION_M_S2, JERK_M_S3),
        };
        let what = if slides { "the largest speed, m/s" } else { "the largest rate, deg/s" };
        needed(words.rate_max, row.rate_max, rates, what)?;
        let what = match row.kind {
            JointKind::Revolute => "the largest acceleration, deg/s²",
            JointKind::Prismatic => "the largest acceleration, m/s²",
        };
        needed(words.acceleration_max, row.acceleration_max, accelerations, what)?;
        if let Some(jerk) = row.jerk_max {
            place.key(words.jerk_max).within(jerk, jerks)?;
        }
        if let Some(effort) = row.effort_max {
            place.key(words.effort_max).within(effort, LOAD)?;
        }
        Ok(Self::of(row))
    }

    /// The limits of a joint that was checked.
    pub(crate) fn of(row: &file::JointRow) -> Self {
        let words = row.words();
        let most = |limit: Option<f64>| words.to_si(limit.unwrap_or(f64::INFINITY));
        Self {
            kind: row.kind,
            angle_min_rad: words.to_si(row.min.unwrap_or(f64::NEG_INFINITY)),
            angle_max_rad: most(row.max),
            rate_max_rad_s: most(row.rate_max),
            acceleration_max_rad_s2: most(row.acceleration_max),
            jerk_max_rad_s3: most(row.jerk_max),
            torque_max_n_m: row.effort_max.unwrap_or(f64::INFINITY),
        }
    }

    /// Whether the joint cannot move: its smallest angle is its largest.
    pub fn is_locked(&self) -> bool {
        self.angle_min_rad == self.angle_max_rad
    }

    /// The largest magnitude that its coordinate can have; +∞ if there is none.
    pub fn farthest(&self) -> f64 {
        self.angle_min_rad.abs().max(self.angle_max_rad.abs())
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
