//! The inertia nearest to a matrix that is none.

use nalgebra::{Matrix3, Vector3};

/// The inertia matrix of a rigid body that is nearest to `matrix` in the Frobenius norm, kg m².
///
/// A body's inertia is J = tr(S) 1 − S with a second moment S = ∫ x xᵀ dm that has no negative
/// eigenvalue. The antisymmetric part of `matrix` is at a right angle to all of these, and the norm
/// does not change with the axes, so the nearest one has the principal axes of the symmetric part.
/// Its principal moments are the nearest
///
/// ```text
/// λ_i = Σ_k s_k − s_i,   s ≥ 0,
/// ```
///
/// to those of the symmetric part: a least-squares problem in three variables. Its solution is the
/// unconstrained one over those s that are not zero, of which there are eight choices; all are tried.
/// A symmetric matrix that a body can have comes back as it is, and so does the symmetric part of one
/// whose entries are not all finite.
///
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use righting_multibody::nearest_inertia;
///
/// // A planar model's tensor: a moment about z alone.
/// let planar = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, 6.0));
/// let nearest = Matrix3::from_diagonal(&Vector3::new(2.0, 2.0, 4.0));
/// assert!((nearest_inertia(&planar) - nearest).norm() < 1e-14);
/// ```
pub fn nearest_inertia(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    let symmetric = (matrix + matrix.transpose()) * 0.5;
    let size = symmetric.amax();
    let is_finite = symmetric.iter().all(|entry| entry.is_finite());
    if size == 0.0 || !is_finite {
        return symmetric;
    }
    let mut eigen = (symmetric / size).symmetric_eigen();
    let Some(moments) = nearest_moments(&eigen.eigenvalues) else { return symmetric };
    eigen.eigenvalues = moments * size;
    let nearest = eigen.recompose();
    (nearest + nearest.transpose()) * 0.5
}

/// The principal moments nearest to `given` that a body can have; none if it can have those.
fn nearest_moments(given: &Vector3<f64>) -> Option<Vector3<f64>> {
    // λ = A s has AᵀA = 1 + 1 1ᵀ and Aᵀ λ = tr(λ) − λ_i, on any choice of the variables too.
    let b = given.map(|moment| given.sum() - moment);
    let all = given.map(|moment| given.sum() / 2.0 - moment);
    if all.min() >= 0.0 {
        return None;
    }
    let mut candidates = vec![Vector3::zeros()];
    for i in 0..3 {
        let mut alone = Vector3::zeros();
        alone[i] = b[i] / 2.0;
        candidates.push(alone);
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let mut pair = Vector3::zeros();
        pair[j] = (2.0 * b[j] - b[k]) / 3.0;
        pair[k] = (2.0 * b[k] - b[j]) / 3.0;
        candidates.push(pair);
    }
    let moments = |s: Vector3<f64>| s.map(|own| s.sum() - own);
    candidates
        .into_iter()
        .filter(|s| s.min() >= 0.0)
        .map(moments)
        .min_by(|a, b| (a - given).norm().total_cmp(&(b - given).norm()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Part;
    use crate::inertia::{Definiteness, check};
    use nalgebra::Rotation3;
    use proptest::prelude::*;

    fn matrix(moments: [f64; 3], axes: [f64; 3]) -> Matrix3<f64> {
        let turn = Rotation3::new(Vector3::from(axes));
        turn.matrix() * Matrix3::from_diagonal(&moments.into()) * turn.matrix().transpose()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        /// The nearest point of a convex set: what leads from it to the matrix is at no acute angle to
        /// what leads from it to any other point of the set.
        #[test]
        fn nothing_that_a_body_can_have_is_nearer(
            entries in prop::array::uniform9(-1.0..1.0_f64),
            second in prop::array::uniform3(0.0..2.0_f64),
            axes in prop::array::uniform3(-3.0..3.0_f64),
            exponent in -12..12_i32,
        ) {
            let size = 10.0_f64.powi(exponent);
            let given = Matrix3::from_row_slice(&entries) * size;
            let nearest = nearest_inertia(&given);
            prop_assert!(check(Part::Base, &nearest, Definiteness::Semidefinite).is_ok());
            let [x, y, z] = second;
            let other = matrix([y + z, x + z, x + y], axes) * size;
            let along = (given - nearest).dot(&(other - nearest));
            prop_assert!(along <= 1e-12 * size * size, "{along} of {size}");
            // It is a projection: the second time nothing moves.
            let again = nearest_inertia(&nearest);
            prop_assert!((again - nearest).norm() <= 1e-14 * size);
        }

        #[test]
        fn what_a_body_can_have_stays(
            second in prop::array::uniform3(0.0..2.0_f64),
            axes in prop::array::uniform3(-3.0..3.0_f64),
        ) {
            let [x, y, z] = second;
            let given = matrix([y + z, x + z, x + y], axes);
            prop_assert!((nearest_inertia(&given) - given).norm() <= 1e-14);
        }
    }

    #[test]
    fn known_cases() {
        let diagonal = |x, y, z| Matrix3::from_diagonal(&Vector3::new(x, y, z));
        for (given, nearest) in [
            // One inequality broken: the moments give way as the plane's normal says.
            (diagonal(1.0, 1.0, 2.3), diagonal(1.1, 1.1, 2.2)),
            // A negative moment: that of a rod.
            (diagonal(-0.5, 1.0, 1.0), diagonal(0.0, 1.0, 1.0)),
            // Nothing of it is left.
            (diagonal(-1.0, -1.0, 0.5), Matrix3::zeros()),
        ] {
            assert!((nearest_inertia(&given) - nearest).norm() < 1e-14, "{given}");
        }
        let no_number = diagonal(f64::NAN, 1.0, 1.0);
        assert!(nearest_inertia(&no_number)[(0, 0)].is_nan());
    }
}
