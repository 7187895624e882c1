//! The shape of scenario and system files, before anything in them is believed.
//!
//! These types mirror the JSON one to one: user's units, every default still open. They say what a
//! file may contain; [`Scenario`](crate::Scenario) is what it means. A *resolved* scenario is one
//! of these with its system inline and every default filled in: it stands in `solution.json`.

mod bodies;
mod drive;
mod environment;
mod horizon;
mod initial_joints;
mod joint_row;
mod joint_words;
mod link;
mod maneuver;
mod pointing;
mod shapes;
mod solver;
mod system;
mod system_options;
mod waypoint;
mod wheel;
mod whole_number;

use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

pub use bodies::{Body, Joint, JointType};
pub use drive::Drive;
pub use environment::{Environment, GravityGradient, OrbitalElements};
pub use horizon::{Duration, DurationRange, Horizon};
pub use joint_row::{JointPlace, JointRow};
pub use joint_words::{JointWords, in_joint_order, of_kind};
pub use link::{DhConvention, InertialFrame, Link};
pub use maneuver::{Maneuver, ManeuverType};
pub use pointing::{DirectionTable, Pointing};
pub use shapes::{Capsule, Cuboid, KeepOut, Shape, Sphere};
pub use solver::{
    Formulation, Guess, LinearSolverChoice, LowDiscrepancyStarts, NamedGuess, Optimizer, Solver,
};
pub use system::{Base, Mount, Payload, System};
pub use system_options::SystemOptions;
pub use waypoint::Waypoint;
pub use wheel::Wheel;

pub use righting_multibody::JointKind;

/// A maneuver to plan: a system, where it starts, what it shall do and how well.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: a scenario")]
#[schemars(title = "Righting scenario")]
pub struct Scenario {
    /// Name of the scenario.
    #[schemars(length(min = 1))]
    pub name: String,
    /// Free text for the reader.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Path of a system file or of a robot's URDF file, relative to this file, or the system itself.
    pub system: SystemReference,
    /// What a URDF file does not say; needed with one, and goes with nothing else.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub system_options: Option<SystemOptions>,
    /// State at the start. The system's center of mass is at rest.
    pub initial: Initial,
    /// What to do.
    pub maneuver: Maneuver,
    /// Duration and grid.
    pub horizon: Horizon,
    /// Weights of the objective; defaults depend on the maneuver's type.
    #[serde(default)]
    pub weights: Weights,
    /// How the end is met.
    #[serde(rename = "final", default, skip_serializing_if = "Option::is_none")]
    pub end: Option<End>,
    /// Reaction wheels that turn the base beside the arm.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 16))]
    pub wheels: Vec<Wheel>,
    /// What acts from outside.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub environment: Option<Environment>,
    /// Masses that the plan shall not depend on more than it must.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub robustness: Option<Robustness>,
    /// Where instruments may look, all the time.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pointing: Vec<Pointing>,
    /// Clearances.
    #[serde(default)]
    pub collision: Collision,
    /// How to solve.
    #[serde(default)]
    pub solver: Solver,
}

/// A system by file name or inline.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum SystemReference {
    /// Path of a system file or of a URDF file, relative to the scenario file.
    File(String),
    /// The system itself.
    Inline(Box<System>),
}

/// State at the start; the base's body frame starts at the origin.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `joint_angles_deg`")]
pub struct Initial {
    /// Joint angles, one a joint that turns, deg.
    pub joint_angles_deg: Vec<f64>,
    /// Joint rates, one a joint that turns, deg/s; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_rates_deg_s: Option<Vec<f64>>,
    /// Travels of the joints that slide, one each, m; needed where there are any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joint_travels_m: Vec<f64>,
    /// Speeds of the joints that slide, one each, m/s; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_speeds_m_s: Option<Vec<f64>>,
    /// Angular rate of the base in body axes, deg/s; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angular_rate_deg_s: Option<[f64; 3]>,
    /// Attitude quaternion w, x, y, z (Hamilton, body → inertial); identity by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub attitude: Option<[f64; 4]>,
}

/// Masses that are not known exactly: the plan of a slew trades effort for an end that they change less.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `mass_percent`")]
pub struct Robustness {
    /// Every mass, and the inertia of the base, is off by up to so much either way, each by itself, %.
    #[schemars(range(min = 0.0, max = 50.0))]
    pub mass_percent: f64,
    /// What the variance of the attitude at the end counts, relative to the effort: one weighs the variance of the plan
    /// without this like that plan's effort. One by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.0, max = 1e6))]
    pub weight: Option<f64>,
}

/// How the end of a maneuver is met.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object: how the end is met")]
pub struct End {
    /// Whether the end is met as well as numbers allow, whatever that takes: a slew ends in its target
    /// attitude and at rest, a detumble with its joints at rest. Otherwise effort and end are traded as
    /// the weights say. By default true where no weight of the end is given
    /// and the guess is not the constant one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hard: Option<bool>,
    /// The angle in which each joint that turns ends, deg; null where it is free. The given ones are met
    /// exactly, whatever `hard` and the weights say. All are free by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_angles_deg: Option<Vec<Option<f64>>>,
    /// The same of the joints that slide, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_travels_m: Option<Vec<Option<f64>>>,
    /// The momentum that each wheel stores in the end, N m s; null where it is free. The given ones are met exactly.
    /// All are free by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wheel_momenta_n_m_s: Option<Vec<Option<f64>>>,
}

/// Weights of the objective, in SI units and radians. `control` multiplies the integral over time of the
/// squared joint accelerations, divided by 0.05 s; `time` multiplies the duration where that is free; each
/// other one multiplies the square of its quantity at the end. A slew's defaults are control 0.01, attitude
/// 1000, angular_rate 100, joint_rate 100; a detumble's control 0.01, angular_rate 100, joint_rate
/// 1000; the rest 0. A joint that slides counts by its travel divided by the system's size: the length of the
/// arm stretched out, or the farthest that a joint or a center of mass can be from the origin of the body frame.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object of weights")]
pub struct Weights {
    /// Joint accelerations: ∫‖q̈‖² dt / 0.05 s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub control: Option<f64>,
    /// Duration, a second, where it is free; 1 by default there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub time: Option<f64>,
    /// Position of the base at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub position: Option<f64>,
    /// Vector part of the attitude error quaternion at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub attitude: Option<f64>,
    /// Velocity of the base at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub velocity: Option<f64>,
    /// Angular rate of the base at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub angular_rate: Option<f64>,
    /// Departure of the joint angles from their start, at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub joint_angle: Option<f64>,
    /// Joint rates at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub joint_rate: Option<f64>,
    /// Torques of the wheels: ∫‖τ‖² dt / 0.05 s; 0.01 by default where there are wheels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub wheel_torque: Option<f64>,
    /// Momenta of the wheels at the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub wheel_momentum: Option<f64>,
}

/// Clearances.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `clearance_m`")]
pub struct Collision {
    /// Smallest distance of the links and the payload from what the base keeps out and from each other, m;
    /// 0.01 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub clearance_m: Option<f64>,
}

fn is_false(value: &bool) -> bool {
    !value
}

// Untagged types are read by hand, here and in the files of the others: serde's derived reader tries one
// alternative after the other and forgets what was wrong in the one that was meant.

impl<'de> Deserialize<'de> for SystemReference {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct FileOrInline;
        impl<'de> Visitor<'de> for FileOrInline {
            type Value = SystemReference;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("the path of a system file, or an object: a system")
            }

            fn visit_str<E: serde::de::Error>(self, path: &str) -> Result<Self::Value, E> {
                Ok(SystemReference::File(path.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                let system = System::deserialize(MapAccessDeserializer::new(map))?;
                Ok(SystemReference::Inline(Box::new(system)))
            }
        }
        deserializer.deserialize_any(FileOrInline)
    }
}
