//! The columns of a trajectory in groups, as archives of arrays hold them.

use righting_results::{ControlInterval, Node, Trajectory};

/// A matrix, or a vector where it has no width.
pub(crate) struct Columns {
    pub name: &'static str,
    pub rows: usize,
    pub width: Option<usize>,
    /// Row by row.
    pub values: Vec<f64>,
}

/// All groups of `trajectory.csv`:
///
/// | array | shape | |
/// | --- | --- | --- |
/// | `t_s`, `power_w` | N + 1 | time, mechanical power of the joints |
/// | `r_m`, `v_m_s` | N + 1, 3 | position and velocity of the base, inertial axes |
/// | `q_wxyz` | N + 1, 4 | attitude, body → inertial, scalar first |
/// | `w_rad_s` | N + 1, 3 | angular rate, body axes |
/// | `q_rad`, `dq_rad_s` | N + 1, j | joint angles and rates |
/// | `u_rad_s2`, `tau_n_m` | N, j | joint accelerations and torques at the first node of an interval |
/// | `j_rad_s3` | N, j | joint jerks of an interval, where the plan has them |
///
/// The columns of a joint that slides are in m instead of rad, and in N instead of N m.
pub(crate) fn groups(trajectory: &Trajectory) -> Vec<Columns> {
    let nodes = trajectory.nodes();
    let intervals = trajectory.intervals();
    let joints = trajectory.joints();
    let of_nodes = |name, width: Option<usize>, row: &dyn Fn(&Node) -> Vec<f64>| Columns {
        name,
        rows: nodes.len(),
        width,
        values: nodes.iter().flat_map(row).collect(),
    };
    let of_intervals = |name, row: &dyn Fn(&ControlInterval) -> Vec<f64>| Columns {
        name,
        rows: intervals.len(),
        width: Some(joints),
        values: intervals.iter().flat_map(row).collect(),
    };
    let mut groups = vec![
        of_nodes("t_s", None, &|node| vec![node.time_s]),
        of_nodes("r_m", Some(3), &|node| node.position_m.to_vec()),
        of_nodes("q_wxyz", Some(4), &|node| node.attitude.to_vec()),
        of_nodes("v_m_s", Some(3), &|node| node.velocity_m_s.to_vec()),
        of_nodes("w_rad_s", Some(3), &|node| node.angular_rate_rad_s.to_vec()),
        of_nodes("q_rad", Some(joints), &|node| node.joint_angles_rad.clone()),
        of_nodes("dq_rad_s", Some(joints), &|node| node.joint_rates_rad_s.clone()),
        of_intervals("u_rad_s2", &|interval| interval.joint_accelerations_rad_s2.clone()),
        of_intervals("tau_n_m", &|interval| interval.joint_torques_n_m.clone()),
        of_nodes("power_w", None, &|node| vec![node.power_w]),
    ];
    if trajectory.has_jerks() {
        groups.push(of_intervals("j_rad_s3", &|interval| interval.joint_jerks_rad_s3.clone()));
    }
    groups
}
