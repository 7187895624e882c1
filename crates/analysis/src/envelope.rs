//! What momentum and torque an arm can give, beside an array of reaction wheels.
//!
//! The paper's equations: H_arm = H̃(q, q̇) = B(q) q̇ and T_arm = H̃' = B q̈ + Ḃ q̇, in body axes. Its
//! envelopes are convex hulls of uniform samples, which fall short of the true ones. At given q the
//! most of H along n is Σ |n·b_i| q̇max_i; T is linear in q̈ and quadratic in q̇; so the true extent
//! along n, the support function s(n), takes a search over q only. The envelope lies between the
//! hull of the points found and the intersection of the half spaces n·x ≤ s(n).

mod arm;
mod directions;
mod extent;
mod quadratic;
mod samples;
mod sizing;

pub use directions::fibonacci;
pub use sizing::Sizing;

use nalgebra::Vector3;
use righting_scenario::file::{JointKind, of_kind};
use righting_scenario::system_description::SystemDescription;
use righting_scenario::wheels::WheelArray;
use serde::Serialize;

use crate::hull::{Mesh, convex_hull};
use crate::zonotope::Zonotope;
use arm::{Arm, Quantity};

/// What arm and wheels reach together: in every direction the sum of what each reaches.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Together {
    /// The largest extent over all directions.
    pub max: f64,
    /// The smallest.
    pub min: f64,
    /// The largest component along x, y and z in magnitude.
    pub per_axis_max: [f64; 3],
}

/// Momentum and torque envelopes of an arm and of wheels beside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Envelopes {
    /// Of H_arm, N m s.
    pub momentum: Envelope,
    /// Of T_arm, N m.
    pub torque: Envelope,
}

/// One envelope: in N m s, or in N m.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Envelope {
    /// Largest norm among the samples.
    pub sampled_max: f64,
    /// Largest norm that the limits allow.
    pub true_max: f64,
    /// Where it points: a unit vector, body axes.
    pub true_max_axis: [f64; 3],
    /// Joint angles of that motion, those of the joints that turn, deg.
    pub true_max_joint_angles_deg: Vec<f64>,
    /// Travels of the joints that slide in that motion, m.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub true_max_joint_travels_m: Vec<f64>,
    /// Largest component along x, y and z in magnitude.
    pub per_axis_max: [f64; 3],
    /// Smallest extent over all directions.
    pub true_min: f64,
    /// Volume of the convex hull of the samples.
    pub hull_volume: f64,
    /// Volume of the convex hull of the extreme points: at most that of the true envelope.
    pub true_volume: f64,
    /// Volume within the half spaces that bound it: at least that of the true envelope. None for an
    /// arm that reaches nothing in some direction.
    pub true_volume_bound: Option<f64>,
    /// Of arm and wheels together.
    pub with_wheels: Together,
    /// What it takes to match the wheels.
    pub sizing: Sizing,
    /// The convex hull of the samples.
    #[serde(skip)]
    pub sampled_hull: Mesh,
    /// The convex hull of the extreme points.
    #[serde(skip)]
    pub hull: Mesh,
    /// The extreme points, which for a flat envelope have no hull.
    #[serde(skip)]
    pub extreme_points: Vec<Vector3<f64>>,
}

/// The envelopes of an arm within its limits, `samples` of them drawn by `seed`, and the sizes at
/// which arm and `wheels` match. The result does not depend on the number of cores.
pub fn envelopes(
    system: &SystemDescription,
    samples: usize,
    seed: u64,
    wheels: &WheelArray,
) -> Envelopes {
    let arm = Arm { model: &system.model, limits: &system.joint_limits };
    let [momenta, torques] = samples::draw(arm, samples, seed);
    Envelopes {
        momentum: envelope(
            system,
            Quantity::Momentum,
            &momenta,
            &Zonotope::momenta(wheels.wheels()),
        ),
        torque: envelope(system, Quantity::Torque, &torques, &Zonotope::torques(wheels.wheels())),
    }
}

/// The largest norms of momentum and torque among the samples, without the rest.
pub fn sampled_maxima(system: &SystemDescription, samples: usize, seed: u64) -> [f64; 2] {
    let arm = Arm { model: &system.model, limits: &system.joint_limits };
    samples::draw(arm, samples, seed).map(|points| largest(&points))
}

fn envelope(
    system: &SystemDescription,
    of: Quantity,
    samples: &[Vector3<f64>],
    wheels: &Zonotope,
) -> Envelope {
    let arm = Arm { model: &system.model, limits: &system.joint_limits };
    let reaches = extent::reach(arm, of);
    let farthest = extent::farthest(arm, of, &reaches);
    let point = farthest.as_ref().map_or_else(Vector3::zeros, |reach| reach.motion.vector);
    let angles = farthest.map_or_else(Vec::new, |reach| reach.motion.angles);
    let kinds = system.model.joint_kinds();
    let axis = |i: usize| reaches[i].extent().max(reaches[i + 3].extent());
    let sampled_hull = convex_hull(samples);
    let hull = extent::inner_hull(&reaches);
    let clean = |value: f64| if value.abs() < 1e-12 { 0.0 } else { value };
    let both = |reach: &extent::Reach| reach.extent() + wheels.extent(&reach.direction);
    let with_wheels = Together {
        max: reaches.iter().map(both).fold(0.0, f64::max),
        min: clean(reaches.iter().map(both).fold(f64::INFINITY, f64::min)),
        per_axis_max: [0, 1, 2].map(|i| both(&reaches[i]).max(both(&reaches[i + 3]))),
    };
    Envelope {
        sampled_max: largest(samples),
        true_max: point.norm(),
        true_max_axis: point.try_normalize(f64::MIN_POSITIVE).unwrap_or_default().into(),
        true_max_joint_angles_deg: of_kind(&kinds, JointKind::Revolute, &angles)
            .into_iter()
            .map(f64::to_degrees)
            .collect(),
        true_max_joint_travels_m: of_kind(&kinds, JointKind::Prismatic, &angles),
        per_axis_max: [0, 1, 2].map(|i| clean(axis(i))),
        true_min: clean(reaches.iter().map(extent::Reach::extent).fold(f64::INFINITY, f64::min)),
        hull_volume: sampled_hull.volume(),
        true_volume: hull.volume(),
        true_volume_bound: extent::outer_volume(&reaches),
        with_wheels,
        sizing: sizing::sizing(system, of, &reaches, wheels),
        sampled_hull,
        hull,
        extreme_points: reaches.into_iter().map(|reach| reach.motion.vector).collect(),
    }
}

fn largest(points: &[Vector3<f64>]) -> f64 {
    points.iter().map(Vector3::norm).fold(0.0, f64::max)
}
