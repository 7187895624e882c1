//! Distances of links from the base and from each other, in the axes of the link farther out.
//!
//! Of a link that is what [`Core`] says. The same numbers as from
//! [`Kinematics::core`](crate::Kinematics::core), at a fraction of the operations where derivatives count:
//! the distance of two links depends only on the joints between them, and here that shows. In body axes both
//! depend on every joint inboard, and only the arithmetic finds out that the distance does not.

use crate::algebra::{constant, constant_rotation, offset_by};
use crate::core::Core;
use crate::distance::Segment;
use crate::sweep::joint_rotations;
use crate::system::System;
use nalgebra::Vector3;
use righting_scalar::Scalar;

/// A segment or point on its way outward: seen from one joint's K after the other.
struct Carried<T> {
    point: Vector3<T>,
    direction: Vector3<T>,
}

impl System {
    /// Squared distance of a core from a point of the base (body axes, from the body-frame origin, m), m²,
    /// at joint angles `q` (j, rad).
    ///
    /// # Panics
    /// `q` does not have one angle a joint, or there is no such link or frame.
    pub fn squared_distance_to_point<T: Scalar>(
        &self,
        q: &[T],
        core: &Core,
        point: &Vector3<f64>,
    ) -> T {
        let core = self.placed(core);
        let point = self.seen_from_root(point);
        let Some(joint) = core.joint else {
            return T::from(core.segment().squared_distance_to_point(&point));
        };
        let point = Carried { point: constant(&point), direction: constant(&Vector3::zeros()) };
        let point = self.carried(q, point, 0, joint);
        core.segment().squared_distance_to_point(&point.point)
    }

    /// Squared distance of a core from the straight segment between two points of the base (body axes, from
    /// the body-frame origin, m), m², at joint angles `q` (j, rad).
    ///
    /// # Panics
    /// As [`squared_distance_to_point`](Self::squared_distance_to_point).
    pub fn squared_distance_to_segment<T: Scalar>(
        &self,
        q: &[T],
        core: &Core,
        ends: &[Vector3<f64>; 2],
    ) -> T {
        let core = self.placed(core);
        let [start, end] = [0, 1].map(|end| self.seen_from_root(&ends[end]));
        let Some(joint) = core.joint else {
            let segment = Segment::new(start, end);
            return T::from(segment.squared_distance_to_segment(&core.segment()));
        };
        let direction = end - start;
        let segment = Carried { point: constant(&start), direction: constant(&direction) };
        let Carried { point, direction: along } = self.carried(q, segment, 0, joint);
        let length_squared = T::from(direction.norm_squared());
        Segment { start: point, direction: along, length_squared }
            .squared_distance_to_segment(&core.segment())
    }

    /// Squared distance of two cores from each other, m², at joint angles `q` (j, rad). Depends on the
    /// joints between them only.
    ///
    /// # Panics
    /// As [`squared_distance_to_point`](Self::squared_distance_to_point).
    pub fn squared_distance_between<T: Scalar>(&self, q: &[T], a: &Core, b: &Core) -> T {
        let (inboard, outboard) = match self.joints_moving(a) <= self.joints_moving(b) {
            true => (self.placed(a).reversed(), self.placed(b)),
            false => (self.placed(b).reversed(), self.placed(a)),
        };
        let first = inboard.joint.map_or(0, |joint| joint + 1);
        let Some(last) = outboard.joint.filter(|last| *last >= first) else {
            return T::from(inboard.segment().squared_distance_to_segment(&outboard.segment()));
        };
        let from_next = match inboard.joint {
            Some(joint) => inboard.start - self.chain.joints[joint].offset,
            None => inboard.start,
        };
        let core = Carried { point: constant(&from_next), direction: constant(&inboard.direction) };
        let core = match first {
            0 => core,
            _ => core.twisted(self, first - 1),
        };
        let Carried { point, direction } = self.carried(q, core, first, last);
        let length_squared = T::from(inboard.direction.norm_squared());
        Segment { start: point, direction, length_squared }
            .squared_distance_to_segment(&outboard.segment())
    }

    /// A point of the base from the origin of the axes that joint 1 turns in, in those axes.
    fn seen_from_root(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let to_root = self.chain.root_rotation.transpose();
        -(to_root * (self.chain.root_position - point))
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
