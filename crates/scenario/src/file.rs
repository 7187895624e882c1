//! The shape of scenario and system files, before anything in them is believed.
//!
//! These types mirror the JSON one to one: user's units, every default still open. They say what a
//! file may contain; [`Scenario`](crate::Scenario) is what it means. A *resolved* scenario is one
//! of these with its system inline and every default filled in: it stands in `solution.json`.

mod bodies;
mod drive;
mod joint_row;
mod pointing;
mod shapes;
mod system_options;
mod waypoint;

use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

pub use bodies::{Body, Joint, JointType};
pub use drive::Drive;
pub use joint_row::{JointPlace, JointRow};
pub use pointing::{DirectionTable, Pointing};
pub use shapes::{Capsule, Cuboid, KeepOut, Shape, Sphere};
pub use system_options::SystemOptions;
pub use waypoint::Waypoint;

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
    /// Joint angles, one a joint, deg.
    pub joint_angles_deg: Vec<f64>,
    /// Joint rates, one a joint, deg/s; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_rates_deg_s: Option<Vec<f64>>,
    /// Angular rate of the base in body axes, deg/s; zero by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angular_rate_deg_s: Option<[f64; 3]>,
    /// Attitude quaternion w, x, y, z (Hamilton, body → inertial); identity by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub attitude: Option<[f64; 4]>,
}

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

/// Duration and grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `duration_s` and `steps`")]
pub struct Horizon {
    /// Duration, s: a number, or the shortest and the longest of a duration that is free.
    pub duration_s: Duration,
    /// Number of equal intervals N.
    #[schemars(with = "u64", range(min = 1, max = 100_000))]
    #[serde(serialize_with = "whole_number")]
    pub steps: f64,
}

/// How long a maneuver takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Duration {
    /// So long, s.
    Given(#[schemars(extend("exclusiveMinimum" = 0))] f64),
    /// As long as is best.
    Free(DurationRange),
}

/// Between what a free duration may be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `min` and `max`")]
pub struct DurationRange {
    /// The shortest, s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub min: f64,
    /// The longest, s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub max: f64,
}

impl From<f64> for Duration {
    fn from(duration_s: f64) -> Self {
        Self::Given(duration_s)
    }
}

impl Duration {
    /// The duration, or the longest of a free one, s.
    pub fn longest_s(self) -> f64 {
        match self {
            Self::Given(duration_s) => duration_s,
            Self::Free(DurationRange { max, .. }) => max,
        }
    }

    /// Changes the duration, or the longest of a free one.
    pub fn set_longest_s(&mut self, longest_s: f64) {
        match self {
            Self::Given(duration_s) => *duration_s = longest_s,
            Self::Free(DurationRange { max, .. }) => *max = longest_s,
        }
    }

    /// So many times as long.
    pub fn times(self, factor: f64) -> Self {
        match self {
            Self::Given(duration_s) => Self::Given(factor * duration_s),
            Self::Free(DurationRange { min, max }) => {
                Self::Free(DurationRange { min: factor * min, max: factor * max })
            }
        }
    }
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
    /// The angle in which each joint ends, deg; null where it is free. The given ones are met exactly,
    /// whatever `hard` and the weights say. All are free by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_angles_deg: Option<Vec<Option<f64>>>,
}

/// Weights of the objective, in SI units and radians. `control` multiplies the integral over time of the
/// squared joint accelerations, divided by 0.05 s; `time` multiplies the duration where that is free; each
/// other one multiplies the square of its quantity at the end. A slew's defaults are control 0.01, attitude
/// 1000, angular_rate 100, joint_rate 100; a detumble's control 0.01, angular_rate 100, joint_rate
/// 1000; the rest 0.
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

/// How to solve.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object of solver settings")]
pub struct Solver {
    /// States of the optimal control problem; `reduced` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub formulation: Option<Formulation>,
    /// Initial guess; `auto` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub guess: Option<Guess>,
    /// Who makes the iterations; `ipopt` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub optimizer: Option<Optimizer>,
    /// Linear solver inside the optimizer; `auto` by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linear_solver: Option<LinearSolverChoice>,
    /// Largest number of iterations; 3000 by default.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        serialize_with = "optional_whole_number"
    )]
    #[schemars(with = "Option<u64>", range(min = 1, max = 1_000_000))]
    pub max_iterations: Option<f64>,
    /// Wall time after which a plan is stopped, s; none by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0))]
    pub time_limit_s: Option<f64>,
    /// Convergence tolerance of the optimizer; 1e-8 by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1e-14, max = 1e-2))]
    pub tolerance: Option<f64>,
}

/// States of the optimal control problem.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Formulation {
    /// All 13 + 2j states of the free-floating system.
    Full,
    /// Momentum eliminated: attitude, joint angles and joint rates, 4 + 2j states.
    #[default]
    Reduced,
}

/// Initial guess of the optimizer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Guess {
    /// A named way of guessing.
    Named(NamedGuess),
    /// The best of several low-discrepancy starts.
    Starts(LowDiscrepancyStarts),
}

/// The named ways of guessing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NamedGuess {
    /// The start held over the horizon, no control.
    Constant,
    /// Whatever is fastest and finds the best plan.
    Auto,
}

/// The best of several low-discrepancy starts: joint motions whose ends are points of a Halton sequence,
/// the same every time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `starts`")]
pub struct LowDiscrepancyStarts {
    /// Number of starts.
    #[schemars(range(min = 1, max = 1000))]
    pub starts: u64,
    /// Which stretch of the sequence; 0 by default.
    #[serde(default)]
    pub seed: u64,
}

/// Who makes the iterations of the interior-point method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Optimizer {
    /// Ipopt makes every plan. The starts that are compared before it, and the coarser grids, are solved
    /// by Righting's own implementation of Ipopt's method, and by Ipopt where that gives up.
    #[default]
    Ipopt,
    /// Righting's own implementation makes the plan too, and Ipopt where that gives up; with MUMPS Ipopt
    /// alone.
    Interior,
    /// The same as `ipopt`.
    Auto,
}

/// Linear solver inside the optimizer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LinearSolverChoice {
    /// The faster of those that work for the problem.
    #[default]
    Auto,
    /// MUMPS, for any problem.
    Mumps,
    /// The factorisation that knows the stages of an optimal control problem.
    Stage,
}

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

fn is_false(value: &bool) -> bool {
    !value
}

// Whole numbers are read as any number, so that 0.5 steps meets the same complaint as 0, and written
// without a decimal point.

fn whole_number<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    if value.fract() == 0.0 && (0.0..9e15).contains(value) {
        serializer.serialize_u64(*value as u64)
    } else {
        serializer.serialize_f64(*value)
    }
}

fn optional_whole_number<S: Serializer>(
    value: &Option<f64>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match value {
        Some(value) => whole_number(value, serializer),
        None => serializer.serialize_none(),
    }
}

// The two untagged types are read by hand: serde's derived reader tries one alternative after the
// other and forgets what was wrong in the one that was meant.

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

impl<'de> Deserialize<'de> for Duration {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct GivenOrFree;
        impl<'de> Visitor<'de> for GivenOrFree {
            type Value = Duration;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("a number, or an object with `min` and `max`")
            }

            fn visit_f64<E: serde::de::Error>(self, duration_s: f64) -> Result<Self::Value, E> {
                Ok(Duration::Given(duration_s))
            }

            fn visit_u64<E: serde::de::Error>(self, duration_s: u64) -> Result<Self::Value, E> {
                Ok(Duration::Given(duration_s as f64))
            }

            fn visit_i64<E: serde::de::Error>(self, duration_s: i64) -> Result<Self::Value, E> {
                Ok(Duration::Given(duration_s as f64))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                DurationRange::deserialize(MapAccessDeserializer::new(map)).map(Duration::Free)
            }
        }
        deserializer.deserialize_any(GivenOrFree)
    }
}

impl<'de> Deserialize<'de> for Guess {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct NamedOrStarts;
        impl<'de> Visitor<'de> for NamedOrStarts {
            type Value = Guess;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("\"constant\", \"auto\" or an object with `starts`")
            }

            fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Self::Value, E> {
                match name {
                    "constant" => Ok(Guess::Named(NamedGuess::Constant)),
                    "auto" => Ok(Guess::Named(NamedGuess::Auto)),
                    _ => Err(E::unknown_variant(name, &["constant", "auto"])),
                }
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                let starts = LowDiscrepancyStarts::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Guess::Starts(starts))
            }
        }
        deserializer.deserialize_any(NamedOrStarts)
    }
}
