//! Distances of links from the base and from each other, in the axes of the link farther out.
//!
//! Of a link that is what [`Core`] says. The same numbers as from
//! [`Kinematics::core`](crate::Kinematics::core), at a fraction of the operations where derivatives count:
//! the distance of two links depends only on the joints between them, and here that shows. In body axes both
//! depend on every joint inboard, and only the arithmetic finds out that the distance does not.

use crate::algebra::{PlaneRotation, constant, constant_rotation, offset_by};
use crate::bodies::Placement;
use crate::core::{Core, LocalCore};
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
        let point = self.carried(q, point, None, Some(joint));
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
        let Carried { point, direction: along } = self.carried(q, segment, None, Some(joint));
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
        let (a, b) = (self.placed(a), self.placed(b));
        let depth = |core: &LocalCore| self.tree.path(core.joint).len();
        let (inboard, outboard) = if depth(&a) <= depth(&b) { (a, b) } else { (b, a) };
        let inboard = inboard.reversed();
        if inboard.joint == outboard.joint {
            return T::from(inboard.segment().squared_distance_to_segment(&outboard.segment()));
        }
        let core =
            Carried { point: constant(&inboard.start), direction: constant(&inboard.direction) };
        let Carried { point, direction } = self.carried(q, core, inboard.joint, outboard.joint);
        let length_squared = T::from(inboard.direction.norm_squared());
        Segment { start: point, direction, length_squared }
            .squared_distance_to_segment(&outboard.segment())
    }

    /// A point of the base from the origin of the axes that joint 1 turns in, in those axes.
    fn seen_from_root(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let to_root = self.tree.root_rotation.transpose();
        -(to_root * (self.tree.root_position - point))
    }

    /// Takes what is given in K of one joint into K of another. The base stands for no joint, with the axes
    /// that joint 1 turns in and their origin.
    fn carried<T: Scalar>(
        &self,
        q: &[T],
        start: Carried<T>,
        from: Option<usize>,
        to: Option<usize>,
    ) -> Carried<T> {
        self.assert_joint_slice(q);
        let rotations = joint_rotations(&self.tree, q);
        let travel = |k: usize| {
            let joint = &self.tree.joints[k];
            joint.slide.map(|_| q[joint.coordinate])
        };
        let (inward, outward) = (self.tree.path(from), self.tree.path(to));
        let shared = inward.iter().zip(&outward).take_while(|(a, b)| a == b).count();
        let mut carried = start;
        for &k in inward[shared..].iter().rev() {
            carried = carried.turned(&rotations[k]).moved_along(travel(k));
            carried = carried.out_of(&self.start_from_root(k));
        }
        for &k in &outward[shared..] {
            carried = carried.into_frame(&self.start_from_root(k));
            carried = carried.moved_along(travel(k).map(|travel| -travel));
            carried = carried.turned_back(&rotations[k]);
        }
        carried
    }

    /// Where the frame that joint k turns in sits in K of its parent, or in the axes that joint 1 turns in.
    fn start_from_root(&self, k: usize) -> Placement {
        let joint = &self.tree.joints[k];
        match joint.parent.is_none() && joint.branch.is_none() {
            true => Placement::identity(),
            false => self.tree.start(k),
        }
    }
}

impl<T: Scalar> Carried<T> {
    /// Out of a frame that sits at `placement`.
    fn out_of(self, placement: &Placement) -> Self {
        let Placement { position_m, rotation } = placement;
        let point = constant_rotation(rotation, &self.point);
        Self {
            point: offset_by(&point, position_m),
            direction: constant_rotation(rotation, &self.direction),
        }
    }

    /// Into a frame that sits at `placement`.
    fn into_frame(self, placement: &Placement) -> Self {
        let back = placement.rotation.transpose();
        let point = offset_by(&self.point, &-placement.position_m);
        Self {
            point: constant_rotation(&back, &point),
            direction: constant_rotation(&back, &self.direction),
        }
    }

    /// By so much along z, if at all.
    fn moved_along(mut self, travel: Option<T>) -> Self {
        if let Some(travel) = travel {
            self.point.z += travel;
        }
        self
    }

    fn turned(self, rotation: &PlaneRotation<T>) -> Self {
        Self { point: rotation.turn(&self.point), direction: rotation.turn(&self.direction) }
    }

    fn turned_back(self, rotation: &PlaneRotation<T>) -> Self {
        Self {
            point: rotation.turn_back(&self.point),
            direction: rotation.turn_back(&self.direction),
        }
    }
}
