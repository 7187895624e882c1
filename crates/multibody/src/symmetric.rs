//! Symmetric 3×3 matrices by their six entries.

use crate::algebra::{PlaneRotation, combination, plus, plus_multiple};
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// The upper triangle of a symmetric matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Symmetric<T> {
    pub xx: T,
    pub xy: T,
    pub xz: T,
    pub yy: T,
    pub yz: T,
    pub zz: T,
}

impl<T: Scalar> Symmetric<T> {
    pub fn zero() -> Self {
        let zero = T::from(0.0);
        Self { xx: zero, xy: zero, xz: zero, yy: zero, yz: zero, zz: zero }
    }

    pub fn constant(m: &Matrix3<f64>) -> Self {
        Self::zero().plus_constant(m)
    }

    pub fn plus_constant(self, m: &Matrix3<f64>) -> Self {
        Self {
            xx: plus(self.xx, m.m11),
            xy: plus(self.xy, m.m12),
            xz: plus(self.xz, m.m13),
            yy: plus(self.yy, m.m22),
            yz: plus(self.yz, m.m23),
            zz: plus(self.zz, m.m33),
        }
    }

    pub fn plus_matrix(self, m: &Self) -> Self {
        Self {
            xx: self.xx + m.xx,
            xy: self.xy + m.xy,
            xz: self.xz + m.xz,
            yy: self.yy + m.yy,
            yz: self.yz + m.yz,
            zz: self.zz + m.zz,
        }
    }

    /// Adds a matrix that has entries in its last row and column only.
    pub fn plus_along_z(self, xz: T, yz: T, zz: T) -> Self {
        Self { xz: self.xz + xz, yz: self.yz + yz, zz: self.zz + zz, ..self }
    }

    /// Adds g cᵀ + c gᵀ.
    pub fn plus_product_constant(self, g: &Vector3<T>, c: &Vector3<f64>) -> Self {
        let mixed = |entry: T, i: usize, j: usize| {
            plus_multiple(plus_multiple(entry, c[j], g[i]), c[i], g[j])
        };
        Self {
            xx: plus_multiple(self.xx, 2.0 * c.x, g.x),
            xy: mixed(self.xy, 0, 1),
            xz: mixed(self.xz, 0, 2),
            yy: plus_multiple(self.yy, 2.0 * c.y, g.y),
            yz: mixed(self.yz, 1, 2),
            zz: plus_multiple(self.zz, 2.0 * c.z, g.z),
        }
    }

    /// Adds g vᵀ + v gᵀ for a v whose z is the constant `along`.
    pub fn plus_product(self, g: &Vector3<T>, v: &Vector3<T>, along: f64) -> Self {
        Self {
            xx: self.xx + g.x * v.x * 2.0,
            xy: self.xy + (g.x * v.y + g.y * v.x),
            xz: plus_multiple(self.xz + g.z * v.x, along, g.x),
            yy: self.yy + g.y * v.y * 2.0,
            yz: plus_multiple(self.yz + g.z * v.y, along, g.y),
            zz: plus_multiple(self.zz, 2.0 * along, g.z),
        }
    }

    /// Adds g vᵀ + v gᵀ.
    pub fn plus_outer(self, g: &Vector3<T>, v: &Vector3<T>) -> Self {
        Self {
            xx: self.xx + g.x * v.x * 2.0,
            xy: self.xy + (g.x * v.y + g.y * v.x),
            xz: self.xz + (g.x * v.z + g.z * v.x),
            yy: self.yy + g.y * v.y * 2.0,
            yz: self.yz + (g.y * v.z + g.z * v.y),
            zz: self.zz + g.z * v.z * 2.0,
        }
    }

    /// R S Rᵀ for the rotation with the given columns.
    pub fn rotated_by(self, columns: &[Vector3<T>; 3]) -> Self {
        // R S Rᵀ = Σ e_i (S_i)ᵀ over the columns e_i, halved to be added with its transpose.
        let half = |x: T, y: T, z: T| {
            let [a, b, c] = columns;
            Vector3::from_fn(|i, _| (a[i] * x + b[i] * y + c[i] * z) * 0.5)
        };
        Self::zero()
            .plus_outer(&half(self.xx, self.xy, self.xz), &columns[0])
            .plus_outer(&half(self.xy, self.yy, self.yz), &columns[1])
            .plus_outer(&half(self.xz, self.yz, self.zz), &columns[2])
    }

    /// Rz S Rzᵀ. The planar block turns by the double angle without forming it:
    /// with w = s (xx − yy) + 2 c xy it becomes xx − s w, c w − xy, yy + s w.
    pub fn turned(self, rotation: &PlaneRotation<T>) -> Self {
        let PlaneRotation { sin, cos } = *rotation;
        let w = (self.xx - self.yy) * sin + self.xy * 2.0 * cos;
        let moved = w * sin;
        Self {
            xx: self.xx - moved,
            xy: w * cos - self.xy,
            xz: self.xz * cos - self.yz * sin,
            yy: self.yy + moved,
            yz: self.xz * sin + self.yz * cos,
            zz: self.zz,
        }
    }

    /// R S Rᵀ for a constant rotation.
    pub fn rotated(self, r: &Matrix3<f64>) -> Self {
        let entry = |i: usize, j: usize| {
            let both = |k: usize, l: usize| r[(i, k)] * r[(j, l)] + r[(i, l)] * r[(j, k)];
            combination([
                (r[(i, 0)] * r[(j, 0)], self.xx),
                (r[(i, 1)] * r[(j, 1)], self.yy),
                (r[(i, 2)] * r[(j, 2)], self.zz),
                (both(0, 1), self.xy),
                (both(0, 2), self.xz),
                (both(1, 2), self.yz),
            ])
        };
        Self {
            xx: entry(0, 0),
            xy: entry(0, 1),
            xz: entry(0, 2),
            yy: entry(1, 1),
            yz: entry(1, 2),
            zz: entry(2, 2),
        }
    }

    /// tr(S) 1 − S: the inertia of the second moment S.
    pub fn inertia(self) -> Self {
        Self {
            xx: self.yy + self.zz,
            xy: -self.xy,
            xz: -self.xz,
            yy: self.xx + self.zz,
            yz: -self.yz,
            zz: self.xx + self.yy,
        }
    }

    /// S v.
    pub fn times(&self, v: &Vector3<T>) -> Vector3<T> {
        Vector3::new(
            self.xx * v.x + self.xy * v.y + self.xz * v.z,
            self.xy * v.x + self.yy * v.y + self.yz * v.z,
            self.xz * v.x + self.yz * v.y + self.zz * v.z,
        )
    }

    /// S⁻¹ v by the factors L D Lᵀ of a positive definite S: fewer operations than the adjugate.
    pub fn solve(&self, v: &Vector3<T>) -> Vector3<T> {
        let inverse_x = self.xx.recip();
        let (l_yx, l_zx) = (self.xy * inverse_x, self.xz * inverse_x);
        let inverse_y = (self.yy - l_yx * self.xy).recip();
        let below = self.yz - l_yx * self.xz;
        let l_zy = below * inverse_y;
        let inverse_z = (self.zz - l_zx * self.xz - l_zy * below).recip();

        let y = v.y - l_yx * v.x;
        let z = (v.z - l_zx * v.x - l_zy * y) * inverse_z;
        let y = y * inverse_y - l_zy * z;
        let x = v.x * inverse_x - l_yx * y - l_zx * z;
        Vector3::new(x, y, z)
    }

    pub fn to_matrix(self) -> Matrix3<T> {
        let Self { xx, xy, xz, yy, yz, zz } = self;
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    }
}
