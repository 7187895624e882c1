//! What a scenario asks for.

use nalgebra::Vector3;
use righting_multibody::Quaternion;

use crate::error::Error;
use crate::file;
use crate::initial::Initial;
use crate::json::{Bounds, Location, Number};
use crate::system_description::unit_quaternion;

const SLEW_ANGLE_DEG: Bounds = Bounds::Between(-180.0, 180.0);
const AXIS: Bounds = Bounds::Between(-1e6, 1e6);
/// Shorter than this, the square of an axis is lost.
const SHORTEST_AXIS: f64 = 1e-150;

/// What to do.
#[derive(Clone, Debug, PartialEq)]
pub enum Maneuver {
    /// Turn the base, rest to rest.
    Slew(Slew),
    /// Reduce the base's angular rate and stop the arm.
    Detumble,
}

/// A turn of the base, rest to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Slew {
    /// Unit axis in body axes at the start; of a target attitude that is the start's, any.
    pub axis: Vector3<f64>,
    /// Angle about the axis, rad; where a target attitude is given, in [0, π].
    pub angle_rad: f64,
    /// Attitude to reach, body → inertial: the initial attitude turned about `axis` by `angle_rad`.
    pub target: Quaternion<f64>,
}

impl Maneuver {
    /// Checks a maneuver that was read from `place` and begins at `initial`.
    pub(crate) fn from_file(
        maneuver: &file::Maneuver,
        initial: &Initial,
        place: &Location,
        notes: &mut Vec<String>,
    ) -> Result<Maneuver, Error> {
        let file::Maneuver { axis, angle_deg, target_attitude, waypoints, .. } = maneuver;
        match maneuver.kind {
            file::ManeuverType::Slew => {
                let target = (axis, angle_deg, target_attitude);
                slew_to(target, initial, place, notes).map(Maneuver::Slew)
            }
            file::ManeuverType::Detumble => {
                let given = [
                    ("axis", "an axis", axis.is_some()),
                    ("angle_deg", "an angle", angle_deg.is_some()),
                    ("target_attitude", "an attitude", target_attitude.is_some()),
                    ("waypoints", "waypoints", !waypoints.is_empty()),
                ];
                match given.into_iter().find(|(.., is_given)| *is_given) {
                    Some((name, found, _)) => {
                        Err(place.key(name).refuse(found, "none for a detumble"))
                    }
                    None => Ok(Maneuver::Detumble),
                }
            }
        }
    }

    /// What to turn to, of a slew.
    pub fn slew(&self) -> Option<&Slew> {
        match self {
            Self::Slew(slew) => Some(slew),
            Self::Detumble => None,
        }
    }
}

/// Axis, angle in degrees and attitude, of which a file gives the first two or the last.
pub(crate) type Target<'f> = (&'f Option<[f64; 3]>, &'f Option<f64>, &'f Option<[f64; 4]>);

/// Checks a target that stands in the object at `place`.
pub(crate) fn slew_to(
    (axis, angle_deg, target_attitude): Target<'_>,
    initial: &Initial,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<Slew, Error> {
    let Some(wxyz) = target_attitude else {
        return turned((*axis, *angle_deg), initial, &place.key("axis"), &place.key("angle_deg"));
    };
    let target_place = place.key("target_attitude");
    let given = [axis.map(|_| "axis"), angle_deg.map(|_| "angle_deg")];
    let beside: Vec<&str> = given.into_iter().flatten().collect();
    if !beside.is_empty() {
        return Err(target_place.refuse(
            format_args!("an attitude beside {}", beside.join(" and ")),
            "either target_attitude, or axis and angle_deg",
        ));
    }
    let target = unit_quaternion(*wxyz, &target_place, notes)?;
    let turn = initial.attitude.conjugate().product(&target);
    let (axis, angle_rad) = turn.to_axis_angle();
    Ok(Slew { axis, angle_rad, target })
}

/// A slew by an angle about an axis.
fn turned(
    (axis, angle_deg): (Option<[f64; 3]>, Option<f64>),
    initial: &Initial,
    axis_place: &Location,
    angle_place: &Location,
) -> Result<Slew, Error> {
    let axis = axis.ok_or_else(|| {
        axis_place.missing(match angle_deg {
            Some(_) => "the axis of the slew",
            None => "the axis of the slew, with angle_deg, or target_attitude instead of both",
        })
    })?;
    let angle_deg = angle_deg.ok_or_else(|| angle_place.missing("the angle of the slew"))?;
    axis_place.all_within(axis, AXIS)?;
    let axis = Vector3::from(axis).try_normalize(SHORTEST_AXIS).ok_or_else(|| {
        let [x, y, z] = axis.map(Number);
        axis_place.refuse(format!("[{x}, {y}, {z}]"), "a vector that is not zero")
    })?;
    let angle_rad = angle_place.within(angle_deg, SLEW_ANGLE_DEG)?.to_radians();
    let turn = Quaternion::from_axis_angle(&axis, angle_rad);
    Ok(Slew { axis, angle_rad, target: initial.attitude.product(&turn) })
}

impl file::Scenario {
    /// Of a checked slew: the axis as the file has it (body axes at the start) and the angle about it, deg; of
    /// a target attitude, those that lead there the shortest way. None for a detumble.
    pub fn slew_axis_and_angle_deg(&self) -> Option<([f64; 3], f64)> {
        let file::Maneuver { axis, angle_deg, target_attitude, .. } = &self.maneuver;
        let Some(target) = target_attitude else { return Some(((*axis)?, (*angle_deg)?)) };
        let start = self.initial.attitude.unwrap_or([1.0, 0.0, 0.0, 0.0]);
        let [start, target] =
            [start, *target].map(|wxyz| Quaternion::from_array(wxyz).normalized());
        let (axis, angle_rad) = start.conjugate().product(&target).to_axis_angle();
        Some((axis.into(), angle_rad.to_degrees()))
    }
}
