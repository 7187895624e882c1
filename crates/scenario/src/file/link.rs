//! A row of Denavit–Hartenberg parameters with what goes with it, as it stands in a system file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Drive, Shape};

/// What a row of Denavit–Hartenberg parameters means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DhConvention {
    /// Distal: joint i turns about z of frame i−1, frame i sits at the link's outboard end.
    #[default]
    Standard,
    /// Craig's: row i places joint i from frame i−1 by a and α, then turns by θ and shifts by d
    /// about the new z. The mass of row i sits on the segment from origin i−1 to origin i and moves
    /// with frame i−1, unless the row's `inertial_frame` says otherwise.
    Modified,
}

/// The frame that the mass of row i moves with, and that its center of mass and inertia are in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InertialFrame {
    /// Frame i, which joint i moves: what Craig's tables and ROS files mean by the mass of link i.
    /// With modified parameters a link that has mass then needs its `center_of_mass_m` and
    /// `inertia_kg_m2`.
    Own,
    /// Frame i−1, which joint i does not move; with modified parameters only.
    Previous,
}

/// One joint, its Denavit–Hartenberg parameters, its limits, and the mass that goes with it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: a link")]
pub struct Link {
    /// Name of the link and its joint; none by default, and it goes by its number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// Mass, kg; may be zero.
    #[schemars(range(min = 0))]
    pub mass_kg: f64,
    /// Link length a, m.
    pub a_m: f64,
    /// Link twist α, deg.
    pub alpha_deg: f64,
    /// Link offset d, m.
    pub d_m: f64,
    /// Angle θ₀ added to the joint angle, deg.
    pub theta_deg: f64,
    /// Smallest joint angle, deg; null or absent for none. Where it equals the largest, the joint is
    /// locked.
    #[serde(default)]
    pub angle_min_deg: Option<f64>,
    /// Largest joint angle, deg; null or absent for none.
    #[serde(default)]
    pub angle_max_deg: Option<f64>,
    /// Largest joint rate in magnitude, deg/s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rate_max_deg_s: f64,
    /// Largest joint acceleration in magnitude, deg/s².
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub acceleration_max_deg_s2: f64,
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
    /// Friction, rotor, gear and motor of the joint; by default a drive that adds nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drive: Option<Drive>,
    /// Whether the link may be inside the keep-out sphere and the shapes of `base.keep_out`: for one that
    /// starts in any of them, as part of the mount does. It is then not kept away from the base at all.
    #[serde(default)]
    pub body_exempt: bool,
    /// The frame that the mass moves with, and that the two fields below are in; by default `own` with
    /// standard parameters and `previous` with modified ones.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertial_frame: Option<InertialFrame>,
    /// Center of mass in the frame that the mass moves with, m; the segment's middle by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub center_of_mass_m: Option<[f64; 3]>,
    /// Inertia about the center of mass in the frame that the mass moves with, kg m²; a uniform
    /// slender rod along the segment by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[[f64; 3]; 3]>,
    /// Radius of the capsule along the straight segment between the link's two origins, m; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub radius_m: Option<f64>,
    /// The link's shape instead of that capsule, in the frame that the mass moves with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shapes: Option<Vec<Shape>>,
}
