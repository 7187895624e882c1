//! About which axes an arm can turn its base.

use nalgebra::{Matrix3, Vector3};
use righting_multibody::JointKind;
use righting_scenario::SystemDescription;
use righting_scenario::halton::Halton;

use super::connection::connection;

/// Postures looked at, spread evenly over the joints' ranges.
const POSTURES: usize = 64;
/// So many of them are looked at again with one joint moved to both sides by as much, rad.
const POSTURES_MOVED: usize = 8;
const MOVED_RAD: f64 = 0.5;
/// A base that turns by less than this a radian of every joint does not turn, rad/rad.
const NO_TURN: f64 = 1e-12;
/// A direction counts when the base turns so far about it, relative to the direction it turns most about.
const RELATIVE: f64 = 1e-6;
/// Sine of the angle up to which two joint axes are parallel.
const PARALLEL: f64 = 1e-6;

/// The rotations of the base that motions of the joints can be made of. See the [module](super).
#[derive(Clone, Debug, PartialEq)]
pub struct TurnableAxes {
    /// Joints whose limits leave them no motion, counted from zero.
    pub locked_joints: Vec<usize>,
    /// Joints that move, but neither turn the base nor change how the others do, counted from zero.
    pub idle_joints: Vec<usize>,
    /// All other joints, counted from zero.
    pub effective_joints: Vec<usize>,
    /// Unit vectors, body axes: the base turns most about the first, least about the last.
    pub principal_axes: [Vector3<f64>; 3],
    /// How far the base turns about each principal axis a radian of an effective joint, or a size of the
    /// system where it slides: the root mean
    /// square of A over the joints' ranges, rad/rad, largest first.
    pub singular_values: [f64; 3],
    /// Whether there are several effective joints, all of which turn, and their axes are parallel in every
    /// posture.
    pub are_joints_parallel: bool,
    /// Σ_i max_q |A_i| q̇max_i: no motion of the joints turns the base faster, as far as postures were
    /// looked at, rad/s.
    pub fastest_rad_s: f64,
    /// The same across the first principal axis, rad/s.
    pub fastest_across_rad_s: f64,
}

impl TurnableAxes {
    /// Of a system, over the ranges of its joints; one without limits ranges over a turn.
    pub fn new(system: &SystemDescription) -> Self {
        let joints = system.joint_count();
        let is_locked = |joint: &usize| system.joint_limits[*joint].is_locked();
        let (locked_joints, moving): (Vec<usize>, Vec<usize>) = (0..joints).partition(is_locked);
        let postures: Vec<Vec<f64>> =
            Halton::new(joints).take(POSTURES).map(|unit| system.joint_angles_at(&unit)).collect();
        // Joints that slide count by the system's size.
        let counts = system.radians_a_unit();
        let connection = |posture: &[f64]| -> Vec<Vector3<f64>> {
            let columns = connection(&system.model, posture).into_iter().zip(&counts);
            columns.map(|(column, counts)| column / *counts).collect()
        };
        let maps: Vec<Vec<Vector3<f64>>> =
            postures.iter().map(|posture| connection(posture)).collect();
        let most = |joint: usize, length: &dyn Fn(&Vector3<f64>) -> f64| {
            maps.iter().map(|map| length(&map[joint])).fold(0.0, f64::max)
        };
        let norm: &dyn Fn(&Vector3<f64>) -> f64 = &Vector3::norm;
        let largest = moving.iter().map(|&joint| most(joint, norm)).fold(0.0, f64::max);
        let least = RELATIVE * largest;
        let turns_nothing = |joint: usize| largest <= NO_TURN || most(joint, norm) <= least;
        // Where A_i vanishes, F_ij is the change of A_j with q_i.
        let changes_nothing = |joint: usize| {
            postures.iter().take(POSTURES_MOVED).all(|posture| {
                let moved = |way: f64| {
                    let mut there = posture.clone();
                    there[joint] += way * MOVED_RAD / counts[joint];
                    connection(&there)
                };
                let (after, before) = (moved(1.0), moved(-1.0));
                moving.iter().all(|&other| (after[other] - before[other]).norm() <= least)
            })
        };
        let is_idle = |joint: &usize| {
            turns_nothing(*joint) && (largest <= NO_TURN || changes_nothing(*joint))
        };
        let (idle_joints, effective_joints): (Vec<usize>, Vec<usize>) =
            moving.iter().partition(|joint| is_idle(joint));

        let columns = maps.iter().flat_map(|map| effective_joints.iter().map(|&i| &map[i]));
        let count = (maps.len() * effective_joints.len()).max(1) as f64;
        let spread: Matrix3<f64> = columns.map(|a| a * a.transpose()).sum::<Matrix3<f64>>() / count;
        let (principal_axes, singular_values) = principal(&spread);
        let first = principal_axes[0];
        let across = |a: &Vector3<f64>| (a - first * first.dot(a)).norm();
        let fastest = |length: &dyn Fn(&Vector3<f64>) -> f64| {
            let rates = effective_joints.iter().map(|&joint| {
                most(joint, length) * system.joint_limits[joint].rate_max_rad_s * counts[joint]
            });
            rates.sum()
        };
        let turns = |joint: &usize| system.joint_limits[*joint].kind == JointKind::Revolute;
        let are_joints_parallel = effective_joints.len() > 1
            && effective_joints.iter().all(turns)
            && postures.iter().all(|posture| {
                let axes = system.model.kinematics(posture).joint_axes;
                let mut pairs = effective_joints.windows(2);
                pairs.all(|pair| axes[pair[0]].cross(&axes[pair[1]]).norm() <= PARALLEL)
            });
        Self {
            fastest_rad_s: fastest(norm),
            fastest_across_rad_s: fastest(&across),
            locked_joints,
            idle_joints,
            effective_joints,
            principal_axes,
            singular_values,
            are_joints_parallel,
        }
    }

    /// Dimensions of the group that the base's attitudes stay in: 0, 1 or 3.
    pub fn rank(&self) -> usize {
        let [first, second, _] = self.singular_values;
        match () {
            () if first <= NO_TURN => 0,
            () if second <= RELATIVE * first => 1,
            () => 3,
        }
    }

    /// The only axis about which the base turns, a unit vector in body axes; none if there is no axis or
    /// more than one.
    pub fn only_axis(&self) -> Option<Vector3<f64>> {
        (self.rank() == 1).then_some(self.principal_axes[0])
    }

    /// The angle between the only axis, whichever way it points, and a unit vector (body axes), rad; none
    /// if there is no axis or more than one.
    pub fn off_axis_rad(&self, axis: &Vector3<f64>) -> Option<f64> {
        self.only_axis().map(|only| off_axis_rad(&only, axis))
    }
}

/// The angle between two lines, rad, at most π/2; exact for small ones too.
pub(crate) fn off_axis_rad(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b).abs())
}

/// Eigenvectors of a symmetric matrix, each with its largest component positive, and the roots of its
/// eigenvalues, the largest first.
pub(super) fn principal(spread: &Matrix3<f64>) -> ([Vector3<f64>; 3], [f64; 3]) {
    let eigen = spread.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let axes = order.map(|i| {
        let axis: Vector3<f64> = eigen.eigenvectors.column(i).into_owned();
        axis * axis[axis.iamax()].signum()
    });
    (axes, order.map(|i| eigen.eigenvalues[i].max(0.0).sqrt()))
}
