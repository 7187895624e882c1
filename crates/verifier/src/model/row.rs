//! One row of a Denavit–Hartenberg table.

use nalgebra::{Matrix3, Vector3};
use righting_scenario::file;

/// Which of a row's two screws comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Convention {
    /// Standard: Rz(θ + q) Tz(d) Tx(a) Rx(α). The joint turns about z of the frame before.
    Distal,
    /// Craig's: Rx(α) Tx(a) Rz(θ + q) Tz(d). The joint turns about z of the frame that the row gives.
    Proximal,
}

/// The constants of a row.
#[derive(Clone, Debug)]
pub(super) struct Row {
    a: f64,
    d: f64,
    theta: f64,
    sin_alpha: f64,
    cos_alpha: f64,
}

impl Row {
    pub fn new(link: &file::Link) -> Self {
        let (sin_alpha, cos_alpha) = link.alpha_deg.to_radians().sin_cos();
        Self { a: link.a_m, d: link.d_m, theta: link.theta_deg.to_radians(), sin_alpha, cos_alpha }
    }

    /// From the axes of the frame before, at joint angle `q` (rad): the axes of this row's frame, and
    /// its origin from the origin of the frame before. Axes are the columns of a matrix.
    pub fn follow(
        &self,
        convention: Convention,
        before: &Matrix3<f64>,
        q: f64,
    ) -> (Matrix3<f64>, Vector3<f64>) {
        let (sin, cos) = (self.theta + q).sin_cos();
        match convention {
            Convention::Distal => {
                let turned = about_z(before, sin, cos);
                let arm = turned.column(2) * self.d + turned.column(0) * self.a;
                (about_x(&turned, self.sin_alpha, self.cos_alpha), arm)
            }
            Convention::Proximal => {
                let twisted = about_x(before, self.sin_alpha, self.cos_alpha);
                let arm = twisted.column(0) * self.a + twisted.column(2) * self.d;
                (about_z(&twisted, sin, cos), arm)
            }
        }
    }
}

/// Axes turned about their own z.
fn about_z(axes: &Matrix3<f64>, sin: f64, cos: f64) -> Matrix3<f64> {
    let (x, y) = (axes.column(0), axes.column(1));
    Matrix3::from_columns(&[x * cos + y * sin, y * cos - x * sin, axes.column(2).into_owned()])
}

/// Axes turned about their own x.
fn about_x(axes: &Matrix3<f64>, sin: f64, cos: f64) -> Matrix3<f64> {
    let (y, z) = (axes.column(1), axes.column(2));
    Matrix3::from_columns(&[axes.column(0).into_owned(), y * cos + z * sin, z * cos - y * sin])
}
