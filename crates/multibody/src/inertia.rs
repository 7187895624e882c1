//! Constant mass properties of rigid bodies, and what an inertia matrix must satisfy.

use crate::error::{ModelError, Part};
use nalgebra::{Matrix3, Vector3};

/// Relative slack for symmetry, definiteness and the triangle inequality: what printing and
/// re-reading a matrix may cost.
const TOLERANCE: f64 = 1e-9;

/// Whether a principal moment may be zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Definiteness {
    Positive,
    Semidefinite,
}

/// Checks that some body of positive density has this inertia matrix about its centre of mass.
pub(crate) fn check(
    part: Part,
    inertia: &Matrix3<f64>,
    definiteness: Definiteness,
) -> Result<(), ModelError> {
    if let Some(value) = inertia.iter().copied().find(|value| !value.is_finite()) {
        return Err(ModelError::NotFinite { part, quantity: "inertia_kg_m2", value });
    }
    let slack = TOLERANCE * inertia.amax();
    for (row, column) in [(0, 1), (0, 2), (1, 2)] {
        let (upper, lower) = (inertia[(row, column)], inertia[(column, row)]);
        if (upper - lower).abs() > slack {
            return Err(ModelError::NotSymmetric { part, row, column, upper, lower });
        }
    }
    let mut moments = ((inertia + inertia.transpose()) * 0.5).symmetric_eigenvalues();
    moments.as_mut_slice().sort_by(f64::total_cmp);
    let moments_kg_m2 = moments.data.0[0];
    let [smallest, middle, largest] = moments_kg_m2;
    if !(largest.is_finite() && (smallest + middle).is_finite()) {
        return Err(ModelError::Overflow { part });
    }
    let zero_allowed = definiteness == Definiteness::Semidefinite;
    let positive = if zero_allowed { smallest >= -slack } else { smallest > slack };
    if !positive {
        return Err(ModelError::NotPositive { part, moments_kg_m2, zero_allowed });
    }
    if largest > smallest + middle + slack {
        return Err(ModelError::TriangleInequality { part, moments_kg_m2 });
    }
    Ok(())
}

/// Mass, first moment ∫ x dm and second moment ∫ x xᵀ dm of a rigid body about an origin.
///
/// The second moment S stands in for the inertia J = tr(S) 1 − S: shifting and rotating it takes
/// fewer operations, and a slender rod's has rank one.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MassMoments {
    pub mass: f64,
    pub first: Vector3<f64>,
    pub second: Matrix3<f64>,
}

impl MassMoments {
    pub fn zero() -> Self {
        Self { mass: 0.0, first: Vector3::zeros(), second: Matrix3::zeros() }
    }

    /// A body of the given inertia about its centre of mass.
    pub fn of_body(mass: f64, center: Vector3<f64>, inertia: &Matrix3<f64>) -> Self {
        let second = second_moment(inertia) + center * center.transpose() * mass;
        Self { mass, first: center * mass, second }
    }

    /// A uniform slender rod from the origin to `end`.
    pub fn of_rod(mass: f64, end: Vector3<f64>) -> Self {
        Self { mass, first: end * (mass / 2.0), second: end * end.transpose() * (mass / 3.0) }
    }

    /// Both bodies taken as one.
    pub fn joined(&self, other: &Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }

    /// The moments in the axes and about the origin from which this body's frame is seen rotated by
    /// `rotation` and displaced by `position`.
    pub fn placed(&self, rotation: &Matrix3<f64>, position: &Vector3<f64>) -> Self {
        let first = rotation * self.first;
        let cross = first * position.transpose();
        Self {
            mass: self.mass,
            first: first + position * self.mass,
            second: rotation * self.second * rotation.transpose()
                + cross
                + cross.transpose()
                + position * position.transpose() * self.mass,
        }
    }
}

/// ∫ x xᵀ dm of a body with inertia ∫ (x² 1 − x xᵀ) dm.
pub(crate) fn second_moment(inertia: &Matrix3<f64>) -> Matrix3<f64> {
    let symmetric = (inertia + inertia.transpose()) * 0.5;
    Matrix3::from_diagonal_element(symmetric.trace() / 2.0) - symmetric
}

/// Inertia ∫ (x² 1 − x xᵀ) dm of a body with second moment ∫ x xᵀ dm.
pub(crate) fn inertia(second_moment: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(second_moment.trace()) - second_moment
}

/// m/12 (‖s‖² 1 − s sᵀ), about the centre of a slender rod.
pub(crate) fn rod_inertia(mass: f64, segment: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::from_diagonal_element(segment.norm_squared()) - segment * segment.transpose())
        * (mass / 12.0)
}
