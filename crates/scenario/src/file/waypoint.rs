//! Targets on the way, as they stand in a scenario file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An attitude to reach on the way to a slew's target: of `target_attitude`, or of `axis` and `angle_deg`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: a waypoint")]
#[schemars(transform = require_target)]
pub struct Waypoint {
    /// Axis to turn about from the attitude at the start, of any length but zero; in body axes at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// Angle to turn by from the attitude at the start, deg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<f64>,
    /// Attitude to reach: unit quaternion w, x, y, z (Hamilton, body → inertial), of either sign.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target_attitude: Option<[f64; 4]>,
    /// How long the attitude is held, s; 0 by default. Of the next multiple of a step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub dwell_s: Option<f64>,
    /// Whether base and joints are at rest there, all the while the attitude is held; true by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rest: Option<bool>,
    /// How long the way there takes, s, from where the one before is left; of the next multiple of a step. By
    /// default the ways share, in proportion to the angles that the base turns by, what time is left.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub duration_s: Option<f64>,
}

/// Adds to the schema what the type cannot say: a waypoint has a target.
fn require_target(schema: &mut schemars::Schema) {
    schema.insert(
        "oneOf".to_owned(),
        serde_json::json!([
            { "properties": { "target_attitude": false }, "required": ["axis", "angle_deg"] },
            { "properties": { "axis": false, "angle_deg": false }, "required": ["target_attitude"] }
        ]),
    );
}
