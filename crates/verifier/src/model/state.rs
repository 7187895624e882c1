//! The state x = [r, q_BN, ṙ, ω, q, q̇] ∈ R^{13+2j}.

use nalgebra::{Quaternion, Vector3};
use righting_results::trajectory::Node;

/// A view of a state: where the base is, how it moves, and every joint.
#[derive(Clone, Copy, Debug)]
pub struct State<'a> {
    /// r, of the origin of the body frame, inertial, m.
    pub position: Vector3<f64>,
    /// q_BN, from body to inertial axes; of unit length but for the errors of an integration.
    pub attitude: Quaternion<f64>,
    /// ṙ, inertial, m/s.
    pub velocity: Vector3<f64>,
    /// ω of the base, body axes, rad/s.
    pub angular_rate: Vector3<f64>,
    /// q, one a joint, rad.
    pub joint_angles: &'a [f64],
    /// q̇, one a joint, rad/s.
    pub joint_rates: &'a [f64],
}

/// States before those of the joints.
const BASE: usize = 13;

impl<'a> State<'a> {
    /// Number of states of a system with `joints` joints.
    pub const fn dimension(joints: usize) -> usize {
        BASE + 2 * joints
    }

    /// Of a state vector.
    ///
    /// # Panics
    /// The slice has fewer than 13 elements.
    pub fn from_slice(x: &'a [f64]) -> Self {
        let (base, joints) = x.split_at(BASE);
        let (joint_angles, joint_rates) = joints.split_at(joints.len() / 2);
        let vector = |start: usize| Vector3::from_column_slice(&base[start..start + 3]);
        Self {
            position: vector(0),
            attitude: Quaternion::new(base[3], base[4], base[5], base[6]),
            velocity: vector(7),
            angular_rate: vector(10),
            joint_angles,
            joint_rates,
        }
    }

    /// Of a trajectory's node.
    pub fn of_node(node: &'a Node) -> Self {
        let [w, x, y, z] = node.attitude;
        Self {
            position: node.position_m.into(),
            attitude: Quaternion::new(w, x, y, z),
            velocity: node.velocity_m_s.into(),
            angular_rate: node.angular_rate_rad_s.into(),
            joint_angles: &node.joint_angles_rad,
            joint_rates: &node.joint_rates_rad_s,
        }
    }

    /// The attitude's entries w, x, y, z.
    pub fn attitude_wxyz(&self) -> [f64; 4] {
        let Quaternion { coords } = self.attitude;
        [coords.w, coords.x, coords.y, coords.z]
    }

    /// Writes the state vector into `x`.
    ///
    /// # Panics
    /// `x` does not have 13 + 2j elements.
    pub fn write(&self, x: &mut [f64]) {
        assert_eq!(x.len(), Self::dimension(self.joint_angles.len()));
        let (base, joints) = x.split_at_mut(BASE);
        base[..3].copy_from_slice(self.position.as_slice());
        base[3..7].copy_from_slice(&self.attitude_wxyz());
        base[7..10].copy_from_slice(self.velocity.as_slice());
        base[10..].copy_from_slice(self.angular_rate.as_slice());
        let (angles, rates) = joints.split_at_mut(self.joint_angles.len());
        angles.copy_from_slice(self.joint_angles);
        rates.copy_from_slice(self.joint_rates);
    }

    /// The state vector.
    pub fn to_vec(&self) -> Vec<f64> {
        let mut x = vec![0.0; Self::dimension(self.joint_angles.len())];
        self.write(&mut x);
        x
    }
}
