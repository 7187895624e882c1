//! What a joint's drive adds to the torque that moves the arm, and what it draws.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A joint's drive: friction, rotor, gear and motor.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: a drive")]
pub struct Drive {
    /// Viscous friction at the joint, N m s (a rad); 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub viscous_friction_n_m_s: Option<f64>,
    /// Inertia of the motor's rotor and all that turns with it before the gear, about its axis, kg m²; 0 by
    /// default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub rotor_inertia_kg_m2: Option<f64>,
    /// Turns of the motor a turn of the joint; 1 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gear_ratio: Option<f64>,
    /// Share of the power that passes the gear, in either direction; 1 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0), range(max = 1))]
    pub gear_efficiency: Option<f64>,
    /// Torque of the motor an ampere, N m/A; with `resistance_ohm`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub torque_constant_n_m_a: Option<f64>,
    /// Resistance of the motor's windings, Ω; with `torque_constant_n_m_a`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub resistance_ohm: Option<f64>,
    /// Power that the drive's electronics take all the time, W; 0 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub idle_power_w: Option<f64>,
    /// Power that holds the joint while it stands still, instead of the motor's, W: 0 with a brake that
    /// closes without power. By default the motor holds it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub holding_power_w: Option<f64>,
}
