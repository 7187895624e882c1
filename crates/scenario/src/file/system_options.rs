//! How a robot's file becomes a system, as files say it.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Base;

/// What a URDF file does not say about the system that is made from it. One of `base` and `on` is needed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `base` or `on`")]
pub struct SystemOptions {
    /// The link of the robot that floats: the base, whose frame is the body frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<String>,
    /// A base that is not in the file, as a system has one; the robot's root link is fixed to it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<Base>,
    /// Where the origin of the root link sits on that base, m; its frame's origin by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mount_position_m: Option<[f64; 3]>,
    /// Roll, pitch and yaw of the root link on that base, deg: Rz(yaw) Ry(pitch) Rx(roll); 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mount_rpy_deg: Option<[f64; 3]>,
    /// The link at the end of the only arm that moves: every joint that is not between the base and this
    /// link is held, at zero or the limit next to it. By default all joints move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip: Option<String>,
    /// Joints that are held, and where: deg, or m where they slide.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub locked: BTreeMap<String, f64>,
    /// Links that are left out, with all that hangs on them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub dropped: Vec<String>,
    /// Largest acceleration of joints that turn, deg/s², which URDF does not have.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub acceleration_max_deg_s2: Option<f64>,
    /// Largest rate of joints that turn and for which the file gives none, deg/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rate_max_deg_s: Option<f64>,
    /// Largest acceleration of joints that slide, m/s², which URDF does not have.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub acceleration_max_m_s2: Option<f64>,
    /// Largest speed of joints that slide and for which the file gives none, m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub speed_max_m_s: Option<f64>,
    /// Whether links with a mass and no inertia are point masses; false by default: they are refused.
    #[serde(default, skip_serializing_if = "super::is_false")]
    pub point_masses: bool,
    /// Whether an inertia that no rigid body has is replaced by the nearest one, in the Frobenius norm, that
    /// a body can have; false by default: it is refused.
    #[serde(default, skip_serializing_if = "super::is_false")]
    pub project_inertias: bool,
}
