//! Where a frame is.

use nalgebra::{Matrix3, Vector3};

/// Where a frame is in body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Turns vectors of the frame into body axes.
    pub rotation: Matrix3<f64>,
    /// The frame's origin from the origin of the body frame, m.
    pub origin: Vector3<f64>,
}

impl Pose {
    /// The body frame itself.
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), origin: Vector3::zeros() }
    }
}
