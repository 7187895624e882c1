//! Where everything is, in body axes.

use crate::algebra::{
    PlaneRotation, combination, constant, difference, plus_multiple, scaled, sum, zero,
};
use crate::chain::{Chain, Joint, LinkCenter};
use crate::distance::Segment;
use crate::parts::DhConvention;
use crate::sweep::group_rotations;
use crate::system::System;
use crate::turn::Turn;
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

    fn turned(&self, rotation: &PlaneRotation<T>) -> Self {
        let [x, y, z] = self.axes;
        let PlaneRotation { sin, cos } = *rotation;
        let first = sum(&scaled(&x, cos), &scaled(&y, sin));
        let second = difference(&scaled(&y, cos), &scaled(&x, sin));
        Self { origin: self.origin, axes: [first, second, z] }
    }

    fn twisted(&self, twist: Turn) -> Self {
        if twist.is_none() {
            return self.clone();
        }
        let matrix = twist.about_x();
        let [x, y, z] = self.axes;
        let mixed = |i: usize| {
            y.zip_map(&z, |y, z| combination([(matrix[(1, i)], y), (matrix[(2, i)], z)]))
        };
        Self { origin: self.origin, axes: [x, mixed(1), mixed(2)] }
    }
}

/// Positions and directions of the arm in body axes, from the body-frame origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Kinematics<T> {
    /// Unit vector of each joint's axis.
    pub joint_axes: Vec<Vector3<T>>,
    /// A point on each joint's axis, the same for every value of that joint's angle, m.
    pub joint_origins: Vec<Vector3<T>>,
    /// Denavit-Hartenberg frames 0…j; frame 0 is the mount.
    pub frames: Vec<Frame<T>>,
    /// Each link's straight segment from its inboard to its outboard origin.
    pub segments: Vec<Segment<T>>,
    /// Centre of mass of each link, m.
    pub centers_of_mass: Vec<Vector3<T>>,
}

impl System {
    /// Positions and directions at joint angles `q` (j, rad).
    ///
    /// # Panics
    /// `q` does not have one angle a joint.
    pub fn kinematics<T: Scalar>(&self, q: &[T]) -> Kinematics<T> {
        self.assert_joint_slice(q);
        let chain = &self.chain;
        let rotations = group_rotations(chain, q);
        let mount = Frame {
            origin: constant(&self.mount().position_m),
            axes: columns(self.mount().rotation.matrix()),
        };
        let joint_count = self.joint_count();
        let joint_frames = joint_frames(chain, &rotations);
        let joint_axes = joint_frames.iter().map(|frame| frame.axes[2]).collect();
        let joint_origins = joint_frames.iter().map(|frame| frame.origin).collect();
        let centers_of_mass = chain
            .link_centers
            .iter()
            .map(|center| match center {
                LinkCenter::OnBase(position) => constant(position),
                LinkCenter::OnJoint(joint, position) => joint_frames[*joint].point(position),
            })
            .collect();
        let mut frames = vec![mount];
        let mut segments = Vec::with_capacity(joint_count);
        match self.convention() {
            DhConvention::Standard => {
                for (frame, joint) in joint_frames.iter().zip(&chain.joints) {
                    frames.push(outboard(frame, joint));
                    segments.push(segment(frame, &joint.offset));
                }
            }
            DhConvention::Modified => {
                let fixed = chain.root_position - self.mount().position_m;
                segments.push(Segment {
                    start: frames[0].origin,
                    direction: constant(&fixed),
                    length_squared: T::from(fixed.norm_squared()),
                });
                for (frame, joint) in joint_frames.iter().zip(&chain.joints).take(joint_count - 1) {
                    segments.push(segment(frame, &joint.offset));
                }
                frames.extend(joint_frames);
            }
        }
        Kinematics { joint_axes, joint_origins, frames, segments, centers_of_mass }
    }

    pub(crate) fn assert_joint_slice<T>(&self, values: &[T]) {
        assert_eq!(values.len(), self.joint_count(), "one value a joint is needed");
    }
}

/// The frames K of the joints (see [`Chain`]) in body axes.
pub(crate) fn joint_frames<T: Scalar>(
    chain: &Chain,
    rotations: &[PlaneRotation<T>],
) -> Vec<Frame<T>> {
    // The frame in which the joints of the current group turn.
    let mut group =
        Frame { origin: constant(&chain.root_position), axes: columns(&chain.root_rotation) };
    let mut frames = Vec::with_capacity(chain.joints.len());
    for (joint, rotation) in chain.joints.iter().zip(rotations) {
        let frame = group.turned(rotation);
        group = if joint.twist.is_none() {
            Frame { origin: frame.point(&joint.offset), axes: group.axes }
        } else {
            outboard(&frame, joint)
        };
        frames.push(frame);
    }
    frames
}

/// The frame of a joint carried through the joint's offset and twist.
fn outboard<T: Scalar>(frame: &Frame<T>, joint: &Joint) -> Frame<T> {
    Frame { origin: frame.point(&joint.offset), axes: frame.axes }.twisted(joint.twist)
}

fn columns<T: Scalar>(matrix: &Matrix3<f64>) -> [Vector3<T>; 3] {
    [0, 1, 2].map(|i| constant(&matrix.column(i).into_owned()))
}

fn segment<T: Scalar>(frame: &Frame<T>, offset: &Vector3<f64>) -> Segment<T> {
    let direction = Frame { origin: zero(), axes: frame.axes }.point(offset);
    Segment { start: frame.origin, direction, length_squared: T::from(offset.norm_squared()) }
}
