//! The angular momentum as a linear map of the rates.

use crate::algebra::{constant, constant_rotation, cross, difference, scaled, sum, zero};
use crate::branches::{Beyond, Branches};
use crate::coupling::Coupling;
use crate::kinematics::joint_frames;
use crate::sweep::Moments;
use crate::symmetric::Symmetric;
use crate::system::System;
use nalgebra::{Matrix3, Matrix3xX, Vector3};
use righting_scalar::Scalar;

/// Ĩ(q) and B(q) of the angular momentum H = Ĩ ω + B q̇ about the system's centre of mass, body axes.
#[derive(Debug, Clone, PartialEq)]
pub struct MomentumMap<T> {
    /// Ĩ, symmetric positive definite, kg m².
    pub inertia: Matrix3<T>,
    /// B, one column a joint (3×j), kg m²; kg m where the joint slides.
    pub joint_columns: Matrix3xX<T>,
}

impl System {
    /// Ĩ(q) and B(q), with H̃ = B q̇, at joint coordinates `q` (j; rad or m).
    ///
    /// Works in body axes throughout: column k is what all that lies beyond joint k, turning as one
    /// body about that joint or sliding along it, adds to the angular momentum. Where only H̃ is wanted,
    /// [`System::h_tilde`] takes half the operations.
    ///
    /// # Panics
    /// `q` does not have one angle a joint.
    pub fn momentum_map<T: Scalar>(&self, q: &[T]) -> MomentumMap<T> {
        self.assert_joint_slice(q);
        let tree = &self.tree;
        let frames = joint_frames(tree, q);
        let turned = |k: Option<usize>, c: &Vector3<f64>| match k {
            Some(k) => frames[k].vector(c),
            None => constant(c),
        };
        let coupled = |k: Option<usize>, coupling: &Coupling, beyond: &Moments<T>| {
            let arm = turned(k, &coupling.arm);
            let middle = sum(&beyond.first, &turned(k, &coupling.half));
            let mut second = beyond.second.plus_outer(&middle, &arm);
            if let Some(rest) = &coupling.rest {
                let rest = Symmetric::constant(rest);
                let rest = k.map_or(rest, |k| rest.rotated_by(&frames[k].axes));
                second = second.plus_matrix(&rest);
            }
            Moments { first: sum(&beyond.first, &turned(k, &coupling.first)), second }
        };
        // Inward: what lies beyond each joint, from its origin, and the first moment of what goes on from
        // it and of what branches off, from the origin of the joint where that begins.
        let mut branches = Branches::of(tree);
        let mut beyond = Moments::zero();
        let mut all = vec![Moments::zero(); frames.len()];
        let mut onward = vec![zero(); frames.len()];
        let mut branching = vec![zero(); frames.len()];
        for (k, joint) in tree.joints.iter().enumerate().rev() {
            beyond = coupled(Some(k), &joint.coupling, &beyond);
            onward[k] = beyond.first;
            beyond = branches.join(Some(k), Beyond::at_rest(beyond)).moments;
            all[k] = beyond;
            if let Some(slide) = &joint.slide {
                beyond = slide.moments_along(beyond, &frames[k].axes[2], q[joint.coordinate]);
            }
            if let Some(branch) = &joint.branch {
                let shifted = coupled(joint.parent, &branch.coupling, &beyond);
                branching[k] = shifted.first;
                branches.hand_over(joint.parent, Beyond::at_rest(shifted));
                beyond = Moments::zero();
            }
        }
        let whole = branches.join(None, Beyond::at_rest(beyond)).moments;

        // Outward: from the point that momenta are counted about at a joint to the base's. Where several
        // come together, what the others have of the first moment moves the center that counts.
        let across = constant_rotation(&tree.root_rotation, &constant(&tree.root.across));
        let of_others = |reach: &Vector3<T>, all: &Moments<T>, own: &Vector3<T>| {
            let others = difference(&all.first, own);
            difference(reach, &scaled(&others, T::from(self.total_mass().recip())))
        };
        // Of each joint, from the origin of K, so that a slide is behind.
        let mut reaches: Vec<Vector3<T>> = Vec::with_capacity(frames.len());
        for (k, joint) in tree.joints.iter().enumerate() {
            let to_parent = joint.parent.map_or(across, |parent| reaches[parent]);
            let reach = match (&joint.branch, joint.parent) {
                (Some(branch), parent) => {
                    let reach = sum(&to_parent, &turned(parent, &branch.coupling.arm));
                    of_others(&reach, parent.map_or(&whole, |parent| &all[parent]), &branching[k])
                }
                (None, Some(parent)) => {
                    let reach =
                        sum(&to_parent, &turned(Some(parent), &tree.joints[parent].coupling.arm));
                    match tree.has_branches(parent) {
                        true => of_others(&reach, &all[parent], &onward[parent]),
                        false => reach,
                    }
                }
                (None, None) => to_parent,
            };
            reaches.push(match &joint.slide {
                Some(slide) => {
                    sum(&reach, &slide.arm_along(&frames[k].axes[2], q[joint.coordinate]))
                }
                None => reach,
            });
        }

        let mut columns = vec![zero(); frames.len()];
        for (k, joint) in tree.joints.iter().enumerate() {
            let Moments { first, second } = &all[k];
            let axis = &frames[k].axes[2];
            columns[joint.coordinate] = match &joint.slide {
                Some(slide) => slide.column(&all[k], axis, &reaches[k]),
                None => {
                    let spin = second.inertia().times(axis);
                    sum(&spin, &cross(&reaches[k], &cross(axis, first)))
                }
            };
        }
        let base = Symmetric::constant(&tree.root.second).rotated(&tree.root_rotation);
        let second = whole.second.plus_outer(&whole.first, &across).plus_matrix(&base);
        MomentumMap {
            inertia: second.inertia().to_matrix(),
            joint_columns: Matrix3xX::from_columns(&columns),
        }
    }
}
