//! A spacecraft with its arms, as it stands in a system file.

use schemars::JsonSchema;
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::{Body, DhConvention, KeepOut, Link, Shape, is_false};

/// A free-floating base with a chain of revolute joints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: a system")]
#[schemars(title = "Righting system", transform = require_links_or_bodies)]
pub struct System {
    /// Name of the system.
    #[schemars(length(min = 1))]
    pub name: String,
    /// Free text for the reader.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// The spacecraft without its arms.
    pub base: Base,
    /// Where the arm's frame 0 sits on the base; goes with `links`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mount: Option<Mount>,
    /// What a row of Denavit–Hartenberg parameters means; `standard` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dh_convention: Option<DhConvention>,
    /// A serial arm: one row a joint, from the base to the tip.
    #[serde(default, deserialize_with = "some_links", skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(min = 1, max = 32))]
    pub links: Vec<Link>,
    /// A tree of bodies on joints, in any order, instead of `mount`, `dh_convention`, `links` and `payload`.
    /// Joint coordinates are in the order of the bodies whose joint moves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub bodies: Option<Vec<Body>>,
    /// Whether an inertia that no rigid body has (of base, links or payload) is replaced by the
    /// nearest one, in the Frobenius norm, that a body can have; false by default: it is refused.
    #[serde(default, skip_serializing_if = "is_false")]
    pub project_inertias: bool,
    /// A rigid body held at the last link's frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub payload: Option<Payload>,
    /// Pairs that may touch and cross, each two of `links[i]`, `links[i].shapes[k]`, `bodies[i]`,
    /// `bodies[i].shapes[k]`, `payload`, `payload.shapes[k]`, `base.keep_out[k]` and
    /// `base.keep_out_radius_m` (the sphere), counted from zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ignored_pairs: Option<Vec<[String; 2]>>,
}

/// A uniform cube, or a body of any inertia with a keep-out sphere.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `mass_kg`")]
pub struct Base {
    /// Name by which bodies call it; `base` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// Mass, kg.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass_kg: f64,
    /// Side of a uniform cube, m: gives inertia and keep-out sphere (the circumscribed one).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cube_side_m: Option<f64>,
    /// Inertia about the center of mass in body axes, kg m²; instead of `cube_side_m`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[[f64; 3]; 3]>,
    /// Center of mass from the origin of the body frame, body axes, m; the origin by default. Not with
    /// `cube_side_m`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub center_of_mass_m: Option<[f64; 3]>,
    /// Radius of the sphere about the origin of the body frame that links keep out of, m. By default there is none
    /// beside `keep_out`, and without that it is the cube's circumscribed one; `inertia_kg_m2` needs one
    /// of the two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub keep_out_radius_m: Option<f64>,
    /// Largest angular rate of the base along the way, as a vector's length, deg/s; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub angular_rate_max_deg_s: Option<f64>,
    /// What else links keep out of: the bus, solar arrays, antennas.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keep_out: Option<Vec<KeepOut>>,
}

/// What the base is called where nothing is said.
const BASE: &str = "base";

impl Base {
    /// Its name, or what it is called without one.
    pub fn name(&self) -> &str {
        self.name.as_deref().unwrap_or(BASE)
    }
}

/// Where the arm's frame 0 sits on the base.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `position_m`")]
pub struct Mount {
    /// Origin of frame 0 in body axes, from the origin of the body frame, m.
    pub position_m: [f64; 3],
    /// Orientation of frame 0: unit quaternion w, x, y, z, frame 0 → body; identity by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<[f64; 4]>,
    /// Largest force between base and arm at the mount, N; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub force_max_n: Option<f64>,
    /// Largest moment between base and arm about the mount, N m; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub moment_max_n_m: Option<f64>,
}

/// A rigid body held with its center of mass at the last link's origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `mass_kg`")]
pub struct Payload {
    /// Mass, kg.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass_kg: f64,
    /// Inertia about its center of mass in the last link's frame, kg m²; a point mass by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[[f64; 3]; 3]>,
    /// Radius of a sphere about its center of mass, m; without it and `shapes` it collides with nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub radius_m: Option<f64>,
    /// Its shape instead of that sphere, in the last link's frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shapes: Option<Vec<Shape>>,
}

/// Adds to the schema what the type cannot say: an arm is rows on a mount, or bodies.
fn require_links_or_bodies(schema: &mut schemars::Schema) {
    schema.insert(
        "oneOf".to_owned(),
        serde_json::json!([
            { "properties": { "bodies": false }, "required": ["mount", "links"] },
            {
                "properties": {
                    "mount": false, "dh_convention": false, "links": false, "payload": false
                },
                "required": ["bodies"]
            }
        ]),
    );
}

/// An empty list is not the same as none.
fn some_links<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Link>, D::Error> {
    struct SomeLinks;
    impl<'de> Visitor<'de> for SomeLinks {
        type Value = Vec<Link>;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.write_str("an array of 1 to 32 links")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut rows: A) -> Result<Self::Value, A::Error> {
            let mut links = Vec::new();
            while let Some(link) = rows.next_element()? {
                links.push(link);
            }
            match links.is_empty() {
                true => Err(serde::de::Error::invalid_length(0, &self)),
                false => Ok(links),
            }
        }
    }
    deserializer.deserialize_seq(SomeLinks)
}
