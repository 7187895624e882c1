//! Bodies in a tree, each on a joint of the one before it: how robots are described outside of tables.

use crate::bodies::{Placement, RigidBody};
use crate::error::{ModelError, Part};
use crate::parts::{check_finite, check_inertia, check_mass, check_rotation};
use nalgebra::Vector3;

/// A rigid body and the joint that it moves on.
///
/// At joint coordinate zero the body's frame is the joint's; from there the joint turns it about an axis
/// that is fixed in both, or slides it along one.
#[derive(Debug, Clone, PartialEq)]
pub struct JointedBody {
    /// The body that carries the joint, by its place in the list; none for the base.
    pub parent: Option<usize>,
    /// Where the joint's frame sits in the frame of that body, in the body frame for the base.
    pub placement: Placement,
    /// How the body moves in the joint's frame.
    pub joint: BodyJoint,
    /// Mass, centre of mass and inertia in the body's frame. A body may have no mass.
    pub body: RigidBody,
}

/// What a joint lets a body do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BodyJoint {
    /// Nothing: it is a part of the body that carries it.
    Fixed,
    /// Turn about this axis in the joint's frame, of any length but zero.
    Revolute(Vector3<f64>),
    /// Slide along this axis in the joint's frame, of any length but zero.
    Prismatic(Vector3<f64>),
}

/// What the coordinate of a joint that moves is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum JointKind {
    /// An angle, rad: the joint turns, and its motor gives a torque, N m.
    Revolute,
    /// A travel, m: the joint slides, and its motor gives a force, N.
    Prismatic,
}

impl BodyJoint {
    /// The kind and axis of a joint that moves.
    pub(crate) fn motion(&self) -> Option<(JointKind, &Vector3<f64>)> {
        match self {
            Self::Fixed => None,
            Self::Revolute(axis) => Some((JointKind::Revolute, axis)),
            Self::Prismatic(axis) => Some((JointKind::Prismatic, axis)),
        }
    }
}

impl JointedBody {
    /// Whether the body has a joint coordinate.
    pub fn is_movable(&self) -> bool {
        self.joint != BodyJoint::Fixed
    }

    /// Distance of the joint from the origin of the body that carries it, m.
    pub(crate) fn distance_m(&self) -> f64 {
        self.placement.position_m.norm()
    }

    fn check(&self, part: Part) -> Result<(), ModelError> {
        let RigidBody { mass_kg, center_of_mass_m, inertia_kg_m2 } = &self.body;
        for (quantity, value) in [
            ("joint.position_m", &self.placement.position_m),
            ("center_of_mass_m", center_of_mass_m),
        ] {
            value.iter().try_for_each(|value| check_finite(part, quantity, *value))?;
        }
        check_rotation(part, "joint.rotation", &self.placement.rotation)?;
        if let Some((_, axis)) = self.joint.motion() {
            axis.iter().try_for_each(|value| check_finite(part, "joint.axis", *value))?;
            if axis.amax() == 0.0 {
                return Err(ModelError::NoAxis { part });
            }
        }
        check_mass(part, *mass_kg)?;
        check_inertia(part, *mass_kg, Some(inertia_kg_m2))
    }
}

/// A list of bodies each of which leads to the base, some of them on joints that move.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Bodies {
    list: Vec<JointedBody>,
    /// Places in the list, depth first from the base: every body after the one that carries it.
    outward: Vec<usize>,
}

impl Bodies {
    pub fn new(list: Vec<JointedBody>) -> Result<Self, ModelError> {
        for (index, body) in list.iter().enumerate() {
            body.check(Part::Body(index))?;
        }
        if !list.iter().any(JointedBody::is_movable) {
            return Err(ModelError::EmptyChain);
        }
        let mut outward = Vec::with_capacity(list.len());
        let mut ahead: Vec<usize> = carried_by(&list, None).rev().collect();
        while let Some(index) = ahead.pop() {
            outward.push(index);
            ahead.extend(carried_by(&list, Some(index)).rev());
        }
        match (0..list.len()).find(|index| !outward.contains(index)) {
            Some(index) => Err(ModelError::NoWayToBase { part: Part::Body(index) }),
            None => Ok(Self { list, outward }),
        }
    }

    /// As they were given.
    pub fn list(&self) -> &[JointedBody] {
        &self.list
    }

    /// The same bodies with each changed; their joints and who carries whom stay.
    pub fn changed(&self, change: impl FnMut(&JointedBody) -> JointedBody) -> Self {
        Self { list: self.list.iter().map(change).collect(), outward: self.outward.clone() }
    }

    /// Bodies, every one after the one that carries it.
    pub fn outward(&self) -> impl Iterator<Item = (usize, &JointedBody)> {
        self.outward.iter().map(|&index| (index, &self.list[index]))
    }

    /// Place of each body's joint among the joint coordinates; none of a fixed one.
    pub fn coordinates(&self) -> Vec<Option<usize>> {
        let mut next = 0..;
        self.list.iter().map(|body| body.is_movable().then(|| next.next()).flatten()).collect()
    }

    /// The farthest that a joint or a centre of mass can be from the body-frame origin, m.
    pub fn reach_m(&self) -> f64 {
        let mut farthest_m: f64 = 0.0;
        let mut to_joint_m = vec![0.0; self.list.len()];
        for (index, body) in self.outward() {
            let before_m = body.parent.map_or(0.0, |parent| to_joint_m[parent]);
            to_joint_m[index] = before_m + body.distance_m();
            let center_m = body.body.center_of_mass_m.norm();
            farthest_m = farthest_m.max(to_joint_m[index] + center_m);
        }
        farthest_m
    }

    /// The way from one body to another over the joints that move, as the distances of neighbouring ones
    /// together, m; zero for bodies that are fixed to each other or share a joint, infinite where a joint
    /// between the two slides that neither shares.
    pub fn length_between_m(&self, a: usize, b: usize) -> f64 {
        let (from_a, from_b) = (self.joints_of(a), self.joints_of(b));
        let shared = from_a.iter().zip(&from_b).take_while(|(a, b)| a == b).count();
        // Inward to the body that carries both, then outward; where one carries the other only that.
        let (a, b) = (&from_a[shared..], &from_b[shared..]);
        let along = |joints: &[usize]| -> f64 {
            let length_m = |pair: &[usize]| match self.list[pair[0]].joint {
                BodyJoint::Prismatic(_) => f64::INFINITY,
                _ => self.offset_m(pair[0], pair[1]).norm(),
            };
            joints.windows(2).map(length_m).sum()
        };
        let across_m = match (a.first(), b.first()) {
            (Some(&a), Some(&b)) => {
                let carrier = shared.checked_sub(1).map(|last| from_a[last]);
                (self.in_carrier_m(carrier, a) - self.in_carrier_m(carrier, b)).norm()
            }
            _ => 0.0,
        };
        along(a) + across_m + along(b)
    }

    /// The bodies on joints that move from the base to this one.
    fn joints_of(&self, body: usize) -> Vec<usize> {
        let inward = std::iter::successors(Some(body), |&body| self.list[body].parent);
        let mut joints: Vec<usize> = inward.filter(|&body| self.list[body].is_movable()).collect();
        joints.reverse();
        joints
    }

    fn offset_m(&self, carrier: usize, joint: usize) -> Vector3<f64> {
        self.in_carrier_m(Some(carrier), joint)
    }

    /// A joint in the frame of the body on a joint that carries it, over what is fixed between, m.
    fn in_carrier_m(&self, carrier: Option<usize>, joint: usize) -> Vector3<f64> {
        let mut position_m = self.list[joint].placement.position_m;
        let mut at = self.list[joint].parent;
        while at != carrier
            && let Some(fixed) = at
        {
            let Placement { position_m: offset_m, rotation } = &self.list[fixed].placement;
            position_m = offset_m + rotation * position_m;
            at = self.list[fixed].parent;
        }
        position_m
    }
}

fn carried_by(
    list: &[JointedBody],
    parent: Option<usize>,
) -> impl DoubleEndedIterator<Item = usize> + '_ {
    (0..list.len()).filter(move |&index| list[index].parent == parent)
}
