//! Gains about a plan, for a flight computer that corrects it on the way.

use nalgebra::DMatrix;
use righting_results::Trajectory;

use crate::ExportError;
use crate::npz::{Array, archive};

/// A plan and its gains: in step k the joints accelerate by
///
/// ```text
/// u = u*_k − K_k e,   e = [φ, q − q*_k, q̇ − q̇*_k],   q_BN = q*_BN,k ⊗ exp(φ/2)
/// ```
///
/// where attitude and joints are measured when the step begins. Angles in rad, travels of joints that slide in m.
#[derive(Clone, Copy, Debug)]
pub struct PlannedGains<'a> {
    /// The plan.
    pub trajectory: &'a Trajectory,
    /// K of each step, j × (3 + 2j).
    pub gains: &'a [DMatrix<f64>],
}

impl PlannedGains<'_> {
    /// As an archive of NumPy arrays of doubles:
    ///
    /// | array | shape | |
    /// | --- | --- | --- |
    /// | `t_s` | N | when a step begins |
    /// | `q_wxyz` | N, 4 | planned attitude then, body → inertial, scalar first |
    /// | `q_rad`, `dq_rad_s`, `u_rad_s2` | N, j | planned joint angles, rates and accelerations |
    /// | `k` | N, j, 3 + 2j | the gains |
    ///
    /// # Errors
    /// [`ExportError::Archive`] for more data than an archive without its 64-bit extension holds.
    pub fn to_npz(&self) -> Result<Vec<u8>, ExportError> {
        let (steps, joints) = (self.trajectory.steps(), self.trajectory.joints());
        let nodes = || self.trajectory.nodes()[..steps].iter();
        let array = |name, shape: &[usize], values: Vec<f64>| {
            let shape = std::iter::once(steps).chain(shape.iter().copied()).collect();
            Array { name, shape, values }
        };
        let intervals = self.trajectory.intervals().iter();
        let by_rows = |gain: &DMatrix<f64>| gain.transpose().iter().copied().collect::<Vec<f64>>();
        archive([
            array("t_s", &[], nodes().map(|node| node.time_s).collect()),
            array("q_wxyz", &[4], nodes().flat_map(|node| node.attitude).collect()),
            array(
                "q_rad",
                &[joints],
                nodes().flat_map(|node| node.joint_angles_rad.clone()).collect(),
            ),
            array(
                "dq_rad_s",
                &[joints],
                nodes().flat_map(|node| node.joint_rates_rad_s.clone()).collect(),
            ),
            array(
                "u_rad_s2",
                &[joints],
                intervals
                    .flat_map(|interval| interval.joint_accelerations_rad_s2.clone())
                    .collect(),
            ),
            array("k", &[joints, 3 + 2 * joints], self.gains.iter().flat_map(by_rows).collect()),
        ])
    }

    /// As a table: one row a step, the same values in the same order; `k2_q1` is what joint 2 does about the angle of
    /// joint 1.
    pub fn to_csv(&self) -> String {
        let joints = 1..=self.trajectory.joints();
        let mut names: Vec<String> = ["t_s", "qw", "qx", "qy", "qz"].map(str::to_owned).to_vec();
        for (before, after) in [("q", "_rad"), ("dq", "_rad_s"), ("u", "_rad_s2")] {
            names.extend(joints.clone().map(|joint| format!("{before}{joint}{after}")));
        }
        for joint in joints.clone() {
            names.extend(["x", "y", "z"].map(|axis| format!("k{joint}_phi_{axis}")));
            names.extend(joints.clone().map(|of| format!("k{joint}_q{of}")));
            names.extend(joints.clone().map(|of| format!("k{joint}_dq{of}")));
        }
        let mut text = names.join(",") + "\n";
        let steps = self.trajectory.nodes().iter().zip(self.trajectory.intervals());
        for ((node, interval), gain) in steps.zip(self.gains) {
            let planned = std::iter::once(node.time_s)
                .chain(node.attitude)
                .chain(node.joint_angles_rad.iter().copied())
                .chain(node.joint_rates_rad_s.iter().copied())
                .chain(interval.joint_accelerations_rad_s2.iter().copied());
            let gains = gain.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<f64>>());
            let cells: Vec<String> =
                planned.chain(gains).map(|value| format!("{value:.16e}")).collect();
            text += &cells.join(",");
            text.push('\n');
        }
        text
    }
}
