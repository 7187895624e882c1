//! The shape of what instruments look at and keep away from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An instrument and a direction that it keeps away from, or looks at.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: an instrument and a cone")]
#[schemars(transform = require_direction_and_cone)]
pub struct Pointing {
    /// Name, such as "star tracker and Sun"; each of its own.
    #[schemars(length(min = 1))]
    pub name: String,
    /// Where the instrument looks, in body axes; of any length but zero.
    pub boresight_body: [f64; 3],
    /// The direction, in inertial axes; of any length but zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction_inertial: Option<[f64; 3]>,
    /// A direction that moves in time; instead of `direction_inertial`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction_table: Option<DirectionTable>,
    /// The boresight is at least so far from the direction all the time, deg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 180), extend("exclusiveMinimum" = 0))]
    pub keep_out_deg: Option<f64>,
    /// The boresight is at most so far from the direction all the time, deg; instead of `keep_out_deg`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 180), extend("exclusiveMinimum" = 0))]
    pub keep_in_deg: Option<f64>,
}

/// A direction at some times; in between the vectors, of unit length, are interpolated linearly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `t_s` and `vectors`")]
pub struct DirectionTable {
    /// Times from the start of the maneuver, s, each later than the one before; from 0 or before to the end or
    /// after.
    #[schemars(length(min = 2, max = 1000))]
    pub t_s: Vec<f64>,
    /// The direction at each of them, inertial axes; of any length but zero.
    #[schemars(length(min = 2, max = 1000))]
    pub vectors: Vec<[f64; 3]>,
}

/// Adds to the schema what the type cannot say: there is one direction, and one cone about it.
fn require_direction_and_cone(schema: &mut schemars::Schema) {
    let one_of = |fields: [&str; 2]| {
        let required = fields.map(|field| serde_json::json!({ "required": [field] }));
        serde_json::json!({ "oneOf": required })
    };
    schema.insert(
        "allOf".to_owned(),
        serde_json::json!([
            one_of(["direction_inertial", "direction_table"]),
            one_of(["keep_out_deg", "keep_in_deg"])
        ]),
    );
}
