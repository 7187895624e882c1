//! The full form: how the base accelerates when the joints do.
//!
//! Both conservation laws come from one sweep outward, for the angular rates, and one inward, for
//! the force and moment that the moving arm would need if the base did not accelerate. The base
//! then accelerates so that both vanish:
//!
//! ```text
//! Ĩ ω̇ + N = 0,        M r̈₀ + f + ω̇ × F = 0
//! ```
//!
//! N, the moment about the system's centre of mass, is dH/dt + ω × H of DESIGN's equations without
//! its ω̇; where a couple acts from outside, it stands in the place of the first zero. Forces obey the
//! recursion of [`Coupling`](crate::coupling::Coupling) as momenta do:
//!
//! ```text
//! f' = f + g̈,         N' = N + b × f + F × b̈ + (C's own moment)
//! ```

use crate::algebra::{
    PlaneRotation, combination, constant_matrix_product, constant_rotation, cross, difference,
    offset_by, plus_multiple, sum, zero,
};
use crate::branches::{Beyond, Branches};
use crate::composite::SweepAxes;
use crate::coupling::Coupling;
use crate::external::External;
use crate::inertia::inertia;
use crate::sweep::{SweepRotations, TurnedCoupling};
use crate::system::System;
use crate::tree::Tree;
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// Acceleration of the base, in body axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseAcceleration<T> {
    /// ω̇, rad/s².
    pub angular: Vector3<T>,
    /// Inertial acceleration r̈₀ of the body-frame origin, in body axes, m/s².
    pub linear: Vector3<T>,
}

/// Angular rate and acceleration of a frame, in its own axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spin<T> {
    pub rate: Vector3<T>,
    pub acceleration: Vector3<T>,
}

impl<T: Scalar> Spin<T> {
    /// Of a frame that turns about z of this one at `rate`, seen in the axes of this one.
    pub fn plus_turning(&self, rate: T, acceleration: T) -> Self {
        let (w, a) = (&self.rate, &self.acceleration);
        Self {
            rate: Vector3::new(w.x, w.y, w.z + rate),
            acceleration: Vector3::new(a.x + w.y * rate, a.y - w.x * rate, a.z + acceleration),
        }
    }

    pub fn turned_back(&self, rotation: &PlaneRotation<T>) -> Self {
        Self {
            rate: rotation.turn_back(&self.rate),
            acceleration: rotation.turn_back(&self.acceleration),
        }
    }

    pub fn rotated_back(&self, rotation: &Matrix3<f64>) -> Self {
        let back = rotation.transpose();
        Self {
            rate: constant_rotation(&back, &self.rate),
            acceleration: constant_rotation(&back, &self.acceleration),
        }
    }

    /// Columns of [α]× + [ω]×[ω]×, which takes a vector fixed in the frame to its acceleration.
    pub fn columns(&self) -> [Vector3<T>; 3] {
        let (w, a) = (&self.rate, &self.acceleration);
        let (xx, yy, zz) = (w.x * w.x, w.y * w.y, w.z * w.z);
        let (xy, xz, yz) = (w.x * w.y, w.x * w.z, w.y * w.z);
        [
            Vector3::new(-(yy + zz), xy + a.z, xz - a.y),
            Vector3::new(xy - a.z, -(xx + zz), yz + a.x),
            Vector3::new(xz + a.y, yz - a.x, -(xx + yy)),
        ]
    }

    /// α × c + ω × (ω × c) of a vector fixed in the frame.
    pub fn acceleration_of(&self, c: &Vector3<f64>) -> Vector3<T> {
        let [x, y, z] = self.columns();
        Vector3::from_fn(|i, _| combination([(c.x, x[i]), (c.y, y[i]), (c.z, z[i])]))
    }

    /// The same for a vector whose z component is the constant `along`.
    fn acceleration_of_turned(&self, v: &Vector3<T>, along: f64) -> Vector3<T> {
        let [x, y, z] = self.columns();
        Vector3::from_fn(|i, _| plus_multiple(x[i] * v.x + y[i] * v.y, along, z[i]))
    }

    /// J α + ω × J ω: the moment that an inertia fixed in the frame takes.
    pub fn moment_of(&self, inertia: &Matrix3<f64>) -> Vector3<T> {
        let momentum = constant_matrix_product(inertia, &self.rate);
        let steady = cross(&self.rate, &momentum);
        sum(&constant_matrix_product(inertia, &self.acceleration), &steady)
    }
}

/// The pair is f and N.
impl<T: Scalar> Beyond<T> {
    /// Takes in a coupling that moves with the frame in whose axes all is: the body of the last joint of a
    /// group, in the axes of K.
    fn coupled(self, coupling: &Coupling, spin: &Spin<T>) -> Self {
        let arm = spin.acceleration_of(&coupling.arm);
        let first = match coupling.first_over_arm {
            Some(ratio) => arm.map(|entry| entry * ratio),
            None => spin.acceleration_of(&coupling.first),
        };
        let doubled = coupling.half * 2.0;
        let mut load = self.pair.shifted(&coupling.arm);
        load.angular = sum(&load.angular, &cross(&offset_by(&self.moments.first, &doubled), &arm));
        if let Some(rest) = &coupling.rest {
            load.angular = sum(&load.angular, &spin.moment_of(&inertia(rest)));
        }
        load.linear = sum(&load.linear, &first);
        Self { moments: self.moments.coupled(coupling), pair: load }
    }

    /// The same for another joint of the group, in the axes in which the group turns.
    fn coupled_turned(
        self,
        coupling: &Coupling,
        spin: &Spin<T>,
        rotation: &PlaneRotation<T>,
    ) -> Self {
        let turned = TurnedCoupling::new(coupling, rotation);
        let arm = spin.acceleration_of_turned(&turned.arm, turned.along);
        let first = match coupling.first_over_arm {
            Some(ratio) => arm.map(|entry| entry * ratio),
            None => spin.acceleration_of_turned(&turned.first, coupling.first.z),
        };
        let doubled = rotation.turn_constant(&(coupling.half * 2.0));
        let mut load = self.pair.shifted_turned(&turned);
        load.angular = sum(&load.angular, &cross(&sum(&self.moments.first, &doubled), &arm));
        if let Some(rest) = &coupling.rest {
            let own = spin.turned_back(rotation).moment_of(&inertia(rest));
            load.angular = sum(&load.angular, &rotation.turn(&own));
        }
        load.linear = sum(&load.linear, &first);
        Self { moments: self.moments.coupled_turned(coupling, &turned, rotation), pair: load }
    }
}

/// Spins of a joint's frame: in the axes in which its group turns, and, for the last joint of a
/// group, in the axes of K too.
struct Spins<T> {
    in_group: Spin<T>,
    in_joint: Option<Spin<T>>,
}

fn outward<T: Scalar>(
    tree: &Tree,
    rotations: &[PlaneRotation<T>],
    omega: &Vector3<T>,
    qdot: &[T],
    qddot: &[T],
) -> Vec<Spins<T>> {
    let body = Spin { rate: *omega, acceleration: zero() };
    let mut group = body;
    let (mut rate, mut acceleration) = (T::from(0.0), T::from(0.0));
    let mut spins: Vec<Spins<T>> = Vec::with_capacity(tree.joints.len());
    for (k, joint) in tree.joints.iter().enumerate() {
        if let Some(branch) = &joint.branch {
            group = joint_spin(&spins, joint.parent).unwrap_or(body).rotated_back(&branch.rotation);
        }
        if tree.continues_group(k) {
            rate += qdot[joint.coordinate];
            acceleration += qddot[joint.coordinate];
        } else {
            rate = joint.turning(qdot[joint.coordinate]);
            acceleration = joint.turning(qddot[joint.coordinate]);
        }
        let in_group = group.plus_turning(rate, acceleration);
        let mut in_joint = None;
        if !tree.continues_group(k + 1) {
            let spin = in_group.turned_back(&rotations[k]);
            group = spin.rotated_back(&joint.twist.about_x());
            in_joint = Some(spin);
        }
        spins.push(Spins { in_group, in_joint });
    }
    spins
}

/// The spin of K of a joint at which a branch begins; none for the base.
fn joint_spin<T: Scalar>(spins: &[Spins<T>], joint: Option<usize>) -> Option<Spin<T>> {
    joint.and_then(|joint| spins[joint].in_joint)
}

impl System {
    /// ω̇ and r̈₀ of the free-floating base turning at `omega` (body axes, rad/s) while its joints
    /// are at `q`, `qdot`, `qddot` (j each; rad, rad/s, rad/s², or m, m/s, m/s²). Nothing acts from outside but
    /// `external`.
    ///
    /// # Panics
    /// A slice does not have one value a joint.
    pub fn base_acceleration<T: Scalar>(
        &self,
        omega: &Vector3<T>,
        q: &[T],
        qdot: &[T],
        qddot: &[T],
        external: Option<&External<T>>,
    ) -> BaseAcceleration<T> {
        self.assert_joint_slice(q);
        self.assert_joint_slice(qdot);
        self.assert_joint_slice(qddot);
        let tree = &self.tree;
        let SweepRotations { joints: rotations, last } = SweepRotations::new(tree, q);
        let axes = SweepAxes::new(tree, last);
        let omega = axes.to_sweep(omega);
        let spins = outward(tree, &rotations, &omega, qdot, qddot);
        let steady = Spin { rate: omega, acceleration: zero() };
        let mut branches = Branches::of(tree);
        let mut beyond = Beyond::nothing();
        for (k, joint) in tree.joints.iter().enumerate().rev() {
            let (coupling, rotation) = (&joint.coupling, &rotations[k]);
            beyond = match &spins[k].in_joint {
                None => beyond.coupled_turned(coupling, &spins[k].in_group, rotation),
                Some(spin) => {
                    let onward = beyond.twisted(joint.twist).coupled(coupling, spin);
                    branches.join(Some(k), onward).turned(rotation)
                }
            };
            if let Some(slide) = &joint.slide {
                let motion = [q, qdot, qddot].map(|of| of[joint.coordinate]);
                beyond = slide.loads(beyond, &spins[k].in_group, motion);
            }
            if let Some(branch) = &joint.branch {
                let spin = joint_spin(&spins, joint.parent).unwrap_or(steady);
                let branching = beyond.rotated(&branch.rotation).coupled(&branch.coupling, &spin);
                branches.hand_over(joint.parent, branching);
                beyond = Beyond::nothing();
            }
        }

        let Beyond { moments, pair: load } = branches.join(None, beyond);
        let root = &tree.root;
        let mut load = load.shifted(&root.across);
        if root.across.amax() > 0.0 {
            let swing = steady.acceleration_of(&root.across);
            load.angular = sum(&load.angular, &cross(&moments.first, &swing));
        }
        let own = cross(&omega, &constant_matrix_product(&inertia(&root.second), &omega));
        let moment = sum(&load.angular, &own);
        let missing = match external {
            None => moment.map(|entry| -entry),
            Some(external) => {
                let given = axes.to_sweep(&self.external_moment(external, q));
                difference(&given, &moment)
            }
        };
        let angular = moments.with_base(tree).inertia().solve(&missing);

        let first = offset_by(&moments.first, &root.first);
        let steady_force = sum(&load.linear, &steady.acceleration_of(&root.first));
        let force = sum(&steady_force, &cross(&angular, &first));
        let linear = force.map(|entry| entry * -self.total_mass().recip());
        BaseAcceleration { angular: axes.to_body(&angular), linear: axes.to_body(&linear) }
    }
}
