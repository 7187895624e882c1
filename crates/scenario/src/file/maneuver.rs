//! What a scenario file asks for.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Waypoint;

/// What to do: turn the base and stop, or take out as much of its angular rate as possible.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `type`")]
#[schemars(transform = require_slew_target)]
pub struct Maneuver {
    /// Slew or detumble.
    #[serde(rename = "type")]
    pub kind: ManeuverType,
    /// Axis to turn about, of any length but zero; in body axes at the start. For a slew only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// Angle to turn by, deg. For a slew only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<f64>,
    /// Attitude to reach: unit quaternion w, x, y, z (Hamilton, body → inertial), of either sign. For a slew
    /// only, instead of `axis` and `angle_deg`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target_attitude: Option<[f64; 4]>,
    /// Attitudes to reach on the way, in order. For a slew only; one without a target of its own ends in the last.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waypoints: Vec<Waypoint>,
}

/// The kinds of maneuver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ManeuverType {
    /// Turn the base by an angle about an axis, rest to rest.
    Slew,
    /// Reduce the base's angular rate and stop the arm.
    Detumble,
}

/// Adds to the schema what the type cannot say: a slew has a target, a detumble has none.
fn require_slew_target(schema: &mut schemars::Schema) {
    schema.insert(
        "oneOf".to_owned(),
        serde_json::json!([
            {
                "properties": { "type": { "const": "slew" }, "target_attitude": false },
                "required": ["axis", "angle_deg"]
            },
            {
                "properties": { "type": { "const": "slew" }, "axis": false, "angle_deg": false },
                "required": ["target_attitude"]
            },
            {
                "properties": {
                    "type": { "const": "slew" },
                    "axis": false, "angle_deg": false, "target_attitude": false,
                    "waypoints": { "minItems": 1 }
                },
                "required": ["waypoints"]
            },
            {
                "properties": {
                    "type": { "const": "detumble" },
                    "axis": false, "angle_deg": false, "target_attitude": false, "waypoints": false
                }
            }
        ]),
    );
}
