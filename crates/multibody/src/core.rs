//! The straight segments that capsules are swept around, and which joint moves each.

use crate::algebra::constant;
use crate::distance::Segment;
use crate::jointed_body::JointKind;
use crate::kinematics::Kinematics;
use crate::parts::DhConvention;
use crate::system::System;
use crate::tree::{Carried, Joint};
use nalgebra::Vector3;
use righting_scalar::Scalar;

/// The core of a capsule on the arm: the straight segment that it is swept around. That of a sphere has no
/// length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Core {
    /// From the inboard origin to the outboard one of a link that a row describes; links counted from zero.
    Link(usize),
    /// Between two points that move with a frame.
    InFrame {
        /// The frame, in the order of [`Kinematics::frames`].
        frame: usize,
        /// One end in the frame's axes, m.
        from_m: Vector3<f64>,
        /// The other end, m.
        to_m: Vector3<f64>,
    },
}

impl Core {
    /// The same core with its lengths measured in another unit of so many meters.
    pub fn in_lengths_of(&self, length_m: f64) -> Self {
        match *self {
            Self::Link(link) => Self::Link(link),
            Self::InFrame { frame, from_m, to_m } => {
                Self::InFrame { frame, from_m: from_m / length_m, to_m: to_m / length_m }
            }
        }
    }
}

/// A core where a joint carries it: in the axes K of that joint, from its origin; in the axes that joint 1
/// turns in, from the origin of those, if it is fixed to the base.
pub(crate) struct LocalCore {
    pub joint: Option<usize>,
    pub start: Vector3<f64>,
    pub direction: Vector3<f64>,
}

impl LocalCore {
    pub fn segment<T: Scalar>(&self) -> Segment<T> {
        Segment {
            start: constant(&self.start),
            direction: constant(&self.direction),
            length_squared: T::from(self.direction.norm_squared()),
        }
    }

    /// The same segment from its other end.
    pub fn reversed(&self) -> Self {
        Self { joint: self.joint, start: self.start + self.direction, direction: -self.direction }
    }
}

impl System {
    /// The joints that move a core, from the base outward.
    pub fn joints_moving(&self, core: &Core) -> Vec<usize> {
        let path = self.tree.path(self.placed(core).joint);
        path.into_iter().map(|joint| self.tree.joints[joint].coordinate).collect()
    }

    /// Each joint that moves a core, from the base outward, and how fast a unit of its rate moves a point of
    /// the core at most, whatever the posture: for a joint that turns, how far the point can be from its
    /// axis, m; for one that slides, 1. No coordinate of a joint that slides exceeds the one of `farthest`
    /// (one a joint, m; those of joints that turn do not count) in magnitude.
    pub fn levers(&self, core: &Core, farthest: &[f64]) -> Vec<(usize, f64)> {
        let core = self.placed(core);
        let mut beyond_m = core.start.norm().max((core.start + core.direction).norm());
        let mut levers = Vec::new();
        for joint in self.tree.path(core.joint).into_iter().rev() {
            let Joint { coordinate, kind, .. } = self.tree.joints[joint];
            let lever = match kind {
                JointKind::Revolute => beyond_m,
                JointKind::Prismatic => {
                    beyond_m += farthest[coordinate];
                    1.0
                }
            };
            levers.push((coordinate, lever));
            beyond_m += self.tree.start(joint).position_m.norm();
        }
        levers.reverse();
        levers
    }

    pub(crate) fn placed(&self, core: &Core) -> LocalCore {
        let tree = &self.tree;
        let to_root = tree.root_rotation.transpose();
        match *core {
            Core::Link(link) => match self.joint_under(link) {
                Some(joint) => LocalCore {
                    joint: Some(joint),
                    start: Vector3::zeros(),
                    direction: tree.joints[joint].offset,
                },
                None => {
                    let direction = to_root * (tree.root_position - tree.mount_position);
                    LocalCore { joint: None, start: -direction, direction }
                }
            },
            Core::InFrame { frame, from_m, to_m } => {
                let Carried { joint, placement } = &tree.frames[frame];
                let placed = |point: &Vector3<f64>| {
                    let placed = placement.position_m + placement.rotation * point;
                    match joint {
                        Some(_) => placed,
                        None => to_root * (placed - tree.root_position),
                    }
                };
                let (start, end) = (placed(&from_m), placed(&to_m));
                LocalCore { joint: *joint, start, direction: end - start }
            }
        }
    }

    /// The joint that the segment of a row moves with.
    fn joint_under(&self, link: usize) -> Option<usize> {
        match self.rows().map(|rows| rows.convention) {
            Some(DhConvention::Modified) => link.checked_sub(1),
            Some(DhConvention::Standard) | None => Some(link),
        }
    }
}

impl<T: Scalar> Kinematics<T> {
    /// A core in this posture, body axes, m.
    pub fn core(&self, core: &Core) -> Segment<T> {
        match core {
            Core::Link(link) => self.segments[*link].clone(),
            Core::InFrame { frame, from_m, to_m } => {
                let frame = &self.frames[*frame];
                let along = to_m - from_m;
                Segment {
                    start: frame.point(from_m),
                    direction: frame.vector(&along),
                    length_squared: T::from(along.norm_squared()),
                }
            }
        }
    }
}
