//! Bodies in a tree as files say them.

use righting_multibody::JointKind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Drive, Shape};

/// A rigid body and the joint that it moves on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: a body")]
pub struct Body {
    /// Name of the body; no other body has it, nor the base.
    #[schemars(length(min = 1))]
    pub name: String,
    /// Name of the body that carries it, or of the base.
    pub parent: String,
    /// The joint between the two.
    pub joint: Joint,
    /// Mass, kg; may be zero.
    #[schemars(range(min = 0))]
    pub mass_kg: f64,
    /// Center of mass in the body's frame, m; its origin by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub center_of_mass_m: Option<[f64; 3]>,
    /// Inertia about the center of mass in the axes of the body's frame, kg m²; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[[f64; 3]; 3]>,
    /// The body's shape in its frame; without any it collides with nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shapes: Option<Vec<Shape>>,
    /// Whether the body may be inside the keep-out sphere and the shapes of `base.keep_out`: for one that
    /// starts in any of them. It is then not kept away from the base at all.
    #[serde(default, skip_serializing_if = "super::is_false")]
    pub body_exempt: bool,
}

/// What a body moves on. Where its coordinate is zero, the body's frame is the joint's; from there the joint
/// turns it about the axis, or slides it along.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `type`")]
pub struct Joint {
    /// Name of the joint; the body's with `_joint` behind it by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// How the body moves.
    #[serde(rename = "type")]
    pub kind: JointType,
    /// Origin of the joint's frame in the frame of the body that carries it, m; its origin by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position_m: Option<[f64; 3]>,
    /// Orientation of the joint's frame in that frame: roll, pitch and yaw about its fixed axes, deg,
    /// Rz(yaw) Ry(pitch) Rx(roll); none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rpy_deg: Option<[f64; 3]>,
    /// The same as unit quaternion w, x, y, z, joint's frame → frame of the body that carries it; instead
    /// of `rpy_deg`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f64; 4]>,
    /// Axis of the joint in its frame, of any length but zero; z by default. Not for a fixed joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// Smallest joint angle, deg; null or absent for none. Where it equals the largest, the joint is
    /// locked. For a revolute joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle_min_deg: Option<f64>,
    /// Largest joint angle, deg; null or absent for none. For a revolute joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle_max_deg: Option<f64>,
    /// Largest joint rate in magnitude, deg/s. This and the next three are for joints that turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rate_max_deg_s: Option<f64>,
    /// Largest joint acceleration in magnitude, deg/s².
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub acceleration_max_deg_s2: Option<f64>,
    /// Largest jerk in magnitude, deg/s³; none by default. Where a joint has one, the accelerations of all
    /// joints are continuous, linear between nodes, and zero at both ends of the maneuver.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub jerk_max_deg_s3: Option<f64>,
    /// Largest torque of the joint's drive at the joint in magnitude, friction and rotor included, N m; none
    /// by default. Of a locked joint the torque that holds it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub torque_max_n_m: Option<f64>,
    /// Smallest travel, m, along the axis. This and the next five are for prismatic joints, which need both
    /// ends; where they are equal, the joint is locked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub travel_min_m: Option<f64>,
    /// Largest travel, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub travel_max_m: Option<f64>,
    /// Largest speed of the joint in magnitude, m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub speed_max_m_s: Option<f64>,
    /// Largest acceleration of the joint in magnitude, m/s².
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub acceleration_max_m_s2: Option<f64>,
    /// Largest jerk in magnitude, m/s³; none by default. It does what `jerk_max_deg_s3` does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub jerk_max_m_s3: Option<f64>,
    /// Largest force of the joint's drive in magnitude, N; none by default. Of a locked joint the force that
    /// holds it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub force_max_n: Option<f64>,
    /// Friction, rotor, gear and motor of a joint that turns; by default a drive that adds nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drive: Option<Drive>,
}

/// How a joint lets a body move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JointType {
    /// It turns about the axis, within limits where they are given.
    Revolute,
    /// It turns about the axis without limits of its angle.
    Continuous,
    /// It slides along the axis, within limits.
    Prismatic,
    /// It does not move: the body is a part of the one that carries it.
    Fixed,
}

impl JointType {
    /// What the joint's coordinate is; none of a fixed one.
    pub fn joint_kind(self) -> Option<JointKind> {
        match self {
            Self::Revolute | Self::Continuous => Some(JointKind::Revolute),
            Self::Prismatic => Some(JointKind::Prismatic),
            Self::Fixed => None,
        }
    }
}

impl Joint {
    /// A joint of this type at the origin of what carries it, without a name and limits.
    pub fn of_kind(kind: JointType) -> Self {
        Self {
            name: None,
            kind,
            position_m: None,
            rpy_deg: None,
            rotation: None,
            axis: None,
            angle_min_deg: None,
            angle_max_deg: None,
            rate_max_deg_s: None,
            acceleration_max_deg_s2: None,
            jerk_max_deg_s3: None,
            torque_max_n_m: None,
            travel_min_m: None,
            travel_max_m: None,
            speed_max_m_s: None,
            acceleration_max_m_s2: None,
            jerk_max_m_s3: None,
            force_max_n: None,
            drive: None,
        }
    }

    /// The joint's name, on the body called `body`.
    pub fn name_on(&self, body: &str) -> String {
        self.name.clone().unwrap_or_else(|| format!("{body}_joint"))
    }
}
