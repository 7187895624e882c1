//! Momenta of base and arm, and the rate that a given momentum leaves the base.

use crate::algebra::{cross, difference, sum};
use crate::attitude::Quaternion;
use crate::composite::Composite;
use crate::state::State;
use crate::system::System;
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// Slices `q` and `qdot` hold one angle (rad) and one rate (rad/s) a joint; the methods panic if they
/// do not.
impl System {
    /// Ĩ(q), the inertia of the whole system with its joints held, about its centre of mass, body
    /// axes (3×3, symmetric positive definite), kg m².
    pub fn locked_inertia<T: Scalar>(&self, q: &[T]) -> Matrix3<T> {
        let Composite { inertia, axes, .. } = self.composite_at_rest(q);
        axes.matrix_to_body(inertia).to_matrix()
    }

    /// H̃(q, q̇), the angular momentum about the system's centre of mass of the arm's motion relative
    /// to the base, body axes, N m s.
    pub fn h_tilde<T: Scalar>(&self, q: &[T], qdot: &[T]) -> Vector3<T> {
        let Composite { relative, axes, .. } = self.composite(q, qdot);
        axes.to_body(&relative.angular)
    }

    /// H = Ĩ ω + H̃, the angular momentum about the system's centre of mass, body axes, N m s, for a
    /// base turning at `omega` (body axes, rad/s).
    pub fn angular_momentum<T: Scalar>(
        &self,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
    ) -> Vector3<T> {
        let Composite { inertia, relative, axes, .. } = self.composite(q, qdot);
        axes.to_body(&sum(&inertia.times(&axes.to_sweep(omega)), &relative.angular))
    }

    /// ω = Ĩ⁻¹ (H − H̃), the rate of the base (body axes, rad/s) at which the system has the angular
    /// momentum `h_body` about its centre of mass, body axes, N m s. A free-floating system keeps
    /// h₀ in inertial axes, so `h_body` is C(q_BN)ᵀ h₀.
    pub fn reduced_angular_rate<T: Scalar>(
        &self,
        q: &[T],
        qdot: &[T],
        h_body: &Vector3<T>,
    ) -> Vector3<T> {
        let Composite { inertia, relative, axes, .. } = self.composite(q, qdot);
        let left = difference(&axes.to_sweep(h_body), &relative.angular);
        axes.to_body(&inertia.solve(&left))
    }

    /// The system's centre of mass from the body-frame origin, body axes, m.
    pub fn center_of_mass<T: Scalar>(&self, q: &[T]) -> Vector3<T> {
        let Composite { first, axes, .. } = self.composite_at_rest(q);
        self.over_mass(&axes.to_body(&first))
    }

    /// The velocity of the system's centre of mass relative to the body frame, body axes, m/s.
    pub fn center_of_mass_rate<T: Scalar>(&self, q: &[T], qdot: &[T]) -> Vector3<T> {
        let Composite { relative, axes, .. } = self.composite(q, qdot);
        self.over_mass(&axes.to_body(&relative.linear))
    }

    /// P, the linear momentum in inertial axes, N s.
    pub fn linear_momentum<T: Scalar>(&self, state: &State<T>) -> Vector3<T> {
        let State { attitude, velocity, angular_rate, joint_angles, joint_rates, .. } = state;
        let relative = self.momentum_beyond_base(angular_rate, joint_angles, joint_rates);
        let own = velocity.map(|entry| entry * self.total_mass());
        sum(&own, &attitude.to_inertial(&relative))
    }

    /// The angular momentum about the system's centre of mass in inertial axes, N m s: constant
    /// along every free-floating motion.
    pub fn inertial_angular_momentum<T: Scalar>(&self, state: &State<T>) -> Vector3<T> {
        let State { attitude, angular_rate, joint_angles, joint_rates, .. } = state;
        attitude.to_inertial(&self.angular_momentum(angular_rate, joint_angles, joint_rates))
    }

    /// The system's centre of mass in inertial axes, m.
    pub fn inertial_center_of_mass<T: Scalar>(&self, state: &State<T>) -> Vector3<T> {
        let relative = self.center_of_mass(&state.joint_angles);
        sum(&state.position, &state.attitude.to_inertial(&relative))
    }

    /// Position of the body-frame origin that puts the system's centre of mass at `center`, both
    /// inertial, m.
    pub fn base_position<T: Scalar>(
        &self,
        attitude: &Quaternion<T>,
        q: &[T],
        center: &Vector3<T>,
    ) -> Vector3<T> {
        difference(center, &attitude.to_inertial(&self.center_of_mass(q)))
    }

    /// Velocity of the body-frame origin at which the system's centre of mass moves at
    /// `center_velocity`, both inertial, m/s, for a base turning at `omega` (body axes, rad/s).
    pub fn base_velocity<T: Scalar>(
        &self,
        attitude: &Quaternion<T>,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
        center_velocity: &Vector3<T>,
    ) -> Vector3<T> {
        let relative = self.over_mass(&self.momentum_beyond_base(omega, q, qdot));
        difference(center_velocity, &attitude.to_inertial(&relative))
    }

    /// Σ m (ω × r + r'), body axes: linear momentum relative to the body-frame origin.
    fn momentum_beyond_base<T: Scalar>(
        &self,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
    ) -> Vector3<T> {
        let Composite { first, relative, axes, .. } = self.composite(q, qdot);
        axes.to_body(&sum(&cross(&axes.to_sweep(omega), &first), &relative.linear))
    }

    fn composite<T: Scalar>(&self, q: &[T], qdot: &[T]) -> Composite<T> {
        self.assert_joint_slice(q);
        self.assert_joint_slice(qdot);
        Composite::new(&self.tree, q, qdot)
    }

    fn composite_at_rest<T: Scalar>(&self, q: &[T]) -> Composite<T> {
        self.composite(q, &vec![T::from(0.0); q.len()])
    }

    fn over_mass<T: Scalar>(&self, moment: &Vector3<T>) -> Vector3<T> {
        moment.map(|entry| entry * self.total_mass().recip())
    }
}
