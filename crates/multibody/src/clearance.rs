//! Distances of links from the base and from each other, in the axes of the link farther out.
//!
//! The same numbers as from [`Kinematics::segments`](crate::Kinematics::segments), at a fraction of
//! the operations where derivatives count: the distance of two links depends only on the joints
//! between them, and here that shows. In body axes both depend on every joint inboard, and only the
//! arithmetic finds out that the distance does not.

use crate::algebra::{constant, constant_rotation, offset_by};
use crate::distance::Segment;
use crate::parts::DhConvention;
use crate::sweep::joint_rotations;
use crate::system::System;
use nalgebra::Vector3;
use righting_scalar::Scalar;

/// A link's segment in the axes of the joint that moves it, from that joint's origin; in the axes
/// that joint 1 turns in, from the mount, for a link fixed to the base.
struct LocalSegment {
    joint: Option<usize>,
    direction: Vector3<f64>,
}

/// A segment or point on its way outward: seen from one joint's K after the other.
struct Carried<T> {
    point: Vector3<T>,
    direction: Vector3<T>,
}

impl System {
    /// Squared distance of a link (counted from zero) from the body-frame origin, m², at joint
    /// angles `q` (j, rad).
    ///
    /// # Panics
    /// `q` does not have one angle a joint, or there is no such link.
    pub fn squared_distance_to_base<T: Scalar>(&self, q: &[T], link: usize) -> T {
        let chain = &self.chain;
        let to_root = chain.root_rotation.transpose();
        let LocalSegment { joint, direction } = self.place(link);
        let origin = -(to_root * chain.root_position);
        let Some(joint) = joint else {
            let start = -direction;
            let segment = Segment::new(start, Vector3::zeros());
            return T::from(segment.squared_distance_to_point(&origin));
        };
        let base = Carried { point: constant(&origin), direction: constant(&Vector3::zeros()) };
        let base = self.carried(q, base, 0, joint);
        fixed_segment(&direction).squared_distance_to_point(&base.point)
    }

    /// Squared distance of two links (counted from zero) from each other, m², at joint angles `q`
    /// (j, rad). Depends on the joints between them only.
    ///
    /// # Panics
    /// `q` does not have one angle a joint, or there is no such link.
    pub fn squared_distance_between<T: Scalar>(&self, q: &[T], a: usize, b: usize) -> T {
        let (inboard, outboard) = (self.place(a.min(b)), self.place(a.max(b)));
        let first = inboard.joint.map_or(0, |joint| joint + 1);
        let Some(last) = outboard.joint.filter(|last| *last >= first) else {
            return T::from(0.0);
        };
        // The inboard link ends at the origin of the joint after it.
        let link = Carried {
            point: constant(&Vector3::zeros()),
            direction: constant(&-inboard.direction),
        };
        let link = match first {
            0 => link,
            _ => link.twisted(self, first - 1),
        };
        let Carried { point, direction } = self.carried(q, link, first, last);
        let length_squared = T::from(inboard.direction.norm_squared());
        Segment { start: point, direction, length_squared }
            .squared_distance_to_segment(&fixed_segment(&outboard.direction))
    }

    /// Takes what is given from the origin of K(first), in the axes in which that joint turns, into
    /// K(last).
    fn carried<T: Scalar>(
        &self,
        q: &[T],
        start: Carried<T>,
        first: usize,
        last: usize,
    ) -> Carried<T> {
        self.assert_joint_slice(q);
        let rotations = joint_rotations(&self.chain, q);
        let mut carried = start;
        for (k, rotation) in rotations.iter().enumerate().take(last + 1).skip(first) {
            carried = Carried {
                point: rotation.turn_back(&carried.point),
                direction: rotation.turn_back(&carried.direction),
            };
            if k < last {
                let offset = -self.chain.joints[k].offset;
                carried.point = offset_by(&carried.point, &offset);
                carried = carried.twisted(self, k);
            }
        }
        carried
    }

    fn place(&self, link: usize) -> LocalSegment {
        let joint = match self.convention() {
            DhConvention::Standard => Some(link),
            DhConvention::Modified => link.checked_sub(1),
        };
        let direction = match joint {
            Some(joint) => self.chain.joints[joint].offset,
            None => {
                let offset = self.chain.root_position - self.mount().position_m;
                self.chain.root_rotation.transpose() * offset
            }
        };
        LocalSegment { joint, direction }
    }
}

impl<T: Scalar> Carried<T> {
    /// From the axes of K(k) to those in which the next joint turns.
    fn twisted(self, system: &System, k: usize) -> Self {
        let back = system.chain.joints[k].twist.about_x().transpose();
        Self {
            point: constant_rotation(&back, &self.point),
            direction: constant_rotation(&back, &self.direction),
        }
    }
}

fn fixed_segment<T: Scalar>(direction: &Vector3<f64>) -> Segment<T> {
    Segment {
        start: constant(&Vector3::zeros()),
        direction: constant(direction),
        length_squared: T::from(direction.norm_squared()),
    }
}
