//! The shape of what acts on a spacecraft from outside.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What acts on the spacecraft from outside. Where it is given, even empty, a slew may start with angular momentum,
/// and what that leaves at the end is no fault of the plan.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: what acts from outside")]
pub struct Environment {
    /// The gravity gradient of a circular orbit about the Earth.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity_gradient: Option<GravityGradient>,
    /// A couple on the base that turns with it, body axes, N m; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub torque_body_n_m: Option<[f64; 3]>,
    /// A couple on the base that stays where it is, inertial axes, N m; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub torque_inertial_n_m: Option<[f64; 3]>,
}

/// A circular orbit, and where the spacecraft is on it at the start. The orbit frame has z to the center of the
/// Earth, y against the orbit's normal and x ahead.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `altitude_km`")]
pub struct GravityGradient {
    /// Altitude above the Earth's equatorial radius of 6378.137 km, km.
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0))]
    pub altitude_km: f64,
    /// Attitude of the orbit frame at the start, as a quaternion w, x, y, z (Hamilton, orbit frame → inertial);
    /// identity by default: the inertial axes are those of the orbit frame at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orbit_attitude: Option<[f64; 4]>,
    /// Orbital elements, where the inertial axes are Earth-centered ones; instead of `orbit_attitude`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elements: Option<OrbitalElements>,
}

/// Where a circular orbit lies in Earth-centered inertial axes, and where the spacecraft is on it at the start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object of orbital elements")]
pub struct OrbitalElements {
    /// Inclination, deg.
    #[schemars(range(min = 0, max = 180))]
    pub inclination_deg: f64,
    /// Right ascension of the ascending node, deg.
    #[schemars(range(min = -360, max = 360))]
    pub right_ascension_deg: f64,
    /// Angle from the ascending node along the orbit, deg.
    #[schemars(range(min = -360, max = 360))]
    pub argument_of_latitude_deg: f64,
}
