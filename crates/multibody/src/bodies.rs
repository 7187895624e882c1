//! The system as rigid bodies on hinges, the form in which files of other programs describe one.
//!
//! Body k is everything that joint k moves and no joint beyond it does; its frame's z axis is the axis of
//! joint k. Where a row of parameters has its mass elsewhere (modified rows have it in the frame
//! before), it belongs to the body that it moves with; a payload belongs to the last body, and what
//! moves with no joint to the base.

use crate::inertia::{MassMoments, inertia};
use crate::jointed_body::JointKind;
use crate::system::System;
use crate::tree::{Carried, Tree, snapped};
use crate::turn::Turn;
use nalgebra::{Matrix3, Vector3};

/// Mass properties of a rigid body in its frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    /// Mass, kg; zero of a body that only joins two hinges.
    pub mass_kg: f64,
    /// Centre of mass in the body's frame, m.
    pub center_of_mass_m: Vector3<f64>,
    /// Inertia about the centre of mass, axes of the body's frame, kg m².
    pub inertia_kg_m2: Matrix3<f64>,
}

/// Where a frame sits in another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Its origin, m.
    pub position_m: Vector3<f64>,
    /// Turns its vectors into the other frame's.
    pub rotation: Matrix3<f64>,
}

/// A body on a hinge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HingedBody {
    /// Whether the hinge turns its body about its z axis or slides it along that.
    pub kind: JointKind,
    /// The body that carries it, by its joint; none for the base.
    pub parent: Option<usize>,
    /// Its frame at joint coordinate zero, in the frame of the body that carries it, the body frame for the
    /// base.
    pub placement: Placement,
    /// Its mass.
    pub body: RigidBody,
    /// Whether the hinge moves no inertia at all: everything beyond it is without mass or, where it turns, lies
    /// on its axis. Such a joint takes no torque and moves nothing.
    pub is_idle: bool,
}

impl System {
    /// The base with all that is fixed to it, in the body frame.
    pub fn base_body(&self) -> RigidBody {
        RigidBody::of(&self.tree.base)
    }

    /// The bodies that the joints move, one a joint, in the order of the joint coordinates.
    pub fn hinged_bodies(&self) -> Vec<HingedBody> {
        let tree = &self.tree;
        let idle = tree.idle_joints();
        let mut bodies: Vec<(usize, HingedBody)> = tree
            .joints
            .iter()
            .enumerate()
            .map(|(k, joint)| {
                let body = HingedBody {
                    kind: joint.kind,
                    parent: joint.parent.map(|parent| tree.joints[parent].coordinate),
                    placement: tree.start(k).turned(joint.angle),
                    body: RigidBody::of(&joint.body),
                    is_idle: idle[k],
                };
                (joint.coordinate, body)
            })
            .collect();
        bodies.sort_by_key(|(coordinate, _)| *coordinate);
        bodies.into_iter().map(|(_, body)| body).collect()
    }

    /// Frames (in the order of [`Kinematics::frames`](crate::Kinematics::frames)) as they are fixed to the
    /// hinged bodies: the joint, none for the base, and the place in the frame of its body.
    pub fn carried_frames(&self) -> Vec<(Option<usize>, Placement)> {
        let joint =
            |carried: &Carried| carried.joint.map(|joint| self.tree.joints[joint].coordinate);
        self.tree.frames.iter().map(|carried| (joint(carried), carried.placement)).collect()
    }
}

impl Tree {
    fn idle_joints(&self) -> Vec<bool> {
        /// Rounding of a mass that lies on an axis, relative to its second moment along it.
        const ROUNDING: f64 = 1e-14;
        let mut beyond: Vec<MassMoments> =
            self.joints.iter().map(|joint| joint.body.clone()).collect();
        let mut idle = vec![true; self.joints.len()];
        for (k, joint) in self.joints.iter().enumerate().rev() {
            let across = beyond[k].second[(0, 0)] + beyond[k].second[(1, 1)];
            let moves_nothing = match joint.kind {
                JointKind::Revolute => across <= ROUNDING * beyond[k].second.trace(),
                JointKind::Prismatic => beyond[k].mass == 0.0,
            };
            idle[k] = idle[k] && moves_nothing;
            if let Some(parent) = joint.parent {
                // What lies on a joint's axis lies there at any angle of that joint.
                let Placement { position_m, rotation } = self.start(k).turned(joint.angle);
                beyond[parent] = beyond[parent].joined(&beyond[k].placed(&rotation, &position_m));
                idle[parent] = idle[parent] && idle[k];
            }
        }
        idle
    }
}

impl Placement {
    /// The same frame.
    pub fn identity() -> Self {
        Self { position_m: Vector3::zeros(), rotation: Matrix3::identity() }
    }

    /// The frame turned about its z axis by `angle_rad`.
    pub fn turned_about_z(&self, angle_rad: f64) -> Self {
        self.turned(Turn::new(angle_rad))
    }

    /// The frame moved along its z axis by `travel_m`.
    pub fn moved_along_z(&self, travel_m: f64) -> Self {
        Self { position_m: self.position_m + self.rotation.column(2) * travel_m, ..*self }
    }

    /// Of a frame that sits at `inner` in this one, in the frame that this one sits in.
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            position_m: self.position_m + self.rotation * inner.position_m,
            rotation: self.rotation * inner.rotation,
        }
    }

    fn turned(&self, turn: Turn) -> Self {
        // Adding zero takes the sign off negative zeros.
        Self { rotation: (self.rotation * turn.about_z()).map(|entry| entry + 0.0), ..*self }
    }

    /// The rotation Rz(yaw) Ry(pitch) Rx(roll) of three angles about fixed axes, rad; right angles are exact.
    pub fn rotation_of_rpy(roll_rad: f64, pitch_rad: f64, yaw_rad: f64) -> Matrix3<f64> {
        let [roll, pitch, yaw] = [roll_rad, pitch_rad, yaw_rad].map(Turn::new);
        (yaw.about_z() * pitch.about_y() * roll.about_x()).map(snapped)
    }

    /// Without the rounding of entries that are 0 or, of a rotation, ±1.
    pub(crate) fn snapped(&self) -> Self {
        let rounding = 4.0 * f64::EPSILON * self.position_m.amax();
        Self {
            position_m: self
                .position_m
                .map(|entry| if entry.abs() > rounding { entry } else { 0.0 }),
            rotation: self.rotation.map(snapped),
        }
    }
}

impl RigidBody {
    /// This body and another that is fixed to it, whose frame sits at `placement` in this one's.
    pub fn joined(&self, other: &Self, placement: &Placement) -> Self {
        let Placement { position_m, rotation } = placement;
        Self::of(&self.moments().joined(&other.moments().placed(rotation, position_m)))
    }

    pub(crate) fn moments(&self) -> MassMoments {
        MassMoments::of_body(self.mass_kg, self.center_of_mass_m, &self.inertia_kg_m2)
    }

    fn of(moments: &MassMoments) -> Self {
        let MassMoments { mass, first, second } = moments;
        let center = if *mass > 0.0 { first / *mass } else { Vector3::zeros() };
        let scale = second.amax();
        // A slender rod's moment about itself is zero, not what rounding leaves of a difference.
        let about_center = (second - center * center.transpose() * *mass)
            .map(|entry| if entry.abs() <= 4.0 * f64::EPSILON * scale { 0.0 } else { entry });
        Self {
            mass_kg: *mass,
            center_of_mass_m: center,
            inertia_kg_m2: inertia(&about_center).map(|entry| entry + 0.0),
        }
    }
}
