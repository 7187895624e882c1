//! Where everything is, in body axes.

use crate::algebra::{
    PlaneRotation, combination, constant, difference, plus_multiple, scaled, sum, zero,
};
use crate::bodies::Placement;
use crate::distance::Segment;
use crate::parts::DhConvention;
use crate::rows::Rows;
use crate::sweep::group_rotations;
use crate::system::System;
use crate::tree::{Carried, Joint, Tree};
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// A right-handed frame seen from the body frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame<T> {
    /// Origin from the body-frame origin, body axes, m.
    pub origin: Vector3<T>,
    /// Unit vectors of the frame, body axes.
    pub axes: [Vector3<T>; 3],
}

impl<T: Scalar> Frame<T> {
    /// Turns vectors of the frame into body axes.
    pub fn rotation(&self) -> Matrix3<T> {
        Matrix3::from_columns(&self.axes)
    }

    /// The point with the given constant coordinates in this frame, body axes.
    pub(crate) fn point(&self, coordinates: &Vector3<f64>) -> Vector3<T> {
        let along = |sum: Vector3<T>, i: usize| {
            sum.zip_map(&self.axes[i], |x, axis| plus_multiple(x, coordinates[i], axis))
        };
        along(along(along(self.origin, 0), 1), 2)
    }

    /// The vector with the given constant coordinates in this frame, body axes.
    pub(crate) fn vector(&self, coordinates: &Vector3<f64>) -> Vector3<T> {
        Self { origin: zero(), axes: self.axes }.point(coordinates)
    }

    /// The frame that sits at `position` in this one and whose vectors `rotation` turns into this one's.
    pub(crate) fn carried(&self, position: &Vector3<f64>, rotation: &Matrix3<f64>) -> Self {
        let [x, y, z] = &self.axes;
        let mixed = |i: usize| {
            Vector3::from_fn(|row, _| {
                let entries = [(rotation[(0, i)], x[row]), (rotation[(1, i)], y[row])];
                combination([entries[0], entries[1], (rotation[(2, i)], z[row])])
            })
        };
        Self { origin: self.point(position), axes: [0, 1, 2].map(mixed) }
    }

    fn turned(&self, rotation: &PlaneRotation<T>) -> Self {
        let [x, y, z] = self.axes;
        let PlaneRotation { sin, cos } = *rotation;
        let first = sum(&scaled(&x, cos), &scaled(&y, sin));
        let second = difference(&scaled(&y, cos), &scaled(&x, sin));
        Self { origin: self.origin, axes: [first, second, z] }
    }
}

/// Positions and directions of the arm in body axes, from the body-frame origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Kinematics<T> {
    /// Unit vector of each joint's axis.
    pub joint_axes: Vec<Vector3<T>>,
    /// A point on each joint's axis, m: the same for every angle of the joint; of one that slides, it moves
    /// along.
    pub joint_origins: Vec<Vector3<T>>,
    /// Of rows, the Denavit-Hartenberg frames 0…j; frame 0 is the mount. Of bodies, the body frame and then
    /// the frame of each body.
    pub frames: Vec<Frame<T>>,
    /// Of rows, each link's straight segment from its inboard to its outboard origin; none of bodies.
    pub segments: Vec<Segment<T>>,
    /// Centre of mass of each link or body, m.
    pub centers_of_mass: Vec<Vector3<T>>,
}

impl System {
    /// Positions and directions at joint angles `q` (j, rad).
    ///
    /// # Panics
    /// `q` does not have one angle a joint.
    pub fn kinematics<T: Scalar>(&self, q: &[T]) -> Kinematics<T> {
        self.assert_joint_slice(q);
        let tree = &self.tree;
        let joint_frames = joint_frames(tree, q);
        let in_coordinates = |of: fn(&Frame<T>) -> Vector3<T>| {
            let mut values = vec![zero(); q.len()];
            for (joint, frame) in tree.joints.iter().zip(&joint_frames) {
                values[joint.coordinate] = of(frame);
            }
            values
        };
        let frame = |carried: &Carried| {
            let Placement { position_m, rotation } = &carried.placement;
            match carried.joint {
                Some(joint) => joint_frames[joint].carried(position_m, rotation),
                None => Frame { origin: constant(position_m), axes: columns(rotation) },
            }
        };
        let center = |(joint, position): &(Option<usize>, Vector3<f64>)| match joint {
            Some(joint) => joint_frames[*joint].point(position),
            None => constant(position),
        };
        Kinematics {
            joint_axes: in_coordinates(|frame| frame.axes[2]),
            joint_origins: in_coordinates(|frame| frame.origin),
            frames: tree.frames.iter().map(frame).collect(),
            segments: self.rows().map_or_else(Vec::new, |rows| segments(tree, rows, &joint_frames)),
            centers_of_mass: tree.centers.iter().map(center).collect(),
        }
    }

    pub(crate) fn assert_joint_slice<T>(&self, values: &[T]) {
        assert_eq!(values.len(), self.joint_count(), "one value a joint is needed");
    }
}

/// The frames K of the joints (see [`Tree`]) in body axes.
pub(crate) fn joint_frames<T: Scalar>(tree: &Tree, q: &[T]) -> Vec<Frame<T>> {
    let rotations = group_rotations(tree, q);
    // The frame in which the joints of the current group turn.
    let mut group =
        Frame { origin: constant(&tree.root_position), axes: columns(&tree.root_rotation) };
    let mut frames: Vec<Frame<T>> = Vec::with_capacity(tree.joints.len());
    for (k, (joint, rotation)) in tree.joints.iter().zip(&rotations).enumerate() {
        if joint.branch.is_some() {
            let Placement { position_m, rotation } = tree.start(k);
            group = match joint.parent {
                Some(parent) => frames[parent].carried(&position_m, &rotation),
                None => Frame { origin: constant(&position_m), axes: columns(&rotation) },
            };
        }
        let mut frame = group.turned(rotation);
        if joint.slide.is_some() {
            let travel = scaled(&frame.axes[2], q[joint.coordinate]);
            frame.origin = sum(&frame.origin, &travel);
        }
        group = if tree.continues_group(k + 1) {
            Frame { origin: frame.point(&joint.offset), axes: group.axes }
        } else {
            outboard(&frame, joint)
        };
        frames.push(frame);
    }
    frames
}

/// Of rows, each link's segment from its inboard to its outboard origin.
fn segments<T: Scalar>(tree: &Tree, rows: &Rows, frames: &[Frame<T>]) -> Vec<Segment<T>> {
    let moving = frames.iter().zip(&tree.joints);
    let moving = moving.map(|(frame, joint)| segment(frame, &joint.offset));
    match rows.convention {
        DhConvention::Standard => moving.collect(),
        DhConvention::Modified => {
            let fixed = tree.root_position - rows.mount.position_m;
            let first = Segment {
                start: constant(&rows.mount.position_m),
                direction: constant(&fixed),
                length_squared: T::from(fixed.norm_squared()),
            };
            std::iter::once(first).chain(moving.take(rows.links.len() - 1)).collect()
        }
    }
}

/// The frame of a joint carried through the joint's offset and twist.
fn outboard<T: Scalar>(frame: &Frame<T>, joint: &Joint) -> Frame<T> {
    frame.carried(&joint.offset, &joint.twist.about_x())
}

fn columns<T: Scalar>(matrix: &Matrix3<f64>) -> [Vector3<T>; 3] {
    [0, 1, 2].map(|i| constant(&matrix.column(i).into_owned()))
}

fn segment<T: Scalar>(frame: &Frame<T>, offset: &Vector3<f64>) -> Segment<T> {
    let direction = frame.vector(offset);
    Segment { start: frame.origin, direction, length_squared: T::from(offset.norm_squared()) }
}
