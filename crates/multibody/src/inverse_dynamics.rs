//! Joint torques and kinetic energy, by Newton's and Euler's equations link by link.
//!
//! Nothing is shared with the barycentric recursions of the momenta and of the forward dynamics
//! but the tree's constants: each is a check of the other.

use crate::algebra::{
    PlaneRotation, constant, constant_cross, constant_matrix_product, constant_rotation, cross,
    difference, dot, sum, zero,
};
use crate::bodies::Placement;
use crate::dynamics::{BaseAcceleration, Spin};
use crate::external::{External, GravityGradient};
use crate::inertia::{MassMoments, inertia};
use crate::slide::acceleration_along;
use crate::state::State;
use crate::sweep::{Pair, joint_rotations};
use crate::system::System;
use crate::tree::Joint;
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// What it takes to move the system in a given way.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseDynamics<T> {
    /// Torque of each joint's motor on its outboard link about the joint's axis (j), N m; force along it, N,
    /// where the joint slides.
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
/// A system of bodies has no mount: there it is to all bodies of the list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MountLoad<T> {
    /// Force, N.
    pub force: Vector3<T>,
    /// Moment about the mount, or about the body-frame origin where there is none, N m.
    pub moment: Vector3<T>,
}

/// Motion of a frame: its spin, and velocity or acceleration of its origin, in its own axes.
///
/// Where there is a gravity gradient, accelerations are those beyond the pull there: both are linear in the place.
#[derive(Clone, Copy)]
struct Motion<T> {
    spin: Spin<T>,
    origin: Vector3<T>,
    gravity_gradient: Option<GravityGradient<T>>,
}

impl<T: Scalar> Motion<T> {
    fn rotated_back(&self, rotation: &Matrix3<f64>) -> Self {
        Self {
            spin: self.spin.rotated_back(rotation),
            origin: constant_rotation(&rotation.transpose(), &self.origin),
            gravity_gradient: self.gravity_gradient.map(|gradient| gradient.rotated_back(rotation)),
        }
    }

    /// Of K, from that of the frame in which its joint turns or slides, whose origin accelerates.
    fn moved(&self, joint: &Joint, rotation: &PlaneRotation<T>, motion: [T; 3]) -> Self {
        let [_, rate, acceleration] = motion;
        let origin = match joint.slide {
            Some(_) => sum(&self.origin, &self.acceleration_along(motion)),
            None => self.origin,
        };
        self.turned(origin, joint, rotation, [rate, acceleration])
    }

    /// By how much more than the origin a point accelerates that moves along z.
    fn acceleration_along(&self, motion: [T; 3]) -> Vector3<T> {
        let swing = acceleration_along(&self.spin, motion);
        match &self.gravity_gradient {
            None => swing,
            Some(gradient) => {
                let along = Vector3::new(T::from(0.0), T::from(0.0), motion[0]);
                difference(&swing, &gradient.acceleration(&along))
            }
        }
    }

    /// The same, its origin's motion being a velocity.
    fn swept(&self, joint: &Joint, rotation: &PlaneRotation<T>, [q, rate]: [T; 2]) -> Self {
        let (at, spin) = (&self.origin, &self.spin.rate);
        let origin = match joint.slide {
            Some(_) => Vector3::new(at.x + spin.y * q, at.y - spin.x * q, at.z + rate),
            None => *at,
        };
        self.turned(origin, joint, rotation, [rate, T::from(0.0)])
    }

    fn turned(
        &self,
        origin: Vector3<T>,
        joint: &Joint,
        rotation: &PlaneRotation<T>,
        rates: [T; 2],
    ) -> Self {
        let [rate, acceleration] = rates.map(|rate| joint.turning(rate));
        Self {
            spin: self.spin.plus_turning(rate, acceleration).turned_back(rotation),
            origin: rotation.turn_back(&origin),
            gravity_gradient: self.gravity_gradient.map(|gradient| gradient.turned_back(rotation)),
        }
    }

    /// By how much more than the origin a point fixed in the frame accelerates, times a mass if the vector to
    /// it is.
    fn acceleration_of(&self, vector: &Vector3<f64>) -> Vector3<T> {
        let swing = self.spin.acceleration_of(vector);
        match &self.gravity_gradient {
            None => swing,
            Some(gradient) => difference(&swing, &gradient.acceleration(&constant(vector))),
        }
    }

    /// Force and moment about the frame's origin that accelerate a body fixed in the frame.
    fn load_of(&self, body: &MassMoments) -> Pair<T> {
        let swing = self.acceleration_of(&body.first);
        let inertia = inertia(&body.second);
        let mut own = self.spin.moment_of(&inertia);
        if let Some(gradient) = &self.gravity_gradient {
            let along = constant_matrix_product(&inertia, &gradient.nadir);
            own = difference(&own, &gradient.moment(&along));
        }
        Pair {
            linear: sum(&self.origin.map(|entry| entry * body.mass), &swing),
            angular: sum(&own, &constant_cross(&body.first, &self.origin)),
        }
    }

    /// Kinetic energy of a body fixed in the frame, the origin's motion being its velocity.
    fn energy_of(&self, body: &MassMoments) -> T {
        let Self { spin: Spin { rate, .. }, origin, .. } = self;
        let first = constant_cross(&body.first, origin);
        let own = constant_matrix_product(&inertia(&body.second), rate).map(|entry| entry * 0.5);
        dot(origin, origin) * (0.5 * body.mass) + dot(rate, &sum(&first, &own))
    }
}

impl System {
    /// The torques and the load from outside for which the base accelerates as given, turning at
    /// `omega` (body axes, rad/s), with joints at `q`, `qdot`, `qddot` (j each), while a gravity gradient pulls
    /// at all bodies if there is one.
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
        gravity_gradient: Option<GravityGradient<T>>,
    ) -> InverseDynamics<T> {
        self.assert_joint_slice(q);
        self.assert_joint_slice(qdot);
        self.assert_joint_slice(qddot);
        let tree = &self.tree;
        let mut body = Motion {
            spin: Spin { rate: *omega, acceleration: base.angular },
            origin: base.linear,
            gravity_gradient,
        };
        if let Some(gradient) = gravity_gradient {
            // The origin's place from the center of mass, the other way round.
            let pull = gradient.acceleration(&self.center_of_mass(q));
            body.origin = sum(&body.origin, &pull);
        }
        let rotations = joint_rotations(tree, q);
        let mut motions: Vec<Motion<T>> = Vec::with_capacity(q.len());
        let mut loads = Vec::with_capacity(q.len());
        for (k, joint) in tree.joints.iter().enumerate() {
            let Placement { position_m, rotation } = tree.start(k);
            let parent = joint.parent.map_or(body, |parent| motions[parent]);
            let next = sum(&parent.origin, &parent.acceleration_of(&position_m));
            let before = Motion { origin: next, ..parent }.rotated_back(&rotation);
            let at = joint.coordinate;
            let motion = before.moved(joint, &rotations[k], [q[at], qdot[at], qddot[at]]);
            loads.push(motion.load_of(&joint.body));
            motions.push(motion);
        }

        let mut joint_torques = vec![T::from(0.0); q.len()];
        let mut beyond: Option<Pair<T>> = None;
        for (k, joint) in tree.joints.iter().enumerate().rev() {
            let load = &loads[k];
            let at = joint.coordinate;
            joint_torques[at] = if joint.slide.is_some() { load.linear.z } else { load.angular.z };
            let Placement { position_m, rotation } = tree.start(k);
            let at_start = match joint.slide {
                Some(_) => load.turned(&rotations[k]).shifted_along(q[at]),
                None => load.turned(&rotations[k]),
            };
            let carried = at_start.rotated(&rotation);
            let about_parent = carried.shifted(&position_m);
            match joint.parent {
                Some(parent) => loads[parent] = about_parent.plus(&loads[parent]),
                None => {
                    let about_mount = carried.shifted(&(position_m - tree.mount_position));
                    let others = beyond.take();
                    beyond = Some(others.map_or(about_mount, |others| others.plus(&about_mount)));
                }
            }
        }
        let mut mount = beyond.unwrap_or_else(Pair::zero);
        let about_base = mount.shifted(&tree.mount_position);
        let total = about_base.plus(&body.load_of(&tree.base));
        if tree.foot.mass > 0.0 {
            let foot = body.load_of(&tree.foot).shifted(&-tree.mount_position);
            mount = mount.plus(&foot);
        }
        InverseDynamics {
            joint_torques,
            mount: MountLoad { force: mount.linear, moment: mount.angular },
            base_force: total.linear,
            base_moment: total.angular,
        }
    }

    /// Joint torques (j, N m; N where a joint slides) of the free-floating system turning at `omega` (body axes, rad/s)
    /// with joints at `q`, `qdot`, `qddot` (j each; rad, rad/s, rad/s²). Nothing acts from outside but `external`.
    pub fn joint_torques<T: Scalar>(
        &self,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
        qddot: &[T],
        external: Option<&External<T>>,
    ) -> Vec<T> {
        self.free_floating_dynamics(omega, q, qdot, qddot, external).joint_torques
    }

    /// [`inverse_dynamics`](Self::inverse_dynamics) of the free-floating system, whose base accelerates as it must.
    pub fn free_floating_dynamics<T: Scalar>(
        &self,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
        qddot: &[T],
        external: Option<&External<T>>,
    ) -> InverseDynamics<T> {
        let base = self.base_acceleration(omega, q, qdot, qddot, external);
        let gradient = external.and_then(|external| external.gravity_gradient);
        self.inverse_dynamics(&base, omega, q, qdot, qddot, gradient)
    }

    /// Kinetic energy in inertial axes, J.
    ///
    /// # Panics
    /// The state is not one of this system's.
    pub fn kinetic_energy<T: Scalar>(&self, state: &State<T>) -> T {
        self.assert_joint_slice(&state.joint_angles);
        self.assert_joint_slice(&state.joint_rates);
        let tree = &self.tree;
        let body = Motion {
            spin: Spin { rate: state.angular_rate, acceleration: zero() },
            origin: state.attitude.to_body(&state.velocity),
            gravity_gradient: None,
        };
        let rotations = joint_rotations(tree, &state.joint_angles);
        let swing = |motion: &Motion<T>, position: &Vector3<f64>| {
            sum(&motion.origin, &cross(&motion.spin.rate, &constant(position)))
        };
        let mut energy = body.energy_of(&tree.base);
        let mut motions: Vec<Motion<T>> = Vec::with_capacity(rotations.len());
        for (k, joint) in tree.joints.iter().enumerate() {
            let Placement { position_m, rotation } = tree.start(k);
            let parent = joint.parent.map_or(body, |parent| motions[parent]);
            let before = Motion { origin: swing(&parent, &position_m), ..parent };
            let [q, rate] =
                [&state.joint_angles, &state.joint_rates].map(|of| of[joint.coordinate]);
            let motion = before.rotated_back(&rotation).swept(joint, &rotations[k], [q, rate]);
            energy += motion.energy_of(&joint.body);
            motions.push(motion);
        }
        energy
    }
}
