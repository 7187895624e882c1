//! Attitude: quaternions, scalar first, Hamilton's product, turning body vectors into inertial ones.

use crate::algebra::{cross, difference, dot, scaled, sum};
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// A quaternion w + x i + y j + z k. Of unit length, it turns vectors from body to inertial axes.
///
/// No operation normalises: along an integrated trajectory the length is what the integrator makes
/// of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quaternion<T> {
    /// Scalar part.
    pub w: T,
    /// Vector part.
    pub vector: Vector3<T>,
}

impl<T: Scalar> Quaternion<T> {
    /// Body axes along inertial axes.
    pub fn identity() -> Self {
        Self::new(T::from(1.0), T::from(0.0), T::from(0.0), T::from(0.0))
    }

    /// From its four components, scalar first.
    pub fn new(w: T, x: T, y: T, z: T) -> Self {
        Self { w, vector: Vector3::new(x, y, z) }
    }

    /// From an array, scalar first.
    pub fn from_array([w, x, y, z]: [T; 4]) -> Self {
        Self::new(w, x, y, z)
    }

    /// To an array, scalar first.
    pub fn to_array(self) -> [T; 4] {
        [self.w, self.vector.x, self.vector.y, self.vector.z]
    }

    /// The rotation by `angle_rad` about a unit axis.
    pub fn from_axis_angle(axis: &Vector3<T>, angle_rad: T) -> Self {
        let (sin, cos) = (angle_rad * 0.5).sin_cos();
        Self { w: cos, vector: scaled(axis, sin) }
    }

    /// w − x i − y j − z k: the inverse of a unit quaternion.
    pub fn conjugate(self) -> Self {
        Self { w: self.w, vector: self.vector.map(|entry| -entry) }
    }

    /// The Hamilton product self ⊗ other: first `other`, then `self`.
    pub fn product(&self, other: &Self) -> Self {
        let mixed = sum(&scaled(&other.vector, self.w), &scaled(&self.vector, other.w));
        Self {
            w: self.w * other.w - dot(&self.vector, &other.vector),
            vector: sum(&mixed, &cross(&self.vector, &other.vector)),
        }
    }

    /// w² + x² + y² + z².
    pub fn norm_squared(&self) -> T {
        self.w * self.w + dot(&self.vector, &self.vector)
    }

    /// The same direction at unit length.
    pub fn normalized(&self) -> Self {
        let inverse = self.norm_squared().sqrt().recip();
        Self { w: self.w * inverse, vector: scaled(&self.vector, inverse) }
    }

    /// C v, from body to inertial axes.
    pub fn to_inertial(&self, v: &Vector3<T>) -> Vector3<T> {
        let twice = cross(&self.vector, v).map(|entry| entry * 2.0);
        sum(&sum(v, &scaled(&twice, self.w)), &cross(&self.vector, &twice))
    }

    /// Cᵀ v, from inertial to body axes.
    pub fn to_body(&self, v: &Vector3<T>) -> Vector3<T> {
        let twice = cross(&self.vector, v).map(|entry| entry * 2.0);
        sum(&difference(v, &scaled(&twice, self.w)), &cross(&self.vector, &twice))
    }

    /// C, whose columns are the body axes in inertial components.
    pub fn rotation_matrix(&self) -> Matrix3<T> {
        let one = T::from(1.0);
        let (x, y, z) = (self.vector.x, self.vector.y, self.vector.z);
        let (x2, y2, z2) = (x * 2.0, y * 2.0, z * 2.0);
        let (wx, wy, wz) = (self.w * x2, self.w * y2, self.w * z2);
        let (xx, yy, zz) = (x * x2, y * y2, z * z2);
        let (xy, xz, yz) = (x * y2, x * z2, y * z2);
        Matrix3::new(
            one - (yy + zz),
            xy - wz,
            xz + wy,
            xy + wz,
            one - (xx + zz),
            yz - wx,
            xz - wy,
            yz + wx,
            one - (xx + yy),
        )
    }

    /// q̇ = ½ q ⊗ (0, ω) for an angular rate ω in body axes, rad/s.
    pub fn rate(&self, angular_rate: &Vector3<T>) -> Self {
        let half = angular_rate.map(|entry| entry * 0.5);
        Self {
            w: -dot(&self.vector, &half),
            vector: sum(&scaled(&half, self.w), &cross(&self.vector, &half)),
        }
    }

    /// e_v = vec(q_d⁻¹ ⊗ q), the paper's attitude error: the axis times the sine of half the angle
    /// from the desired attitude to this one.
    pub fn error_vector(&self, desired: &Self) -> Vector3<T> {
        let inverse = desired.conjugate();
        let mixed = sum(&scaled(&self.vector, inverse.w), &scaled(&inverse.vector, self.w));
        sum(&mixed, &cross(&inverse.vector, &self.vector))
    }
}

impl Quaternion<f64> {
    /// Unit axis and angle in [0, π] of a unit quaternion's rotation; the x axis if there is none.
    pub fn to_axis_angle(&self) -> (Vector3<f64>, f64) {
        let length = self.vector.norm();
        if length == 0.0 {
            return (Vector3::x(), 0.0);
        }
        let sign = if self.w < 0.0 { -1.0 } else { 1.0 };
        (self.vector * (sign / length), 2.0 * length.atan2(self.w.abs()))
    }

    /// Angle between two attitudes in [0, π], rad, whatever the signs of the quaternions.
    pub fn angle_to(&self, other: &Self) -> f64 {
        self.conjugate().product(other).to_axis_angle().1
    }
}
