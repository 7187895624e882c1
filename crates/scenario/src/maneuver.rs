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
        let (axis_place, angle_place) = (place.key("axis"), place.key("angle_deg"));
        let target_place = place.key("target_attitude");
        match maneuver.kind {
            file::ManeuverType::Slew => match maneuver.target_attitude {
                Some(wxyz) => {
                    let given =
                        [maneuver.axis.map(|_| "axis"), maneuver.angle_deg.map(|_| "angle_deg")];
                    let beside: Vec<&str> = given.into_iter().flatten().collect();
                    if !beside.is_empty() {
                        return Err(target_place.refuse(
                            format_args!("an attitude beside {}", beside.join(" and ")),
                            "either target_attitude, or axis and angle_deg",
                        ));
                    }
                    let target = unit_quaternion(wxyz, &target_place, notes)?;
                    let turn = initial.attitude.conjugate().product(&target);
                    let (axis, angle_rad) = turn.to_axis_angle();
                    Ok(Maneuver::Slew(Slew { axis, angle_rad, target }))
                }
                None => turned(maneuver, initial, &axis_place, &angle_place),
            },
            file::ManeuverType::Detumble => {
                if maneuver.axis.is_some() {
                    return Err(axis_place.refuse("an axis", "none for a detumble"));
                }
                if maneuver.angle_deg.is_some() {
                    return Err(angle_place.refuse("an angle", "none for a detumble"));
                }
                if maneuver.target_attitude.is_some() {
                    return Err(target_place.refuse("an attitude", "none for a detumble"));
                }
                Ok(Maneuver::Detumble)
            }
        }
    }
}

/// A slew by an angle about an axis.
fn turned(
    maneuver: &file::Maneuver,
    initial: &Initial,
    axis_place: &Location,
    angle_place: &Location,
) -> Result<Maneuver, Error> {
    let axis = maneuver.axis.ok_or_else(|| {
        axis_place.missing(match maneuver.angle_deg {
            Some(_) => "the axis of the slew",
            None => "the axis of the slew, with angle_deg, or target_attitude instead of both",
        })
    })?;
    let angle_deg =
        maneuver.angle_deg.ok_or_else(|| angle_place.missing("the angle of the slew"))?;
    axis_place.all_within(axis, AXIS)?;
    let axis = Vector3::from(axis).try_normalize(SHORTEST_AXIS).ok_or_else(|| {
        let [x, y, z] = axis.map(Number);
        axis_place.refuse(format!("[{x}, {y}, {z}]"), "a vector that is not zero")
    })?;
    let angle_rad = angle_place.within(angle_deg, SLEW_ANGLE_DEG)?.to_radians();
    let turn = Quaternion::from_axis_angle(&axis, angle_rad);
    Ok(Maneuver::Slew(Slew { axis, angle_rad, target: initial.attitude.product(&turn) }))
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
