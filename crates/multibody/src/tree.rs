//! The tree of joints in one form, however it was described, with its constants worked out.
//!
//! Joint k turns about the z axis of frame K(k), whose origin lies on the joint's axis, or slides K(k) along
//! it. Joints are in
//! depth-first order: each one goes on from the joint before it, or begins a branch at one farther in or
//! at the base. Between a joint and the one that goes on from it the frames differ by constants and one
//! angle:
//!
//! ```text
//! K(k+1) = K(k) · T(offset(k)) · Rx(twist(k)) · Rz(angle(k+1) + q(k+1))
//! ```
//!
//! Any rotation is Rz Rx Rz, and a rotation about z of either joint is no more than another place where
//! its angle is zero, so that this loses nothing. Where a branch begins, a joint has more than one to hand
//! its z axis to, and the rotation is a matrix. A joint that slides has its angle as a constant, and K(k) lies
//! q(k) along z from where it starts.

use crate::bodies::Placement;
use crate::coupling::{Barycentric, Coupling, RootCoupling};
use crate::error::{ModelError, Part};
use crate::inertia::MassMoments;
use crate::jointed_body::JointKind;
use crate::parts::Base;
use crate::slide::Slide;
use crate::turn::Turn;
use nalgebra::{Matrix3, Vector3};

/// Everything constant about the system.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tree {
    pub total_mass: f64,
    /// The base with all that is fixed to it, about the body-frame origin.
    pub base: MassMoments,
    /// What of that lies beyond the mount, about the body-frame origin.
    pub foot: MassMoments,
    /// Where the load between base and arm is counted about, from the body-frame origin.
    pub mount_position: Vector3<f64>,
    /// Turns vectors of the frame that joint 1 turns in into body axes; the identity where several joints
    /// are on the base.
    pub root_rotation: Matrix3<f64>,
    /// Origin of K(1), body axes; zero where several joints are on the base.
    pub root_position: Vector3<f64>,
    pub root: RootCoupling,
    pub joints: Vec<Joint>,
    /// The frames that are asked for.
    pub frames: Vec<Carried>,
    /// Centre of mass of each part: in K of a joint, or in body axes.
    pub centers: Vec<(Option<usize>, Vector3<f64>)>,
}

/// One joint with the rigid body that it moves.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Joint {
    /// Its place among the joint coordinates.
    pub coordinate: usize,
    /// What an error about it names.
    pub part: Part,
    /// What its coordinate is.
    pub kind: JointKind,
    /// How it slides; none where it turns.
    pub slide: Option<Slide>,
    /// The joint that carries this one; none on the base.
    pub parent: Option<usize>,
    /// Where it begins, if it does not go on from the joint before it.
    pub branch: Option<Branch>,
    /// Angle of K(k) where the joint coordinate is zero.
    pub angle: Turn,
    /// The rigid body that moves with this joint, about the origin and in the axes of K(k).
    pub body: MassMoments,
    /// From the origin of K(k) to that of K(k+1), or to the last origin.
    pub offset: Vector3<f64>,
    /// From the axes of K(k) to those in which the next joint turns, or the last frame's.
    pub twist: Turn,
    /// How it takes in its body and what goes on from it.
    pub coupling: Coupling,
}

/// The beginning of a branch.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Branch {
    /// Origin of K(k) in K of the parent, or in body axes.
    pub position: Vector3<f64>,
    /// Turns vectors of the frame that joint k turns in into the axes of K of the parent, or of the body.
    pub rotation: Matrix3<f64>,
    /// How the parent takes it in.
    pub coupling: Coupling,
}

/// A frame that a joint carries.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Carried {
    /// The joint; none for a frame of the base.
    pub joint: Option<usize>,
    /// Where it sits in K of the joint, or in the body frame.
    pub placement: Placement,
}

impl Tree {
    /// A base without joints.
    pub fn of_base(base: &Base) -> Self {
        Self {
            total_mass: 0.0,
            base: MassMoments::of_body(base.mass_kg, base.center_of_mass_m, &base.inertia_kg_m2),
            foot: MassMoments::zero(),
            mount_position: Vector3::zeros(),
            root_rotation: Matrix3::identity(),
            root_position: Vector3::zeros(),
            root: RootCoupling::none(),
            joints: Vec::new(),
            frames: Vec::new(),
            centers: Vec::new(),
        }
    }

    /// Works out the couplings.
    pub fn coupled(mut self) -> Result<Self, ModelError> {
        let beyond = self.masses();
        let on_base = self.joints.iter().zip(&beyond).filter(|(joint, _)| joint.parent.is_none());
        let moved: f64 = on_base.map(|(_, mass)| mass).sum();
        let total = self.base.mass + moved;
        self.total_mass = total;
        let is_single = self.joints.first().is_some_and(|joint| joint.branch.is_none());
        let on_axis = if is_single { moved } else { 0.0 };
        let base = Barycentric::new(&self.base, &self.root_position, on_axis, total);
        if !(base.is_finite() && total.is_finite()) {
            return Err(ModelError::Overflow { part: Part::Base });
        }
        let mut along = Vector3::zeros();
        if is_single && !self.has_branches(0) && !self.slides(0) {
            (self.root, along) = RootCoupling::new(&base, &self.root_rotation);
        } else {
            self.root = RootCoupling::whole(&base, &self.root_rotation);
        }
        for k in (0..self.joints.len()).rev() {
            let onward = if self.goes_on(k) { beyond[k + 1] } else { 0.0 };
            let joint = &mut self.joints[k];
            let constants = Barycentric::new(&joint.body, &joint.offset, onward, total);
            let constants = if k == 0 { constants.shifted(&along) } else { constants };
            let is_finite = constants.is_finite();
            let slides = joint.kind == JointKind::Prismatic;
            joint.slide = slides.then(|| Slide::new(beyond[k], total));
            joint.coupling = Coupling::new(constants);
            let overflow = ModelError::Overflow { part: joint.part };
            if !is_finite {
                return Err(overflow);
            }
            if let Some(branch) = &mut joint.branch {
                let nothing = MassMoments::zero();
                let shift = Barycentric::new(&nothing, &branch.position, beyond[k], total);
                if !shift.is_finite() {
                    return Err(overflow);
                }
                branch.coupling = Coupling::new(shift);
            }
        }
        Ok(self)
    }

    /// The mass that each joint carries, kg.
    fn masses(&self) -> Vec<f64> {
        let mut masses: Vec<f64> = self.joints.iter().map(|joint| joint.body.mass).collect();
        for (k, joint) in self.joints.iter().enumerate().rev() {
            if let Some(parent) = joint.parent {
                masses[parent] += masses[k];
            }
        }
        masses
    }

    /// Whether joint k+1 goes on from joint k.
    pub fn goes_on(&self, k: usize) -> bool {
        self.joints.get(k + 1).is_some_and(|next| next.branch.is_none())
    }

    /// Whether joint k slides.
    fn slides(&self, k: usize) -> bool {
        self.joints.get(k).is_some_and(|joint| joint.kind == JointKind::Prismatic)
    }

    /// Whether a branch begins at joint k.
    pub fn has_branches(&self, k: usize) -> bool {
        let is_branch = |joint: &Joint| joint.branch.is_some() && joint.parent == Some(k);
        self.joints.iter().any(is_branch)
    }

    /// Whether joint k turns about an axis parallel to that of joint k−1, which turns too and which it goes
    /// on from and nothing else does.
    pub fn continues_group(&self, k: usize) -> bool {
        let Some(before) = k.checked_sub(1) else { return false };
        self.goes_on(before)
            && self.joints[before].twist.is_none()
            && !self.has_branches(before)
            && !self.slides(before)
            && !self.slides(k)
    }

    /// The joints that carry joint k, from the base to itself; none for the base.
    pub fn path(&self, k: Option<usize>) -> Vec<usize> {
        let mut path: Vec<usize> =
            std::iter::successors(k, |&joint| self.joints[joint].parent).collect();
        path.reverse();
        path
    }

    /// Where the frame that joint k turns in sits in K of its parent, or in the body frame.
    pub fn start(&self, k: usize) -> Placement {
        let joint = &self.joints[k];
        match (&joint.branch, joint.parent) {
            (Some(branch), _) => {
                Placement { position_m: branch.position, rotation: branch.rotation }
            }
            (None, Some(parent)) => self.joints[parent].outboard(),
            (None, None) => {
                Placement { position_m: self.root_position, rotation: self.root_rotation }
            }
        }
    }
}

impl Joint {
    /// The first joint on the base, or one that goes on from the joint before it, without a body.
    pub fn new(coordinate: usize, part: Part, angle: Turn) -> Self {
        Self {
            coordinate,
            part,
            kind: JointKind::Revolute,
            slide: None,
            parent: coordinate.checked_sub(1),
            branch: None,
            angle,
            body: MassMoments::zero(),
            offset: Vector3::zeros(),
            twist: Turn::NONE,
            coupling: Coupling::none(),
        }
    }

    /// The frame in which the joint that goes on from this one turns, or the last frame, in K.
    pub fn outboard(&self) -> Placement {
        Placement { position_m: self.offset, rotation: self.twist.about_x() }
    }
}

/// Rounding taken off the entries of a rotation matrix that are 0 or ±1.
pub(crate) fn snapped(entry: f64) -> f64 {
    let nearest = entry.round();
    if (entry - nearest).abs() < 1e-15 { nearest + 0.0 } else { entry }
}
