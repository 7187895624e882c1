//! The angular momentum as a linear map of the rates.

use crate::algebra::{constant, constant_rotation, cross, sum, zero};
use crate::kinematics::{Frame, joint_frames};
use crate::sweep::{Moments, group_rotations};
use crate::symmetric::Symmetric;
use crate::system::System;
use nalgebra::{Matrix3, Matrix3xX, Vector3};
use righting_scalar::Scalar;

/// Ĩ(q) and B(q) of the angular momentum H = Ĩ ω + B q̇ about the system's centre of mass, body axes.
#[derive(Debug, Clone, PartialEq)]
pub struct MomentumMap<T> {
    /// Ĩ, symmetric positive definite, kg m².
    pub inertia: Matrix3<T>,
    /// B, one column a joint (3×j), kg m².
    pub joint_columns: Matrix3xX<T>,
}

impl System {
    /// Ĩ(q) and B(q), with H̃ = B q̇, at joint angles `q` (j, rad).
    ///
    /// Works in body axes throughout: column k is what all that lies beyond joint k, turning as one
    /// body about that joint, adds to the angular momentum. Where only H̃ is wanted,
    /// [`System::h_tilde`] takes half the operations.
    ///
    /// # Panics
    /// `q` does not have one angle a joint.
    pub fn momentum_map<T: Scalar>(&self, q: &[T]) -> MomentumMap<T> {
        self.assert_joint_slice(q);
        let chain = &self.chain;
        let frames = joint_frames(chain, &group_rotations(chain, q));
        let in_body_axes =
            |k: usize, c: &Vector3<f64>| Frame { origin: zero(), axes: frames[k].axes }.point(c);
        let arms: Vec<Vector3<T>> = chain
            .joints
            .iter()
            .enumerate()
            .map(|(k, joint)| in_body_axes(k, &joint.coupling.arm))
            .collect();
        let across = constant_rotation(&chain.root_rotation, &constant(&chain.root.across));
        // From the point that momenta are counted about at joint k to the base's.
        let mut reach = across;
        let mut reaches = Vec::with_capacity(arms.len());
        for arm in &arms {
            reaches.push(reach);
            reach = sum(&reach, arm);
        }

        let mut beyond = Moments::zero();
        let mut columns = vec![zero(); arms.len()];
        for (k, joint) in chain.joints.iter().enumerate().rev() {
            let coupling = &joint.coupling;
            let middle = sum(&beyond.first, &in_body_axes(k, &coupling.half));
            let mut second = beyond.second.plus_outer(&middle, &arms[k]);
            if let Some(rest) = &coupling.rest {
                let turned = Symmetric::constant(rest).rotated_by(&frames[k].axes);
                second = second.plus_matrix(&turned);
            }
            let first = sum(&beyond.first, &in_body_axes(k, &coupling.first));
            beyond = Moments { first, second };
            let axis = &frames[k].axes[2];
            let spin = second.inertia().times(axis);
            columns[k] = sum(&spin, &cross(&reaches[k], &cross(axis, &first)));
        }
        let base = Symmetric::constant(&chain.root.second).rotated(&chain.root_rotation);
        let second = beyond.second.plus_outer(&beyond.first, &across).plus_matrix(&base);
        MomentumMap {
            inertia: second.inertia().to_matrix(),
            joint_columns: Matrix3xX::from_columns(&columns),
        }
    }
}
