//! Momenta of base and arm, and the rate of the base that a given momentum leaves it.
//!
//! One sweep from the tip inward carries, for all that lies beyond a joint, its first and second
//! moments and the momenta due to the joint rates, relative to the body frame and counted from the
//! system's centre of mass (see [`Coupling`](crate::chain::Coupling)). Neighbouring joints with
//! parallel axes share one frame.

use crate::algebra::{
    PlaneRotation, constant, constant_cross, constant_rotation, cross, difference, offset_by,
    plus_multiple, sum, zero,
};
use crate::attitude::Quaternion;
use crate::chain::{Chain, Coupling, Turn};
use crate::kinematics::{Frame, group_rotations, joint_frames};
use crate::state::State;
use crate::symmetric::Symmetric;
use crate::system::System;
use nalgebra::{Matrix3, Matrix3xX, Vector3};
use righting_scalar::Scalar;

/// First and barycentric second moment of what lies beyond a joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moments<T> {
    pub first: Vector3<T>,
    pub second: Symmetric<T>,
}

/// Linear and barycentric angular momentum, or force and moment, of what lies beyond a joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair<T> {
    pub linear: Vector3<T>,
    pub angular: Vector3<T>,
}

/// The constants of a joint's [`Coupling`] seen from the frame in which its group turns.
pub(crate) struct TurnedArm<T> {
    pub arm: Vector3<T>,
    pub first: Vector3<T>,
    pub half: Vector3<T>,
}

impl<T: Scalar> TurnedArm<T> {
    pub fn new(coupling: &Coupling, rotation: &PlaneRotation<T>) -> Self {
        Self {
            arm: rotation.turn_constant(&coupling.arm),
            first: rotation.turn_constant(&coupling.first),
            half: rotation.turn_constant(&coupling.half),
        }
    }
}

impl<T: Scalar> Moments<T> {
    pub fn zero() -> Self {
        Self { first: zero(), second: Symmetric::zero() }
    }

    pub fn twisted(self, twist: Turn) -> Self {
        if twist.is_none() {
            return self;
        }
        let matrix = twist.about_x();
        Self {
            first: constant_rotation(&matrix, &self.first),
            second: self.second.rotated(&matrix),
        }
    }

    pub fn turned(self, rotation: &PlaneRotation<T>) -> Self {
        Self { first: rotation.turn(&self.first), second: self.second.turned(rotation) }
    }

    /// Moves to the joint's origin and takes in its body, in the axes of K.
    pub fn coupled(self, coupling: &Coupling) -> Self {
        let middle = offset_by(&self.first, &coupling.half);
        let mut second = self.second.plus_product_constant(&middle, &coupling.arm);
        if let Some(rest) = &coupling.rest {
            second = second.plus_constant(rest);
        }
        Self { first: offset_by(&self.first, &coupling.first), second }
    }

    /// The same in the axes in which the joint's group turns.
    pub fn coupled_turned(
        self,
        coupling: &Coupling,
        turned: &TurnedArm<T>,
        rotation: &PlaneRotation<T>,
    ) -> Self {
        let middle = sum(&self.first, &turned.half);
        let mut second = self.second.plus_product(&middle, &turned.arm, coupling.arm.z);
        if let Some(rest) = &coupling.rest {
            second = second.plus_matrix(&Symmetric::constant(rest).turned(rotation));
        }
        Self { first: sum(&self.first, &turned.first), second }
    }
}

impl<T: Scalar> Pair<T> {
    pub fn zero() -> Self {
        Self { linear: zero(), angular: zero() }
    }

    pub fn twisted(self, twist: Turn) -> Self {
        if twist.is_none() {
            return self;
        }
        let matrix = twist.about_x();
        Self {
            linear: constant_rotation(&matrix, &self.linear),
            angular: constant_rotation(&matrix, &self.angular),
        }
    }

    pub fn turned(self, rotation: &PlaneRotation<T>) -> Self {
        Self { linear: rotation.turn(&self.linear), angular: rotation.turn(&self.angular) }
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self {
            linear: sum(&self.linear, &other.linear),
            angular: sum(&self.angular, &other.angular),
        }
    }

    /// Counts the angular part about a point from which this one lies at `arm`.
    pub fn shifted(self, arm: &Vector3<f64>) -> Self {
        Self {
            linear: self.linear,
            angular: sum(&self.angular, &constant_cross(arm, &self.linear)),
        }
    }

    /// The same for an arm whose z component is the constant `along`.
    pub fn shifted_turned(self, arm: &Vector3<T>, along: f64) -> Self {
        let Self { linear, angular } = self;
        let moment = Vector3::new(
            plus_multiple(arm.y * linear.z, -along, linear.y),
            plus_multiple(-(arm.x * linear.z), along, linear.x),
            arm.x * linear.y - arm.y * linear.x,
        );
        Self { linear, angular: sum(&angular, &moment) }
    }

    /// Adds the momenta of `moments` turning about z at `rate`.
    fn plus_turning(self, moments: &Moments<T>, rate: T) -> Self {
        let Moments { first, second } = moments;
        let Self { linear, angular } = self;
        Self {
            linear: Vector3::new(linear.x - first.y * rate, linear.y + first.x * rate, linear.z),
            angular: Vector3::new(
                angular.x - second.xz * rate,
                angular.y - second.yz * rate,
                angular.z + (second.xx + second.yy) * rate,
            ),
        }
    }
}

/// Everything linear in the rates at one configuration, in body axes.
struct Composite<T> {
    /// Ĩ, kg m².
    inertia: Symmetric<T>,
    /// Σ m r from the body-frame origin, kg m.
    first: Vector3<T>,
    /// H̃ and Σ m r', N m s and N s.
    relative: Pair<T>,
}

impl<T: Scalar> Composite<T> {
    fn new(chain: &Chain, q: &[T], qdot: &[T]) -> Self {
        let rotations = group_rotations(chain, q);
        let mut moments = Moments::zero();
        let mut relative = Pair::zero();
        for (k, joint) in chain.joints.iter().enumerate().rev() {
            let rotation = &rotations[k];
            let coupling = &joint.coupling;
            if chain.continues_group(k + 1) {
                let turned = TurnedArm::new(coupling, rotation);
                moments = moments.coupled_turned(coupling, &turned, rotation);
                relative = relative.shifted_turned(&turned.arm, coupling.arm.z);
            } else {
                moments = moments.twisted(joint.twist).coupled(coupling).turned(rotation);
                relative = relative.twisted(joint.twist).shifted(&coupling.arm).turned(rotation);
            }
            relative = relative.plus_turning(&moments, qdot[k]);
        }
        let across = &chain.root.across;
        let second = moments.second.plus_product_constant(&moments.first, across);
        let relative = relative.shifted(across);
        let rotation = &chain.root_rotation;
        let second = second.rotated(rotation).plus_constant(&chain.root.second);
        Self {
            inertia: second.inertia(),
            first: offset_by(&constant_rotation(rotation, &moments.first), &chain.root.first),
            relative: Pair {
                linear: constant_rotation(rotation, &relative.linear),
                angular: constant_rotation(rotation, &relative.angular),
            },
        }
    }
}

/// Ĩ(q) and B(q) of the angular momentum H = Ĩ ω + B q̇ about the system's centre of mass, body axes.
#[derive(Debug, Clone, PartialEq)]
pub struct MomentumMap<T> {
    /// Ĩ, symmetric positive definite, kg m².
    pub inertia: Matrix3<T>,
    /// B, one column a joint (3×j), kg m².
    pub joint_columns: Matrix3xX<T>,
}

impl System {
    /// Ĩ(q), the inertia of the whole system with its joints held, about its centre of mass, body
    /// axes (3×3), kg m².
    pub fn locked_inertia<T: Scalar>(&self, q: &[T]) -> Matrix3<T> {
        self.composite_at_rest(q).inertia.to_matrix()
    }

    /// H̃(q, q̇), the angular momentum about the system's centre of mass of the arm's motion relative
    /// to the base, body axes, N m s.
    pub fn h_tilde<T: Scalar>(&self, q: &[T], qdot: &[T]) -> Vector3<T> {
        self.composite(q, qdot).relative.angular
    }

    /// H = Ĩ ω + H̃, the angular momentum about the system's centre of mass, body axes, N m s, for a
    /// base turning at `omega` (body axes, rad/s).
    pub fn angular_momentum<T: Scalar>(
        &self,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
    ) -> Vector3<T> {
        let composite = self.composite(q, qdot);
        sum(&composite.inertia.times(omega), &composite.relative.angular)
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
        let composite = self.composite(q, qdot);
        composite.inertia.solve(&difference(h_body, &composite.relative.angular))
    }

    /// The system's centre of mass from the body-frame origin, body axes, m.
    pub fn center_of_mass<T: Scalar>(&self, q: &[T]) -> Vector3<T> {
        self.composite_at_rest(q).first.map(|entry| entry * self.total_mass().recip())
    }

    /// The velocity of the system's centre of mass relative to the body frame, body axes, m/s.
    pub fn center_of_mass_rate<T: Scalar>(&self, q: &[T], qdot: &[T]) -> Vector3<T> {
        self.composite(q, qdot).relative.linear.map(|entry| entry * self.total_mass().recip())
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
    /// `center_velocity`, both inertial, m/s.
    pub fn base_velocity<T: Scalar>(
        &self,
        attitude: &Quaternion<T>,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
        center_velocity: &Vector3<T>,
    ) -> Vector3<T> {
        let relative = self
            .momentum_beyond_base(omega, q, qdot)
            .map(|entry| entry * self.total_mass().recip());
        difference(center_velocity, &attitude.to_inertial(&relative))
    }

    /// Ĩ(q) and the columns of B(q) with H̃ = B q̇.
    ///
    /// Works in body axes throughout: column k is what all that lies beyond joint k, turning as one
    /// body about that joint, adds to the angular momentum.
    pub fn momentum_map<T: Scalar>(&self, q: &[T]) -> MomentumMap<T> {
        self.assert_joint_slice(q);
        let chain = &self.chain;
        let frames = joint_frames(chain, &group_rotations(chain, q));
        let in_body_axes =
            |k: usize, c: &Vector3<f64>| Frame { origin: zero(), axes: frames[k].axes }.point(c);
        let arms: Vec<Vector3<T>> =
            (0..frames.len()).map(|k| in_body_axes(k, &chain.joints[k].coupling.arm)).collect();
        // From the point that the momenta are counted about at joint k to the body frame's.
        let mut reach = constant_rotation(&chain.root_rotation, &constant(&chain.root.across));
        let mut reaches = Vec::with_capacity(frames.len());
        for arm in &arms {
            reaches.push(reach);
            reach = sum(&reach, arm);
        }

        let mut beyond = Moments::zero();
        let mut columns = vec![zero(); frames.len()];
        for (k, joint) in chain.joints.iter().enumerate().rev() {
            let coupling = &joint.coupling;
            let middle = sum(&beyond.first, &in_body_axes(k, &coupling.half));
            let mut second = beyond.second.plus_outer(&middle, &arms[k]);
            if let Some(rest) = &coupling.rest {
                second = second.plus_matrix(&Symmetric::constant(rest).rotated_by(&frames[k].axes));
            }
            let first = sum(&beyond.first, &in_body_axes(k, &coupling.first));
            beyond = Moments { first, second };
            let axis = &frames[k].axes[2];
            let spin = second.inertia().times(axis);
            columns[k] = sum(&spin, &cross(&reaches[k], &cross(axis, &first)));
        }
        let across = constant_rotation(&chain.root_rotation, &constant(&chain.root.across));
        let second =
            beyond.second.plus_outer(&beyond.first, &across).plus_constant(&chain.root.second);
        MomentumMap {
            inertia: second.inertia().to_matrix(),
            joint_columns: Matrix3xX::from_columns(&columns),
        }
    }

    fn composite<T: Scalar>(&self, q: &[T], qdot: &[T]) -> Composite<T> {
        self.assert_joint_slice(q);
        self.assert_joint_slice(qdot);
        Composite::new(&self.chain, q, qdot)
    }

    fn composite_at_rest<T: Scalar>(&self, q: &[T]) -> Composite<T> {
        self.composite(q, &vec![T::from(0.0); q.len()])
    }

    /// Σ m (ω × r + r'), body axes: linear momentum relative to the body-frame origin.
    fn momentum_beyond_base<T: Scalar>(
        &self,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
    ) -> Vector3<T> {
        let composite = self.composite(q, qdot);
        sum(&cross(omega, &composite.first), &composite.relative.linear)
    }
}
