//! Shapes of bodies as files say them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something of the base that the arm keeps out of: one of a sphere, a capsule and a box, in body axes from
/// the origin of the body frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `sphere`, `capsule` or `box`")]
#[schemars(extend("minProperties" = 1, "maxProperties" = 1))]
pub struct KeepOut {
    /// A sphere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// A capsule.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capsule: Option<Capsule>,
    /// A box with its edges along the body axes.
    #[serde(default, rename = "box", skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<Cuboid>,
}

/// A piece of a link or of the payload: a sphere or a capsule.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `sphere` or `capsule`")]
#[schemars(extend("minProperties" = 1, "maxProperties" = 1))]
pub struct Shape {
    /// A sphere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sphere: Option<Sphere>,
    /// A capsule.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capsule: Option<Capsule>,
}

/// A sphere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `center_m` and `radius_m`")]
pub struct Sphere {
    /// Center, m.
    pub center_m: [f64; 3],
    /// Radius, m.
    #[schemars(range(min = 0))]
    pub radius_m: f64,
}

/// All points that are no farther than a radius from a straight segment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `from_m`, `to_m` and `radius_m`")]
pub struct Capsule {
    /// One end of the segment, m.
    pub from_m: [f64; 3],
    /// The other end, m; where it is the same, the capsule is a sphere.
    pub to_m: [f64; 3],
    /// Radius, m.
    #[schemars(range(min = 0))]
    pub radius_m: f64,
}

/// A box.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `center_m` and `size_m`")]
pub struct Cuboid {
    /// Center, m.
    pub center_m: [f64; 3],
    /// Lengths of the edges along the three axes, m.
    #[schemars(inner(range(min = 0)))]
    pub size_m: [f64; 3],
}
