//! The state of the full form, x = [r, q_BN, ṙ, ω, q, q̇] ∈ R^{13+2j}.

use crate::attitude::Quaternion;
use crate::external::External;
use crate::system::System;
use nalgebra::Vector3;
use righting_scalar::Scalar;

/// Position and velocity of the base and of every joint.
#[derive(Debug, Clone, PartialEq)]
pub struct State<T> {
    /// r, of the body-frame origin, inertial, m.
    pub position: Vector3<T>,
    /// q_BN, from body to inertial axes.
    pub attitude: Quaternion<T>,
    /// ṙ, of the body-frame origin, inertial, m/s.
    pub velocity: Vector3<T>,
    /// ω of the base, body axes, rad/s.
    pub angular_rate: Vector3<T>,
    /// q, rad; m of joints that slide.
    pub joint_angles: Vec<T>,
    /// q̇, rad/s; m/s of joints that slide.
    pub joint_rates: Vec<T>,
}

impl<T: Scalar> State<T> {
    /// Length of the state vector of a system with `joint_count` joints.
    pub const fn dimension(joint_count: usize) -> usize {
        13 + 2 * joint_count
    }

    /// Reads a state vector; none if no number of joints has one of this length.
    pub fn from_slice(x: &[T]) -> Option<Self> {
        let (base, joints) = x.split_at_checked(13)?;
        if joints.len() % 2 != 0 {
            return None;
        }
        let (angles, rates) = joints.split_at(joints.len() / 2);
        Some(Self {
            position: Vector3::new(base[0], base[1], base[2]),
            attitude: Quaternion::new(base[3], base[4], base[5], base[6]),
            velocity: Vector3::new(base[7], base[8], base[9]),
            angular_rate: Vector3::new(base[10], base[11], base[12]),
            joint_angles: angles.to_vec(),
            joint_rates: rates.to_vec(),
        })
    }

    /// The state vector.
    pub fn to_vec(&self) -> Vec<T> {
        let mut x = Vec::with_capacity(Self::dimension(self.joint_angles.len()));
        x.extend(self.position.iter());
        x.extend(self.attitude.to_array());
        x.extend(self.velocity.iter());
        x.extend(self.angular_rate.iter());
        x.extend(&self.joint_angles);
        x.extend(&self.joint_rates);
        x
    }
}

impl System {
    /// ẋ of the full form for the state x ∈ R^{13+2j} and joint accelerations u ∈ R^j (rad/s²). Nothing acts from
    /// outside but `external`.
    ///
    /// # Panics
    /// `x` or `u` does not have the length this system's have.
    pub fn state_derivative<T: Scalar>(
        &self,
        x: &[T],
        u: &[T],
        external: Option<&External<T>>,
    ) -> Vec<T> {
        let state = State::from_slice(x).expect("a state vector has 13 + 2j elements");
        let State { attitude, velocity, angular_rate, joint_angles, joint_rates, .. } = &state;
        let base = self.base_acceleration(angular_rate, joint_angles, joint_rates, u, external);
        State {
            position: *velocity,
            attitude: attitude.rate(angular_rate),
            velocity: attitude.to_inertial(&base.linear),
            angular_rate: base.angular,
            joint_angles: joint_rates.clone(),
            joint_rates: u.to_vec(),
        }
        .to_vec()
    }
}
