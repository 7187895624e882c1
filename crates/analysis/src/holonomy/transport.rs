//! The base's attitude along a path of the arm.

use nalgebra::Vector3;
use righting_multibody::{Quaternion, System};

/// A path of the joints over a parameter s.
pub(super) trait JointPath {
    /// Joint angles at `s`, rad, and their derivatives with respect to s.
    fn at(&self, s: f64) -> (Vec<f64>, Vec<f64>);
}

/// The rotation that the base makes, without momentum, while s goes from `from` to `to`: what its attitude
/// (body → inertial) is multiplied by from the right.
///
/// One step of the fourth-order Magnus method on Gauss's two points (Iserles & Nørsett, *Phil. Trans. R.
/// Soc. A* 357, 1999). Their equation has ω on the left of R, this one on its right, hence the sign of the
/// commutator.
pub(super) fn step(model: &System, path: &impl JointPath, from: f64, to: f64) -> Quaternion<f64> {
    let span = to - from;
    let middle = from + 0.5 * span;
    let offset = span * 3.0_f64.sqrt() / 6.0;
    let rate = |s: f64| {
        let (angles, rates) = path.at(s);
        model.reduced_angular_rate(&angles, &rates, &Vector3::zeros())
    };
    let (early, late) = (rate(middle - offset), rate(middle + offset));
    let commutator = early.cross(&late) * (3.0_f64.sqrt() / 12.0 * span * span);
    rotation(&((early + late) * (0.5 * span) + commutator))
}

/// The rotation that the base makes along the whole of a path, s from 0 to 1, in equal steps.
pub(super) fn along(model: &System, path: &impl JointPath, steps: usize) -> Quaternion<f64> {
    let at = |k: usize| k as f64 / steps as f64;
    (0..steps).fold(Quaternion::identity(), |attitude, k| {
        attitude.product(&step(model, path, at(k), at(k + 1)))
    })
}

/// The rotation of a rotation vector, rad.
pub(super) fn rotation(vector: &Vector3<f64>) -> Quaternion<f64> {
    let angle = vector.norm();
    match vector.try_normalize(f64::MIN_POSITIVE) {
        Some(axis) => Quaternion::from_axis_angle(&axis, angle),
        None => Quaternion::identity(),
    }
}

/// The rotation vector of a unit quaternion, rad; its length is in [0, π].
pub(super) fn rotation_vector(attitude: &Quaternion<f64>) -> Vector3<f64> {
    let (axis, angle) = attitude.to_axis_angle();
    axis * angle
}
