//! What one sweep from the tip inward carries past each joint.
//!
//! A sweep gathers all that lies beyond a joint into a few moments and momenta, counted from the
//! system's centre of mass (see [`Coupling`]) and written in the axes of the place it has reached.
//! There, bodies are constants. Neighbouring joints with parallel axes form a group and share one
//! set of axes: only the last of a group rotates what it is handed.

use crate::algebra::{
    PlaneRotation, combination, constant_cross, constant_rotation, offset_by, plus, plus_multiple,
    sum, zero,
};
use crate::coupling::Coupling;
use crate::symmetric::Symmetric;
use crate::tree::{Joint, Tree};
use crate::turn::Turn;
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

impl<T: Scalar> PlaneRotation<T> {
    /// By an angle counted from a constant one.
    pub fn of(angle: T, start: Turn) -> Self {
        let (sin, cos) = plus(angle, start.rest_rad).sin_cos();
        match start.quarters {
            0 => Self { sin, cos },
            1 => Self { sin: cos, cos: -sin },
            2 => Self { sin: -sin, cos: -cos },
            _ => Self { sin: -cos, cos: sin },
        }
    }

    fn none() -> Self {
        Self { sin: T::from(0.0), cos: T::from(1.0) }
    }

    /// Rz c.
    pub fn turn_constant(&self, c: &Vector3<f64>) -> Vector3<T> {
        Vector3::new(
            combination([(c.x, self.cos), (-c.y, self.sin)]),
            combination([(c.x, self.sin), (c.y, self.cos)]),
            T::from(c.z),
        )
    }
}

impl Joint {
    /// The angle by which it turns: none where it slides.
    fn turned_by<T: Scalar>(&self, q: &[T]) -> T {
        self.turning(q[self.coordinate])
    }

    /// Of a coordinate, rate or acceleration what turns: none where it slides.
    pub fn turning<T: Scalar>(&self, value: T) -> T {
        if self.slide.is_some() { T::from(0.0) } else { value }
    }
}

/// Each joint's rotation from K to the axes in which the joint turns or slides.
pub(crate) fn joint_rotations<T: Scalar>(tree: &Tree, q: &[T]) -> Vec<PlaneRotation<T>> {
    let rotation = |joint: &Joint| PlaneRotation::of(joint.turned_by(q), joint.angle);
    tree.joints.iter().map(rotation).collect()
}

/// Each joint's rotation from K to the axes in which its group turns: by the sum of the angles from
/// the group's first joint to this one.
pub(crate) fn group_rotations<T: Scalar>(tree: &Tree, q: &[T]) -> Vec<PlaneRotation<T>> {
    let mut rotations = Vec::with_capacity(q.len());
    let mut angle = T::from(0.0);
    let mut start = Turn::NONE;
    for (k, joint) in tree.joints.iter().enumerate() {
        if tree.continues_group(k) {
            angle += q[joint.coordinate];
            start = start.plus(joint.angle);
        } else {
            angle = joint.turned_by(q);
            start = joint.angle;
        }
        rotations.push(PlaneRotation::of(angle, start));
    }
    rotations
}

/// The rotations of a sweep, and the one that it leaves to be made at the end.
///
/// To a base that is symmetric about joint 1 every angle of that joint looks the same, so the sweep
/// may end in the axes of the last joint of the first group: matrices then need not be rotated to
/// the axes that joint 1 turns in, only the vectors asked for. What the sweep solves does not depend
/// on that angle either, which spares its derivatives.
pub(crate) struct SweepRotations<T> {
    pub joints: Vec<PlaneRotation<T>>,
    /// From the axes in which the sweep ends to those that joint 1 turns in.
    pub last: PlaneRotation<T>,
}

impl<T: Scalar> SweepRotations<T> {
    pub fn new(tree: &Tree, q: &[T]) -> Self {
        let mut joints = group_rotations(tree, q);
        if !tree.root.symmetric {
            return Self { joints, last: PlaneRotation::none() };
        }
        let tip = (0..joints.len()).find(|k| !tree.continues_group(k + 1)).unwrap_or(0);
        let last = std::mem::replace(&mut joints[tip], PlaneRotation::none());
        let mut angle = T::from(0.0);
        let mut start = Turn::NONE;
        for k in (0..tip).rev() {
            let next = &tree.joints[k + 1];
            angle -= q[next.coordinate];
            start = start.minus(next.angle);
            joints[k] = PlaneRotation::of(angle, start);
        }
        Self { joints, last }
    }
}

/// First and barycentric second moment of what lies beyond a joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moments<T> {
    /// F, kg m.
    pub first: Vector3<T>,
    /// S̃, kg m².
    pub second: Symmetric<T>,
}

/// Linear and barycentric angular momentum of what lies beyond a joint, or force and moment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair<T> {
    pub linear: Vector3<T>,
    pub angular: Vector3<T>,
}

/// The constants of a joint's [`Coupling`] seen from the axes in which its group turns.
pub(crate) struct TurnedCoupling<T> {
    pub arm: Vector3<T>,
    pub first: Vector3<T>,
    pub half: Vector3<T>,
    /// z component of `arm`.
    pub along: f64,
}

impl<T: Scalar> TurnedCoupling<T> {
    pub fn new(coupling: &Coupling, rotation: &PlaneRotation<T>) -> Self {
        Self {
            arm: rotation.turn_constant(&coupling.arm),
            first: rotation.turn_constant(&coupling.first),
            half: rotation.turn_constant(&coupling.half),
            along: coupling.arm.z,
        }
    }
}

impl<T: Scalar> Moments<T> {
    pub fn zero() -> Self {
        Self { first: zero(), second: Symmetric::zero() }
    }

    /// From the axes of the next group to those of K.
    pub fn twisted(self, twist: Turn) -> Self {
        if twist.is_none() {
            return self;
        }
        self.rotated(&twist.about_x())
    }

    /// From one set of axes to another.
    pub fn rotated(self, rotation: &Matrix3<f64>) -> Self {
        Self {
            first: constant_rotation(rotation, &self.first),
            second: self.second.rotated(rotation),
        }
    }

    /// From the axes of K to those in which its group turns.
    pub fn turned(self, rotation: &PlaneRotation<T>) -> Self {
        Self { first: rotation.turn(&self.first), second: self.second.turned(rotation) }
    }

    /// Moves to the joint's origin and takes in its body, in the axes of K.
    pub fn coupled(self, coupling: &Coupling) -> Self {
        let middle = offset_by(&self.first, &coupling.half);
        let mut second = self.second.plus_product_constant(&middle, &coupling.arm);
        if let Some(rest) = &coupling.rest {
            second = second.plus_constant(rest);
        }
        Self { first: offset_by(&self.first, &coupling.first), second }
    }

    /// The same in the axes in which the joint's group turns.
    pub fn coupled_turned(
        self,
        coupling: &Coupling,
        turned: &TurnedCoupling<T>,
        rotation: &PlaneRotation<T>,
    ) -> Self {
        let middle = sum(&self.first, &turned.half);
        let mut second = self.second.plus_product(&middle, &turned.arm, turned.along);
        if let Some(rest) = &coupling.rest {
            second = second.plus_matrix(&Symmetric::constant(rest).turned(rotation));
        }
        Self { first: sum(&self.first, &turned.first), second }
    }
}

impl<T: Scalar> Pair<T> {
    pub fn zero() -> Self {
        Self { linear: zero(), angular: zero() }
    }

    /// From the axes of the next group to those of K.
    pub fn twisted(self, twist: Turn) -> Self {
        if twist.is_none() {
            return self;
        }
        self.rotated(&twist.about_x())
    }

    /// From one set of axes to another.
    pub fn rotated(&self, rotation: &Matrix3<f64>) -> Self {
        Self {
            linear: constant_rotation(rotation, &self.linear),
            angular: constant_rotation(rotation, &self.angular),
        }
    }

    /// From the axes of K to those in which its group turns.
    pub fn turned(self, rotation: &PlaneRotation<T>) -> Self {
        Self { linear: rotation.turn(&self.linear), angular: rotation.turn(&self.angular) }
    }

    pub fn plus(&self, other: &Self) -> Self {
        Self {
            linear: sum(&self.linear, &other.linear),
            angular: sum(&self.angular, &other.angular),
        }
    }

    /// Counts the angular part about a point from which this one lies at `arm`.
    pub fn shifted(self, arm: &Vector3<f64>) -> Self {
        Self {
            linear: self.linear,
            angular: sum(&self.angular, &constant_cross(arm, &self.linear)),
        }
    }

    /// Counts the angular part about a point from which this one lies so far along z.
    pub fn shifted_along(self, z: T) -> Self {
        let Self { linear, angular } = self;
        let moment = Vector3::new(angular.x - z * linear.y, angular.y + z * linear.x, angular.z);
        Self { linear, angular: moment }
    }

    /// The same in the axes in which the joint's group turns.
    pub fn shifted_turned(self, turned: &TurnedCoupling<T>) -> Self {
        let Self { linear, angular } = self;
        let TurnedCoupling { arm, along, .. } = turned;
        let moment = Vector3::new(
            plus_multiple(arm.y * linear.z, -along, linear.y),
            plus_multiple(-(arm.x * linear.z), *along, linear.x),
            arm.x * linear.y - arm.y * linear.x,
        );
        Self { linear, angular: sum(&angular, &moment) }
    }

    /// Adds the momenta of `moments` turning about z at `rate`.
    pub fn plus_turning(self, moments: &Moments<T>, rate: T) -> Self {
        let Moments { first, second } = moments;
        let Self { linear, angular } = self;
        Self {
            linear: Vector3::new(linear.x - first.y * rate, linear.y + first.x * rate, linear.z),
            angular: Vector3::new(
                angular.x - second.xz * rate,
                angular.y - second.yz * rate,
                angular.z + (second.xx + second.yy) * rate,
            ),
        }
    }
}
