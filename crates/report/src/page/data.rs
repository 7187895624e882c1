//! Everything the page says, in the shape that `page/src/data.ts` mirrors.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion};
use righting_multibody::{DhConvention, System};
use righting_results::{Solution, Trajectory, UsedOptimizer};
use righting_scenario::file::{JointKind, JointWords};
use righting_scenario::{Maneuver, Scenario, SystemDescription, bodies};
use serde::Serialize;

use super::columns::{Columns, capsules, shown, stride};
use super::cones::{Cone, cones};
use super::wheels::Wheel;
use crate::asked;
use crate::facts::{Fact, UsedLimit, facts, used_limits};
use crate::summary::{check_rows, verdict};

#[derive(Debug, Serialize)]
pub(super) struct PageData<'a> {
    name: &'a str,
    asked: String,
    description: Option<&'a str>,
    system: &'a str,
    verdict: Verdict,
    facts: Vec<Fact>,
    limits: Vec<UsedLimit>,
    notes: &'a [String],
    /// Rows of the table of checks, its head first.
    checks: Vec<[String; 6]>,
    made_by: String,
    spacecraft: Spacecraft,
    cones: Vec<Cone>,
    wheels: Vec<Wheel>,
    target_attitude: Option<[f64; 4]>,
    /// Those on the way to it, in order.
    waypoints: Vec<Waypoint>,
    bound_deg_s: Option<f64>,
    steps: usize,
    stride: usize,
    columns: Columns,
}

#[derive(Debug, Serialize)]
struct Verdict {
    passed: bool,
    text: String,
}

/// What is drawn and does not change.
#[derive(Debug, Serialize)]
struct Spacecraft {
    /// Edges of the uniform box with the base's mass and inertia, no larger than fits in the keep-out sphere; a cube
    /// is drawn as itself.
    box_m: [f64; 3],
    /// Its attitude in the body frame, scalar first.
    box_attitude: [f64; 4],
    /// Its center, the base's center of mass, in the body frame.
    box_center_m: [f64; 3],
    keep_out_radius_m: Option<f64>,
    /// Shapes that the arm keeps out of, in body axes.
    keep_out: Vec<KeepOut>,
    /// Radii of the arm's capsules, in the order of their column.
    capsule_radii_m: Vec<f64>,
    clearance_m: f64,
    /// Which of the arm's points lies on each joint's axis.
    joint_points: Vec<usize>,
    /// Which of the arm's points links are drawn between.
    links: Vec<[usize; 2]>,
    /// The arm's points that are its ends.
    tips: Vec<usize>,
    /// Names of the joints; none where a joint goes by its number.
    joint_names: Vec<Option<String>>,
    has_payload: bool,
    joint_limits: Vec<JointLimits>,
    /// The system's, at the start; inertial axes.
    center_of_mass_m: [f64; 3],
}

/// As in a system file, a sphere as a capsule whose ends are the same.
#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum KeepOut {
    Capsule { from_m: [f64; 3], to_m: [f64; 3], radius_m: f64 },
    Box { center_m: [f64; 3], size_m: [f64; 3] },
}

/// An attitude on the way, and the node shown that is the first at or after its arrival.
#[derive(Debug, Serialize)]
struct Waypoint {
    node: usize,
    attitude: [f64; 4],
}

impl Waypoint {
    fn of(waypoint: &righting_scenario::Waypoint, steps: usize, shown: &[usize]) -> Self {
        let [arrival, _] = waypoint.nodes(steps);
        let node = shown.iter().position(|&node| node >= arrival).unwrap_or(0);
        Self { node, attitude: waypoint.target.to_array() }
    }
}

/// Of a joint that turns in deg and its rates, of one that slides in m and its.
#[derive(Debug, Serialize)]
struct JointLimits {
    slides: bool,
    min: Option<f64>,
    max: Option<f64>,
    rate_max: f64,
    acceleration_max: f64,
    jerk_max: Option<f64>,
}

impl<'a> PageData<'a> {
    pub fn new(scenario: &'a Scenario, solution: &'a Solution, trajectory: &Trajectory) -> Self {
        let versions = &solution.versions;
        let target_attitude = match scenario.maneuver() {
            Maneuver::Slew(slew) => Some(slew.target.to_array()),
            Maneuver::Detumble => None,
        };
        Self {
            name: scenario.name(),
            asked: asked::planned_phrase(solution),
            description: solution.scenario.description.as_deref(),
            system: &scenario.system().name,
            verdict: Verdict { passed: solution.verification.passed, text: verdict(solution) },
            facts: facts(solution, trajectory),
            limits: used_limits(solution),
            notes: &solution.notes,
            checks: check_rows(&solution.verification.checks),
            made_by: format!(
                "Righting {}, iterations by {}, linear solver {}.",
                versions.righting,
                match versions.optimizer {
                    UsedOptimizer::Interior => "its own loop".to_owned(),
                    UsedOptimizer::Ipopt => format!("Ipopt {}", versions.ipopt),
                },
                versions.linear_solver
            ),
            spacecraft: Spacecraft::new(scenario, trajectory),
            cones: {
                let nodes = shown(trajectory).into_iter().map(|k| &trajectory.nodes()[k]);
                cones(scenario, &nodes.collect::<Vec<_>>())
            },
            wheels: scenario.wheels().iter().map(Wheel::of).collect(),
            target_attitude,
            waypoints: {
                let nodes = shown(trajectory);
                let waypoints = scenario.waypoints().iter();
                waypoints
                    .map(|waypoint| Waypoint::of(waypoint, trajectory.steps(), &nodes))
                    .collect()
            },
            bound_deg_s: solution.bound_deg_s,
            steps: trajectory.steps(),
            stride: stride(trajectory),
            columns: Columns::new(scenario, trajectory),
        }
    }
}

impl Spacecraft {
    fn new(scenario: &Scenario, trajectory: &Trajectory) -> Self {
        let system = scenario.system();
        let model = &system.model;
        let start = trajectory.start().state();
        let (box_m, box_attitude) = equivalent_box(system);
        Self {
            box_m,
            box_attitude,
            box_center_m: model.base().center_of_mass_m.into(),
            keep_out_radius_m: system.keep_out_radius_m,
            keep_out: system.keep_out.iter().map(KeepOut::of).collect(),
            capsule_radii_m: capsules(scenario).map(|solid| solid.radius_m).collect(),
            clearance_m: scenario.collision().clearance_m,
            joint_points: joint_points(model),
            links: links(model),
            tips: tips(model),
            joint_names: (0..system.joint_count())
                .map(|joint| system.names.of_joint(joint).map(str::to_owned))
                .collect(),
            has_payload: model.rows().is_some_and(|rows| rows.payload.is_some()),
            joint_limits: system.joint_limits.iter().map(JointLimits::of).collect(),
            center_of_mass_m: model.inertial_center_of_mass(&start).into(),
        }
    }
}

/// The frame whose origin lies on each joint's axis.
fn joint_points(model: &System) -> Vec<usize> {
    let joints = 0..model.joint_count();
    match model.rows().map(|rows| rows.convention) {
        Some(DhConvention::Standard) => joints.collect(),
        Some(DhConvention::Modified) => joints.map(|joint| joint + 1).collect(),
        None => joints.filter_map(|joint| Some(model.body_of(joint)? + 1)).collect(),
    }
}

/// Of rows, each frame and the next; of bodies, each one's frame and that of the body that carries it, the
/// base aside.
fn links(model: &System) -> Vec<[usize; 2]> {
    match model.bodies() {
        None => (0..model.part_count()).map(|link| [link, link + 1]).collect(),
        Some(bodies) => {
            let carried = bodies.iter().enumerate();
            carried.filter_map(|(body, of)| Some([of.parent? + 1, body + 1])).collect()
        }
    }
}

/// The frames beyond which nothing is.
fn tips(model: &System) -> Vec<usize> {
    match model.bodies() {
        None => vec![model.part_count()],
        Some(bodies) => {
            let carries = |body: usize| bodies.iter().any(|other| other.parent == Some(body));
            (0..bodies.len()).filter(|&body| !carries(body)).map(|body| body + 1).collect()
        }
    }
}

impl KeepOut {
    fn of(shape: &bodies::KeepOut) -> Self {
        match shape {
            bodies::KeepOut::Capsule { ends_m: [from_m, to_m], radius_m } => Self::Capsule {
                from_m: (*from_m).into(),
                to_m: (*to_m).into(),
                radius_m: *radius_m,
            },
            bodies::KeepOut::Cuboid(cuboid) => {
                Self::Box { center_m: cuboid.center_m.into(), size_m: (2.0 * cuboid.half_m).into() }
            }
        }
    }
}

impl JointLimits {
    fn of(limits: &righting_scenario::JointLimits) -> Self {
        let words = JointWords::of(limits.kind);
        let finite = |limit: f64| limit.is_finite().then(|| words.from_si(limit));
        Self {
            slides: limits.kind == JointKind::Prismatic,
            min: finite(limits.angle_min_rad),
            max: finite(limits.angle_max_rad),
            rate_max: words.from_si(limits.rate_max_rad_s),
            acceleration_max: words.from_si(limits.acceleration_max_rad_s2),
            jerk_max: finite(limits.jerk_max_rad_s3),
        }
    }
}

/// Edges and attitude of the uniform box with the base's mass and inertia: with principal moments
/// J, an edge a₁ obeys a₁² = 6 (J₂ + J₃ − J₁)/m. None is drawn thinner than a fiftieth of the longest.
/// It is drawn smaller where it would not fit in the sphere that the arm keeps out of.
fn equivalent_box(system: &SystemDescription) -> ([f64; 3], [f64; 4]) {
    let base = system.model.base();
    let principal = base.inertia_kg_m2.symmetric_eigen();
    let moments = principal.eigenvalues;
    let edges =
        moments.map(|own| (6.0 * (moments.sum() - 2.0 * own) / base.mass_kg).max(0.0).sqrt());
    let edges = edges.map(|edge| edge.max(0.02 * edges.max()));
    let fitting = system.keep_out_radius_m.map_or(1.0, |radius_m| 2.0 * radius_m / edges.norm());
    let edges = edges * fitting.min(1.0);
    let mut axes: Matrix3<f64> = principal.eigenvectors;
    if axes.determinant() < 0.0 {
        axes = -axes;
    }
    let attitude = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    (edges.into(), [attitude.w, attitude.i, attitude.j, attitude.k])
}
