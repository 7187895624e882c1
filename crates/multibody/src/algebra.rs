//! Small vector algebra that keeps operations few: constants stay `f64`, zeros are skipped.

use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// A vector of zeros.
pub(crate) fn zero<T: Scalar>() -> Vector3<T> {
    constant(&Vector3::zeros())
}

/// A constant vector.
pub(crate) fn constant<T: Scalar>(v: &Vector3<f64>) -> Vector3<T> {
    v.map(T::from)
}

/// a × b.
pub(crate) fn cross<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> Vector3<T> {
    Vector3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

/// a · b.
pub(crate) fn dot<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> T {
    a.x * b.x + a.y * b.y + a.z * b.z
}

/// a + b, one operation an entry whatever the scalar.
pub(crate) fn sum<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> Vector3<T> {
    Vector3::new(a.x + b.x, a.y + b.y, a.z + b.z)
}

/// a − b.
pub(crate) fn difference<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> Vector3<T> {
    Vector3::new(a.x - b.x, a.y - b.y, a.z - b.z)
}

/// v times a factor.
pub(crate) fn scaled<T: Scalar>(v: &Vector3<T>, factor: T) -> Vector3<T> {
    Vector3::new(v.x * factor, v.y * factor, v.z * factor)
}

/// v + c.
pub(crate) fn offset_by<T: Scalar>(v: &Vector3<T>, c: &Vector3<f64>) -> Vector3<T> {
    v.zip_map(c, plus)
}

/// x + c.
pub(crate) fn plus<T: Scalar>(x: T, c: f64) -> T {
    if c == 0.0 { x } else { x + c }
}

/// x + c y.
pub(crate) fn plus_multiple<T: Scalar>(x: T, c: f64, y: T) -> T {
    if c == 0.0 {
        x
    } else if c == 1.0 {
        x + y
    } else if c == -1.0 {
        x - y
    } else {
        x + y * c
    }
}

/// Σ c_i x_i over the terms that are not zero.
pub(crate) fn combination<T: Scalar, const N: usize>(terms: [(f64, T); N]) -> T {
    let mut total: Option<T> = None;
    // Beginning with a term of coefficient one spares a negation where the other one has −1.
    let mut ordered = terms;
    ordered.sort_by_key(|(c, _)| *c != 1.0);
    for (c, x) in ordered {
        total = match total {
            _ if c == 0.0 => total,
            Some(sum) => Some(plus_multiple(sum, c, x)),
            None if c == 1.0 => Some(x),
            None if c == -1.0 => Some(-x),
            None => Some(x * c),
        };
    }
    total.unwrap_or_else(|| T::from(0.0))
}

/// c × v.
pub(crate) fn constant_cross<T: Scalar>(c: &Vector3<f64>, v: &Vector3<T>) -> Vector3<T> {
    Vector3::new(
        combination([(c.y, v.z), (-c.z, v.y)]),
        combination([(c.z, v.x), (-c.x, v.z)]),
        combination([(c.x, v.y), (-c.y, v.x)]),
    )
}

/// M v.
pub(crate) fn constant_matrix_product<T: Scalar>(m: &Matrix3<f64>, v: &Vector3<T>) -> Vector3<T> {
    let row = |i: usize| combination([(m[(i, 0)], v.x), (m[(i, 1)], v.y), (m[(i, 2)], v.z)]);
    Vector3::new(row(0), row(1), row(2))
}

/// R v.
pub(crate) fn constant_rotation<T: Scalar>(r: &Matrix3<f64>, v: &Vector3<T>) -> Vector3<T> {
    constant_matrix_product(r, v)
}

/// Sine and cosine of an angle about the z axis: turns vectors there and back.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaneRotation<T> {
    pub sin: T,
    pub cos: T,
}

impl<T: Scalar> PlaneRotation<T> {
    /// Rz v.
    pub fn turn(&self, v: &Vector3<T>) -> Vector3<T> {
        let Self { sin, cos } = *self;
        Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
    }

    /// Rzᵀ v.
    pub fn turn_back(&self, v: &Vector3<T>) -> Vector3<T> {
        let Self { sin, cos } = *self;
        Vector3::new(v.x * cos + v.y * sin, v.y * cos - v.x * sin, v.z)
    }
}
