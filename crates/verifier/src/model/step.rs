//! How a frame follows from the one that carries it.

use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};
use righting_scenario::file::{self, JointType};

use super::row::{Convention, Row};

/// From one frame to another that it carries.
#[derive(Clone, Debug)]
pub(super) struct Step {
    /// The frame.
    pub frame: usize,
    /// The frame that carries it.
    pub parent: usize,
    /// The joint between them; none where there is none.
    pub joint: Option<usize>,
    way: Way,
}

#[derive(Clone, Debug)]
enum Way {
    /// By a row of Denavit–Hartenberg parameters.
    Row(Row, Convention),
    /// By a fixed placement and then along or about an axis through its origin.
    Placed {
        position: Vector3<f64>,
        rotation: Matrix3<f64>,
        axis: Unit<Vector3<f64>>,
        /// Whether the joint slides along the axis instead of turning about it.
        slides: bool,
    },
}

impl Step {
    /// By row `index` of an arm, counted from zero.
    pub fn of_row(row: Row, convention: Convention, index: usize) -> Self {
        let way = Way::Row(row, convention);
        Self { frame: index + 1, parent: index, joint: Some(index), way }
    }

    /// By the joint of a body.
    pub fn of_body(
        joint: &file::Joint,
        frame: usize,
        parent: usize,
        number: Option<usize>,
    ) -> Self {
        let rotation = match (joint.rpy_deg, joint.rotation) {
            (Some(rpy), _) => {
                let [roll, pitch, yaw] = rpy.map(f64::to_radians);
                Rotation3::from_euler_angles(roll, pitch, yaw)
            }
            (None, Some([w, x, y, z])) => {
                UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix()
            }
            (None, None) => Rotation3::identity(),
        };
        debug_assert_eq!(number.is_none(), joint.kind == JointType::Fixed);
        let way = Way::Placed {
            position: Vector3::from(joint.position_m.unwrap_or_default()),
            rotation: rotation.into_inner(),
            axis: Unit::new_normalize(Vector3::from(joint.axis.unwrap_or([0.0, 0.0, 1.0]))),
            slides: joint.kind == JointType::Prismatic,
        };
        Self { frame, parent, joint: number, way }
    }

    /// From the axes of the frame before, at joint coordinate `q` (rad or m): the axes of this frame, and its origin
    /// from the origin of the frame before. Axes are the columns of a matrix.
    pub fn follow(&self, before: &Matrix3<f64>, q: f64) -> (Matrix3<f64>, Vector3<f64>) {
        match &self.way {
            Way::Row(row, convention) => row.follow(*convention, before, q),
            Way::Placed { position, rotation, axis, slides: true } => {
                let along = rotation * axis.into_inner() * q;
                (before * rotation, before * (position + along))
            }
            Way::Placed { position, rotation, axis, slides: false } => {
                let turned = rotation * Rotation3::from_axis_angle(axis, q).into_inner();
                (before * turned, before * position)
            }
        }
    }

    /// The axis of the joint, fixed in both frames, from the axes of either.
    pub fn axis(&self, before: &Matrix3<f64>, after: &Matrix3<f64>) -> Vector3<f64> {
        match &self.way {
            Way::Row(_, Convention::Distal) => before.column(2).into_owned(),
            Way::Row(_, Convention::Proximal) => after.column(2).into_owned(),
            Way::Placed { axis, .. } => after * axis.into_inner(),
        }
    }

    /// Whether the joint slides.
    pub fn slides(&self) -> bool {
        matches!(self.way, Way::Placed { slides: true, .. })
    }

    /// Whether the way from the origin of the frame before to that of this one turns with the joint: then
    /// the joint's axis passes through the first of the two, otherwise through the second.
    pub fn turns_with_joint(&self) -> bool {
        matches!(self.way, Way::Row(_, Convention::Distal))
    }
}
