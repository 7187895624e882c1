//! Base and arm taken together at one configuration.

use crate::algebra::{PlaneRotation, constant_rotation, offset_by};
use crate::chain::Chain;
use crate::sweep::{Moments, Pair, SweepRotations, TurnedCoupling};
use crate::symmetric::Symmetric;
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
    pub fn new(chain: &Chain, last: PlaneRotation<T>) -> Self {
        Self { last, root: chain.root_rotation }
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
    pub fn new(chain: &Chain, q: &[T], qdot: &[T]) -> Self {
        let rotations = SweepRotations::new(chain, q);
        let mut moments = Moments::zero();
        let mut relative = Pair::zero();
        for (k, joint) in chain.joints.iter().enumerate().rev() {
            let (coupling, rotation) = (&joint.coupling, &rotations.joints[k]);
            if chain.continues_group(k + 1) {
                let turned = TurnedCoupling::new(coupling, rotation);
                moments = moments.coupled_turned(coupling, &turned, rotation);
                relative = relative.shifted_turned(&turned);
            } else {
                moments = moments.twisted(joint.twist).coupled(coupling).turned(rotation);
                relative = relative.twisted(joint.twist).shifted(&coupling.arm).turned(rotation);
            }
            relative = relative.plus_turning(&moments, qdot[k]);
        }
        let root = &chain.root;
        Self {
            inertia: moments.with_base(chain).inertia(),
            first: offset_by(&moments.first, &root.first),
            relative: relative.shifted(&root.across),
            axes: SweepAxes::new(chain, rotations.last),
        }
    }
}

impl<T: Scalar> Moments<T> {
    /// Second moment of the whole system about its centre of mass.
    pub fn with_base(&self, chain: &Chain) -> Symmetric<T> {
        let root = &chain.root;
        self.second.plus_product_constant(&self.first, &root.across).plus_constant(&root.second)
    }
}
