//! The shape of a reaction wheel.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::is_false;

/// A reaction wheel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a wheel")]
pub struct Wheel {
    /// Its axis in body axes, of any length but zero.
    pub axis: [f64; 3],
    /// The most momentum it stores either way, N m s.
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0))]
    pub momentum_max_n_m_s: f64,
    /// The most torque it gives either way, N m.
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0))]
    pub torque_max_n_m: f64,
    /// Power it takes while it spins steadily, W; 5 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1e6))]
    pub steady_power_w: Option<f64>,
    /// Momentum it stores at the start of a maneuver, about its axis and relative to the base, N m s; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial_momentum_n_m_s: Option<f64>,
    /// Inertia of the rotor about its axis, kg m²: the momentum over it is the speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0))]
    pub inertia_kg_m2: Option<f64>,
    /// Viscous friction of its bearing, N m s (a rad), with `inertia_kg_m2`; 0 by default. The motor gives the torque on
    /// the rotor and what friction takes, and `torque_max_n_m` is then the most of both together.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1e6))]
    pub viscous_friction_n_m_s: Option<f64>,
    /// Whether it gives no torque: it keeps the momentum that it has at the start.
    #[serde(default, skip_serializing_if = "is_false")]
    pub failed: bool,
}
