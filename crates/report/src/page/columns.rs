//! The plan as the page reads it: columns of single-precision numbers, node by node.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use righting_multibody::Kinematics;
use righting_results::{ControlInterval, Node, Trajectory};
use righting_scenario::bodies::Solid;
use righting_scenario::collision::Clearance;
use righting_scenario::wheels::stored;
use righting_scenario::{CollisionModel, Scenario};
use serde::Serialize;

/// More intervals than this are thinned out.
const MOST_INTERVALS: usize = 1000;

/// A column: little-endian `f32`, all numbers of a node together, in base64. It is a quarter of the
/// same numbers in decimal, and finer than a pixel.
pub(super) type Column = String;

/// What the page shows of each node; a column that the plan has no numbers for is empty.
///
/// Names, units and frames are those of `trajectory.csv` where all joints turn (those that slide have m and N
/// under the same names); what it does not have:
/// `joint_accelerations_rad_s2` are there at the last node too where there are jerks; `attitude_error_rad` is
/// the angle to a slew's target, or its next waypoint, `arm_points_m` are the origins of frames
/// 0…j and `joint_axes` unit vectors, both in body axes, `arm_momentum_n_m_s` is H̃ in body axes, and
/// `angular_momentum_n_m_s` is the system's with that of its wheels, about its center of mass in inertial axes,
/// `stored_momentum_n_m_s` what the wheels store, in body axes, and
/// clearances are the least of any link from what the base keeps out and of any two links. `capsules_m` are
/// the two ends of the segment inside each capsule of the arm that is drawn as one, in body axes.
#[derive(Debug, Serialize)]
pub(super) struct Columns {
    time_s: Column,
    position_m: Column,
    attitude: Column,
    angular_rate_rad_s: Column,
    joint_angles_rad: Column,
    joint_rates_rad_s: Column,
    joint_accelerations_rad_s2: Column,
    joint_jerks_rad_s3: Column,
    joint_torques_n_m: Column,
    power_w: Column,
    attitude_error_rad: Column,
    arm_points_m: Column,
    joint_axes: Column,
    capsules_m: Column,
    arm_momentum_n_m_s: Column,
    angular_momentum_n_m_s: Column,
    stored_momentum_n_m_s: Column,
    wheel_momenta_n_m_s: Column,
    wheel_torques_n_m: Column,
    body_clearance_m: Column,
    link_clearance_m: Column,
}

/// Of how many nodes one is shown.
pub(super) fn stride(trajectory: &Trajectory) -> usize {
    trajectory.steps().div_ceil(MOST_INTERVALS)
}

/// The nodes that are shown: every so many, and the last.
pub(super) fn shown(trajectory: &Trajectory) -> Vec<usize> {
    let steps = trajectory.steps();
    let mut shown: Vec<usize> = (0..steps).step_by(stride(trajectory)).collect();
    shown.push(steps);
    shown
}

impl Columns {
    /// Computes where everything is at the nodes shown.
    pub fn new(scenario: &Scenario, trajectory: &Trajectory) -> Self {
        let shown = shown(trajectory);
        let nodes: Vec<&Node> = shown.iter().map(|&k| &trajectory.nodes()[k]).collect();
        let model = &scenario.system().model;
        let postures: Vec<Kinematics<f64>> =
            nodes.iter().map(|node| model.kinematics(&node.joint_angles_rad)).collect();
        let held = |of_interval: fn(&ControlInterval) -> &[f64]| {
            let width = of_interval(&trajectory.intervals()[0]).len();
            let of_node = |&k: &usize| match trajectory.intervals().get(k) {
                Some(interval) => of_interval(interval).to_vec(),
                None => vec![f64::NAN; width],
            };
            encoded(shown.iter().flat_map(of_node))
        };
        let joint_accelerations_rad_s2 = match trajectory.has_jerks() {
            true => encoded(shown.iter().flat_map(|&k| trajectory.joint_accelerations_at(k))),
            false => held(|interval| &interval.joint_accelerations_rad_s2),
        };
        let momentum = |node: &&Node| -> [f64; 3] {
            model.h_tilde(&node.joint_angles_rad, &node.joint_rates_rad_s).into()
        };
        let in_store = |node: &&Node| stored(scenario.wheels(), &node.wheel_momenta_n_m_s);
        let total = |node: &&Node| -> [f64; 3] {
            let state = node.state();
            let attitude = state.attitude;
            (model.inertial_angular_momentum(&state) + attitude.to_inertial(&in_store(node))).into()
        };
        let stores = !scenario.wheels().is_empty();
        let stored_momenta = nodes.iter().filter(|_| stores).flat_map(|node| {
            let momentum: [f64; 3] = in_store(node).into();
            momentum
        });
        let legs = scenario.legs();
        let error = |k: &usize| {
            let share = *k as f64 / trajectory.steps() as f64;
            let leg = legs.iter().rfind(|leg| share > leg.start).or(legs.first())?;
            Some(trajectory.nodes()[*k].state().attitude.angle_to(&leg.target))
        };
        let errors: Vec<f64> = shown.iter().filter_map(error).collect();
        let [body_clearance_m, link_clearance_m] = clearances(scenario, &postures);
        let points = postures.iter().flat_map(|posture| posture.frames.iter().map(|f| &f.origin));
        let axes = postures.iter().flat_map(|posture| &posture.joint_axes);
        Self {
            time_s: encoded(nodes.iter().map(|node| node.time_s)),
            position_m: encoded(nodes.iter().flat_map(|node| node.position_m)),
            attitude: encoded(nodes.iter().flat_map(|node| node.attitude)),
            angular_rate_rad_s: encoded(nodes.iter().flat_map(|node| node.angular_rate_rad_s)),
            joint_angles_rad: encoded(nodes.iter().flat_map(|node| node.joint_angles_rad.clone())),
            joint_rates_rad_s: encoded(
                nodes.iter().flat_map(|node| node.joint_rates_rad_s.clone()),
            ),
            joint_accelerations_rad_s2,
            joint_jerks_rad_s3: held(|interval| &interval.joint_jerks_rad_s3),
            joint_torques_n_m: held(|interval| &interval.joint_torques_n_m),
            power_w: encoded(nodes.iter().map(|node| node.power_w)),
            attitude_error_rad: encoded(errors),
            arm_points_m: encoded(points.flat_map(|point| [point.x, point.y, point.z])),
            joint_axes: encoded(axes.flat_map(|axis| [axis.x, axis.y, axis.z])),
            capsules_m: encoded(
                postures.iter().flat_map(|posture| capsule_ends(scenario, posture)),
            ),
            arm_momentum_n_m_s: encoded(nodes.iter().flat_map(momentum)),
            angular_momentum_n_m_s: encoded(nodes.iter().flat_map(total)),
            stored_momentum_n_m_s: encoded(stored_momenta),
            wheel_momenta_n_m_s: encoded(
                nodes.iter().flat_map(|node| node.wheel_momenta_n_m_s.clone()),
            ),
            wheel_torques_n_m: held(|interval| &interval.wheel_torques_n_m),
            body_clearance_m,
            link_clearance_m,
        }
    }
}

/// The solids of the arm that are drawn as capsules: those that are no thin links.
pub(super) fn capsules(scenario: &Scenario) -> impl Iterator<Item = &Solid> {
    let is_thin = |solid: &Solid| solid.piece.shape.is_none() && solid.radius_m == 0.0;
    scenario.system().solids.iter().filter(move |solid| !is_thin(solid))
}

fn capsule_ends(scenario: &Scenario, posture: &Kinematics<f64>) -> Vec<f64> {
    let ends = |solid: &Solid| {
        let core = posture.core(&solid.core);
        [core.start, core.end()]
    };
    capsules(scenario).flat_map(ends).flat_map(|end| [end.x, end.y, end.z]).collect()
}

/// The least clearance from what the base keeps out and between links; empty where nothing can collide.
fn clearances(scenario: &Scenario, postures: &[Kinematics<f64>]) -> [Column; 2] {
    let collision: &CollisionModel = scenario.collision();
    let (mut body, mut links) = (Vec::new(), Vec::new());
    for posture in postures {
        let (from_base, between): (Vec<Clearance>, Vec<Clearance>) =
            collision.clearances(posture).partition(|c| c.between.off_base().is_some());
        // From the keep-out sphere's surface: what is asked beyond the clearance is its radius.
        let to_surface = |c: &Clearance| c.distance_m - (c.least_m - collision.clearance_m);
        body.extend(from_base.iter().map(to_surface).reduce(f64::min));
        links.extend(between.iter().map(|c| c.distance_m).reduce(f64::min));
    }
    [encoded(body), encoded(links)]
}

#[expect(clippy::cast_possible_truncation, reason = "the page draws in single precision")]
pub(super) fn encoded(values: impl IntoIterator<Item = f64>) -> Column {
    let bytes: Vec<u8> =
        values.into_iter().flat_map(|value| (value as f32).to_le_bytes()).collect();
    STANDARD.encode(bytes)
}
