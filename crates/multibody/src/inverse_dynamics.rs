//! Joint torques and kinetic energy, by Newton's and Euler's equations link by link.
//!
//! Nothing is shared with the barycentric recursions of the momenta and of the forward dynamics
//! but the chain's constants: each is a check of the other.

use crate::algebra::{
    PlaneRotation, constant, constant_cross, constant_matrix_product, constant_rotation, cross,
    dot, sum, zero,
};
use crate::dynamics::{BaseAcceleration, Spin};
use crate::inertia::{MassMoments, inertia};
use crate::state::State;
use crate::sweep::{Pair, joint_rotations};
use crate::system::System;
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// What it takes to move the system in a given way.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseDynamics<T> {
    /// Torque of each joint's motor on its outboard link about the joint's axis (j), N m.
    pub joint_torques: Vec<T>,
    /// What the base and the arm do to each other at the mount.
    pub mount: MountLoad<T>,
    /// Force from outside on the base, body axes, N: zero for a free-floating motion.
    pub base_force: Vector3<T>,
    /// Moment from outside on the base about the body-frame origin, body axes, N m: zero for a
    /// free-floating motion.
    pub base_moment: Vector3<T>,
}

/// What the base does to all that lies beyond the mount, body axes; the arm does the opposite to the base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MountLoad<T> {
    /// Force, N.
    pub force: Vector3<T>,
    /// Moment about the mount, N m.
    pub moment: Vector3<T>,
}

/// Motion of a frame: its spin, and velocity or acceleration of its origin, in its own axes.
#[derive(Clone, Copy)]
struct Motion<T> {
    spin: Spin<T>,
    origin: Vector3<T>,
}

impl<T: Scalar> Motion<T> {
    fn rotated_back(&self, rotation: &Matrix3<f64>) -> Self {
        Self {
            spin: self.spin.rotated_back(rotation),
            origin: constant_rotation(&rotation.transpose(), &self.origin),
        }
    }

    fn turned(&self, rotation: &PlaneRotation<T>, rate: T, acceleration: T) -> Self {
        Self {
            spin: self.spin.plus_turning(rate, acceleration).turned_back(rotation),
            origin: rotation.turn_back(&self.origin),
        }
    }

    /// Force and moment about the frame's origin that accelerate a body fixed in the frame.
    fn load_of(&self, body: &MassMoments) -> Pair<T> {
        let swing = self.spin.acceleration_of(&body.first);
        Pair {
            linear: sum(&self.origin.map(|entry| entry * body.mass), &swing),
            angular: sum(
                &self.spin.moment_of(&inertia(&body.second)),
                &constant_cross(&body.first, &self.origin),
            ),
        }
    }

    /// Kinetic energy of a body fixed in the frame, the origin's motion being its velocity.
    fn energy_of(&self, body: &MassMoments) -> T {
        let Self { spin: Spin { rate, .. }, origin } = self;
        let first = constant_cross(&body.first, origin);
        let own = constant_matrix_product(&inertia(&body.second), rate).map(|entry| entry * 0.5);
        dot(origin, origin) * (0.5 * body.mass) + dot(rate, &sum(&first, &own))
    }
}

impl System {
    /// The torques and the load from outside for which the base accelerates as given, turning at
    /// `omega` (body axes, rad/s), with joints at `q`, `qdot`, `qddot` (j each).
    ///
    /// # Panics
    /// A slice does not have one value a joint.
    pub fn inverse_dynamics<T: Scalar>(
        &self,
        base: &BaseAcceleration<T>,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
        qddot: &[T],
    ) -> InverseDynamics<T> {
        self.assert_joint_slice(q);
        self.assert_joint_slice(qdot);
        self.assert_joint_slice(qddot);
        let chain = &self.chain;
        let body =
            Motion { spin: Spin { rate: *omega, acceleration: base.angular }, origin: base.linear };
        let rotations = joint_rotations(chain, q);
        let mut motion = Motion {
            origin: sum(&body.origin, &body.spin.acceleration_of(&chain.root_position)),
            ..body
        }
        .rotated_back(&chain.root_rotation);
        let mut loads = Vec::with_capacity(q.len());
        for (k, joint) in chain.joints.iter().enumerate() {
            motion = motion.turned(&rotations[k], qdot[k], qddot[k]);
            loads.push(motion.load_of(&joint.body));
            let next = sum(&motion.origin, &motion.spin.acceleration_of(&joint.offset));
            motion = Motion { origin: next, ..motion }.rotated_back(&joint.twist.about_x());
        }

        let mut joint_torques = vec![T::from(0.0); q.len()];
        let mut beyond = Pair::zero();
        for (k, joint) in chain.joints.iter().enumerate().rev() {
            let carried = beyond.twisted(joint.twist).shifted(&joint.offset);
            let load = carried.plus(&loads[k]);
            joint_torques[k] = load.angular.z;
            beyond = load.turned(&rotations[k]);
        }
        let rotation = &chain.root_rotation;
        let carried = Pair {
            linear: constant_rotation(rotation, &beyond.linear),
            angular: constant_rotation(rotation, &beyond.angular),
        };
        let about_base = carried.shifted(&chain.root_position);
        let total = about_base.plus(&body.load_of(&chain.base));
        let mut mount = carried.shifted(&(chain.root_position - self.mount().position_m));
        if chain.foot.mass > 0.0 {
            let foot = body.load_of(&chain.foot).shifted(&-self.mount().position_m);
            mount = mount.plus(&foot);
        }
        InverseDynamics {
            joint_torques,
            mount: MountLoad { force: mount.linear, moment: mount.angular },
            base_force: total.linear,
            base_moment: total.angular,
        }
    }

    /// Joint torques (j, N m) of the free-floating system turning at `omega` (body axes, rad/s)
    /// with joints at `q`, `qdot`, `qddot` (j each; rad, rad/s, rad/s²).
    pub fn joint_torques<T: Scalar>(
        &self,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
        qddot: &[T],
    ) -> Vec<T> {
        let base = self.base_acceleration(omega, q, qdot, qddot);
        self.inverse_dynamics(&base, omega, q, qdot, qddot).joint_torques
    }

    /// Kinetic energy in inertial axes, J.
    ///
    /// # Panics
    /// The state is not one of this system's.
    pub fn kinetic_energy<T: Scalar>(&self, state: &State<T>) -> T {
        self.assert_joint_slice(&state.joint_angles);
        self.assert_joint_slice(&state.joint_rates);
        let chain = &self.chain;
        let still = T::from(0.0);
        let body = Motion {
            spin: Spin { rate: state.angular_rate, acceleration: zero() },
            origin: state.attitude.to_body(&state.velocity),
        };
        let rotations = joint_rotations(chain, &state.joint_angles);
        let swing = |motion: &Motion<T>, position: &Vector3<f64>| {
            sum(&motion.origin, &cross(&motion.spin.rate, &constant(position)))
        };
        let mut energy = body.energy_of(&chain.base);
        let mut motion = Motion { origin: swing(&body, &chain.root_position), ..body }
            .rotated_back(&chain.root_rotation);
        for (k, joint) in chain.joints.iter().enumerate() {
            motion = motion.turned(&rotations[k], state.joint_rates[k], still);
            energy += motion.energy_of(&joint.body);
            motion = Motion { origin: swing(&motion, &joint.offset), ..motion }
                .rotated_back(&joint.twist.about_x());
        }
        energy
    }
}
