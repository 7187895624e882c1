//! The straight segments that capsules are swept around, and which joint moves each.

use crate::algebra::{constant, zero};
use crate::distance::Segment;
use crate::kinematics::{Frame, Kinematics};
use crate::parts::DhConvention;
use crate::system::System;
use nalgebra::Vector3;
use righting_scalar::Scalar;

/// The core of a capsule on the arm: the straight segment that it is swept around. That of a sphere has no
/// length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Core {
    /// From a link's inboard origin to its outboard one; links counted from zero.
    Link(usize),
    /// Between two points that move with a Denavit-Hartenberg frame.
    InFrame {
        /// The frame, 0 (the mount) to j.
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
    /// The joints that move a core: so many, from the first.
    pub fn joints_moving(&self, core: &Core) -> usize {
        match (*core, self.convention()) {
            (Core::Link(link), DhConvention::Standard) => link + 1,
            (Core::Link(link), DhConvention::Modified) => link,
            (Core::InFrame { frame, .. }, _) => frame,
        }
    }

    /// Of each joint that moves a core, in order: how far from a point on the joint's axis a point of the
    /// core can be at most, whatever the posture, m.
    pub fn reach_m(&self, core: &Core) -> Vec<f64> {
        let first_moved = match self.convention() {
            DhConvention::Standard => 0,
            DhConvention::Modified => 1,
        };
        let (last, beyond_m) = match *core {
            Core::Link(link) => (link + 1, 0.0),
            Core::InFrame { frame, from_m, to_m } => (frame, from_m.norm().max(to_m.norm())),
        };
        let lengths = |joint: usize| -> f64 {
            let links = self.links().get(joint + first_moved..last).unwrap_or_default();
            links.iter().map(|link| link.length_m()).sum()
        };
        (0..self.joints_moving(core)).map(|joint| lengths(joint) + beyond_m).collect()
    }

    pub(crate) fn placed(&self, core: &Core) -> LocalCore {
        let chain = &self.chain;
        let to_root = chain.root_rotation.transpose();
        match *core {
            Core::Link(link) => {
                let joint = self.joints_moving(core).checked_sub(1);
                match joint {
                    Some(joint) => LocalCore {
                        joint: Some(joint),
                        start: Vector3::zeros(),
                        direction: chain.joints[joint].offset,
                    },
                    None => {
                        debug_assert_eq!(link, 0, "only Craig's link 1 is fixed to the base");
                        let direction = to_root * (chain.root_position - self.mount().position_m);
                        LocalCore { joint: None, start: -direction, direction }
                    }
                }
            }
            Core::InFrame { frame, from_m, to_m } => {
                let joint = frame.checked_sub(1);
                let placed = |point: &Vector3<f64>| match (joint, self.convention()) {
                    (Some(joint), DhConvention::Standard) => {
                        let joint = &chain.joints[joint];
                        joint.offset + joint.twist.about_x() * point
                    }
                    (Some(_), DhConvention::Modified) => *point,
                    (None, _) => {
                        let mount = self.mount();
                        let from_body = mount.position_m + mount.rotation * point;
                        to_root * (from_body - chain.root_position)
                    }
                };
                let (start, end) = (placed(&from_m), placed(&to_m));
                LocalCore { joint, start, direction: end - start }
            }
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
                let axes = Frame { origin: zero(), axes: frame.axes };
                Segment {
                    start: frame.point(from_m),
                    direction: axes.point(&along),
                    length_squared: T::from(along.norm_squared()),
                }
            }
        }
    }
}
