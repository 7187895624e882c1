//! Base and arm taken together at one configuration.

use crate::algebra::{PlaneRotation, constant_rotation, offset_by};
use crate::branches::{Beyond, Branches};
use crate::sweep::{Moments, Pair, SweepRotations, TurnedCoupling};
use crate::symmetric::Symmetric;
use crate::tree::Tree;
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// Everything linear in the rates, in the axes in which the sweep ends.
pub(crate) struct Composite<T> {
    /// Ĩ, kg m².
    pub inertia: Symmetric<T>,
    /// Σ m r from the body-frame origin, kg m.
    pub first: Vector3<T>,
    /// Σ m r' and H̃, N s and N m s.
    pub relative: Pair<T>,
    pub axes: SweepAxes<T>,
}

/// The axes in which a sweep ends.
pub(crate) struct SweepAxes<T> {
    last: PlaneRotation<T>,
    root: Matrix3<f64>,
}

impl<T: Scalar> SweepAxes<T> {
    pub fn new(tree: &Tree, last: PlaneRotation<T>) -> Self {
        Self { last, root: tree.root_rotation }
    }

    pub fn to_body(&self, v: &Vector3<T>) -> Vector3<T> {
        constant_rotation(&self.root, &self.last.turn(v))
    }

    pub fn to_sweep(&self, v: &Vector3<T>) -> Vector3<T> {
        self.last.turn_back(&constant_rotation(&self.root.transpose(), v))
    }

    pub fn matrix_to_body(&self, matrix: Symmetric<T>) -> Symmetric<T> {
        matrix.turned(&self.last).rotated(&self.root)
    }
}

impl<T: Scalar> Composite<T> {
    pub fn new(tree: &Tree, q: &[T], qdot: &[T]) -> Self {
        let rotations = SweepRotations::new(tree, q);
        let mut branches = Branches::of(tree);
        let mut beyond = Beyond::nothing();
        for (k, joint) in tree.joints.iter().enumerate().rev() {
            let (coupling, rotation) = (&joint.coupling, &rotations.joints[k]);
            let Beyond { moments, pair } = beyond;
            beyond = if tree.continues_group(k + 1) {
                let turned = TurnedCoupling::new(coupling, rotation);
                let moments = moments.coupled_turned(coupling, &turned, rotation);
                Beyond { moments, pair: pair.shifted_turned(&turned) }
            } else {
                let moments = moments.twisted(joint.twist).coupled(coupling);
                let pair = pair.twisted(joint.twist).shifted(&coupling.arm);
                branches.join(Some(k), Beyond { moments, pair }).turned(rotation)
            };
            let rate = qdot[joint.coordinate];
            match &joint.slide {
                Some(slide) => beyond = slide.momenta(beyond, q[joint.coordinate], rate),
                None => beyond.pair = beyond.pair.plus_turning(&beyond.moments, rate),
            }
            if let Some(branch) = &joint.branch {
                let Beyond { moments, pair } = beyond.rotated(&branch.rotation);
                let moments = moments.coupled(&branch.coupling);
                let pair = pair.shifted(&branch.coupling.arm);
                branches.hand_over(joint.parent, Beyond { moments, pair });
                beyond = Beyond::nothing();
            }
        }
        let Beyond { moments, pair: relative } = branches.join(None, beyond);
        let root = &tree.root;
        Self {
            inertia: moments.with_base(tree).inertia(),
            first: offset_by(&moments.first, &root.first),
            relative: relative.shifted(&root.across),
            axes: SweepAxes::new(tree, rotations.last),
        }
    }
}

impl<T: Scalar> Moments<T> {
    /// Second moment of the whole system about its centre of mass.
    pub fn with_base(&self, tree: &Tree) -> Symmetric<T> {
        let root = &tree.root;
        self.second.plus_product_constant(&self.first, &root.across).plus_constant(&root.second)
    }
}
