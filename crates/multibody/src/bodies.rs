//! The system as rigid bodies on hinges, the form in which files of other programs describe one.
//!
//! Body k is everything that joint k turns and joint k+1 does not; its frame's z axis is the axis of
//! joint k. Where a row of parameters has its mass elsewhere (modified rows have it in the frame
//! before), it belongs to the body that it moves with; a payload belongs to the last body, and what
//! moves with no joint to the base.

use crate::chain::{Chain, Joint};
use crate::inertia::{MassMoments, inertia};
use crate::system::System;
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
    /// Its frame at joint angle zero, in the frame of the body before; of the first in the body frame
    /// of the base. The hinge turns it about its z axis.
    pub placement: Placement,
    /// Its mass.
    pub body: RigidBody,
    /// Whether the hinge turns no inertia at all: everything beyond it is without mass or lies on its
    /// axis. Such a joint takes no torque and moves nothing.
    pub is_idle: bool,
}

impl System {
    /// The base with all that is fixed to it, in the body frame.
    pub fn base_body(&self) -> RigidBody {
        RigidBody::of(&self.chain.base)
    }

    /// The bodies that the joints turn, from the base outward, one a joint.
    pub fn hinged_bodies(&self) -> Vec<HingedBody> {
        let chain = &self.chain;
        let placements = (0..chain.joints.len()).map(|k| chain.placement(k));
        let parts = chain.joints.iter().zip(chain.idle_joints());
        placements
            .zip(parts)
            .map(|(placement, (joint, is_idle))| HingedBody {
                placement,
                body: RigidBody::of(&joint.body),
                is_idle,
            })
            .collect()
    }

    /// The last frame, where a payload is held, in the frame of the last body.
    pub fn last_frame(&self) -> Placement {
        self.chain.joints.last().map_or(Placement::identity(), Joint::outboard)
    }
}

impl Chain {
    /// K(k) at joint angle zero in K(k−1), or in the body frame.
    fn placement(&self, k: usize) -> Placement {
        let before = match k.checked_sub(1) {
            Some(before) => self.joints[before].outboard(),
            None => Placement { position_m: self.root_position, rotation: self.root_rotation },
        };
        before.turned(self.joints[k].angle)
    }

    fn idle_joints(&self) -> Vec<bool> {
        /// Rounding of a mass that lies on an axis, relative to its second moment along it.
        const ROUNDING: f64 = 1e-14;
        let mut beyond = MassMoments::zero();
        let mut is_idle = true;
        let mut idle = vec![false; self.joints.len()];
        for (k, joint) in self.joints.iter().enumerate().rev() {
            // What lies on the next joint's axis lies there at any angle of that joint.
            let Placement { position_m, rotation } = joint.outboard();
            beyond = joint.body.joined(&beyond.placed(&rotation, &position_m));
            let across = beyond.second[(0, 0)] + beyond.second[(1, 1)];
            is_idle = is_idle && across <= ROUNDING * beyond.second.trace();
            idle[k] = is_idle;
        }
        idle
    }
}

impl Joint {
    /// The frame in which the next joint turns, or the last frame, in K.
    fn outboard(&self) -> Placement {
        Placement { position_m: self.offset, rotation: self.twist.about_x() }
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

    /// Of a frame that sits at `inner` in this one, in the frame that this one sits in.
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            position_m: self.position_m + self.rotation * inner.position_m,
            rotation: self.rotation * inner.rotation,
        }
    }

    fn turned(&self, turn: Turn) -> Self {
        let (sin, cos) = turn.sin_cos();
        let about_z = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        // Adding zero takes the sign off negative zeros.
        Self { rotation: (self.rotation * about_z).map(|entry| entry + 0.0), ..*self }
    }
}

impl RigidBody {
    /// This body and another that is fixed to it, whose frame sits at `placement` in this one's.
    pub fn joined(&self, other: &Self, placement: &Placement) -> Self {
        let Placement { position_m, rotation } = placement;
        Self::of(&self.moments().joined(&other.moments().placed(rotation, position_m)))
    }

    fn moments(&self) -> MassMoments {
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
