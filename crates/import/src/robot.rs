//! A robot as its file describes it: links that joints connect to a tree.

use nalgebra::Vector3;
use righting_multibody::{Placement, RigidBody};

use crate::error::Place;
use crate::shape::Shape;

/// A robot whose links and joints form one tree. Immutable; SI units and radians.
#[derive(Clone, Debug)]
pub struct Robot {
    pub(crate) name: String,
    /// In the order of the file.
    pub(crate) links: Vec<Link>,
    /// In the order of the file.
    pub(crate) joints: Vec<Joint>,
    /// The link that is no joint's child.
    pub(crate) root: usize,
    /// What was assumed while it was read.
    pub(crate) notes: Vec<String>,
}

/// A rigid body of a robot.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub name: String,
    pub place: Place,
    /// Mass in the link's frame.
    pub body: RigidBody,
    /// What it occupies, in the link's frame.
    pub shapes: Vec<Shape>,
    /// The joint that it is the child of.
    pub parent_joint: Option<usize>,
    /// The joints that it is the parent of.
    pub child_joints: Vec<usize>,
}

/// What a joint allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum JointKind {
    /// Turns about its axis.
    Turning,
    /// Slides along its axis.
    Sliding,
    /// Nothing.
    Fixed,
    /// More than one coordinate.
    Loose,
}

/// A joint between two links. The child's frame is the joint's frame, turned about the axis or moved
/// along it.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    pub name: String,
    pub place: Place,
    pub kind: JointKind,
    /// Index of the link that it stands on.
    pub parent: usize,
    /// Index of the link that it moves.
    pub child: usize,
    /// The joint's frame in the parent's.
    pub placement: Placement,
    /// Unit vector in the joint's frame.
    pub axis: Vector3<f64>,
    pub limits: Limits,
    pub mimic: Option<Mimic>,
}

/// Limits of a joint, rad or m, rad/s or m/s, N m or N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limits {
    /// Smallest coordinate; −∞ for none.
    pub lower: f64,
    /// Largest coordinate; ∞ for none.
    pub upper: f64,
    /// Largest rate, where the file gives one.
    pub rate_max: Option<f64>,
    /// Largest effort; ∞ for none.
    pub effort_max: f64,
}

/// A joint's coordinate that follows from another's: multiplier · other + offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mimic {
    /// Index of the other joint.
    pub joint: usize,
    pub multiplier: f64,
    pub offset: f64,
}

impl Limits {
    /// Beyond any coordinate, rad (160 turns) or m.
    pub const FARTHEST: f64 = 1000.0;

    pub const NONE: Self = Self {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        rate_max: None,
        effort_max: f64::INFINITY,
    };
}

impl Robot {
    /// Name of the robot.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Name of the link that everything else hangs on.
    pub fn root(&self) -> &str {
        &self.links[self.root].name
    }

    /// Whether the joint of this name slides, so that its coordinate is a length; none if there is no
    /// such joint.
    pub fn is_sliding(&self, joint: &str) -> Option<bool> {
        let joint = self.joints.iter().find(|candidate| candidate.name == joint)?;
        Some(joint.kind == JointKind::Sliding)
    }
}
