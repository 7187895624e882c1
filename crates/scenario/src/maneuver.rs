//! What a scenario asks for.

use nalgebra::Vector3;
use righting_multibody::Quaternion;

use crate::error::Error;
use crate::file;
use crate::initial::Initial;
use crate::json::{Bounds, Location, Number};

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
    /// Unit axis in body axes at the start.
    pub axis: Vector3<f64>,
    /// Angle about the axis, rad.
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
    ) -> Result<Maneuver, Error> {
        let (axis_place, angle_place) = (place.key("axis"), place.key("angle_deg"));
        match maneuver.kind {
            file::ManeuverType::Slew => {
                let axis =
                    maneuver.axis.ok_or_else(|| axis_place.missing("the axis of the slew"))?;
                let angle_deg = maneuver
                    .angle_deg
                    .ok_or_else(|| angle_place.missing("the angle of the slew"))?;
                axis_place.all_within(axis, AXIS)?;
                let axis = Vector3::from(axis).try_normalize(SHORTEST_AXIS).ok_or_else(|| {
                    let [x, y, z] = axis.map(Number);
                    axis_place.refuse(format!("[{x}, {y}, {z}]"), "a vector that is not zero")
                })?;
                let angle_rad = angle_place.within(angle_deg, SLEW_ANGLE_DEG)?.to_radians();
                let turn = Quaternion::from_axis_angle(&axis, angle_rad);
                Ok(Maneuver::Slew(Slew {
                    axis,
                    angle_rad,
                    target: initial.attitude.product(&turn),
                }))
            }
            file::ManeuverType::Detumble => {
                if maneuver.axis.is_some() {
                    return Err(axis_place.refuse("an axis", "none for a detumble"));
                }
                if maneuver.angle_deg.is_some() {
                    return Err(angle_place.refuse("an angle", "none for a detumble"));
                }
                Ok(Maneuver::Detumble)
            }
        }
    }
}
