//! The connection and its curvature at a posture.

use nalgebra::{DVector, Vector3};
use righting_multibody::System;

/// Step of the connection's differences, rad.
const DIFFERENCE_RAD: f64 = 1e-4;

/// The columns of A at joint angles `angles_rad`: the base's rate (body axes) for each joint's unit rate.
///
/// # Panics
/// `angles_rad` does not have one angle a joint.
pub fn connection(model: &System, angles_rad: &[f64]) -> Vec<Vector3<f64>> {
    let joints = angles_rad.len();
    (0..joints)
        .map(|joint| {
            let mut rates = vec![0.0; joints];
            rates[joint] = 1.0;
            model.reduced_angular_rate(angles_rad, &rates, &Vector3::zeros())
        })
        .collect()
}

/// The curvature F of the connection at a posture: a vector (body axes, rad/rad²) for every two joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Curvature {
    joints: usize,
    values: Vec<Vector3<f64>>,
}

impl Curvature {
    /// At joint angles `angles_rad`, by central differences of the connection.
    ///
    /// # Panics
    /// `angles_rad` does not have one angle a joint.
    pub fn at(model: &System, angles_rad: &[f64]) -> Self {
        let joints = angles_rad.len();
        let here = connection(model, angles_rad);
        let slopes: Vec<Vec<Vector3<f64>>> = (0..joints)
            .map(|joint| {
                let at = |step: f64| {
                    let mut moved = angles_rad.to_vec();
                    moved[joint] += step;
                    connection(model, &moved)
                };
                let (after, before) = (at(DIFFERENCE_RAD), at(-DIFFERENCE_RAD));
                after.iter().zip(&before).map(|(a, b)| (a - b) / (2.0 * DIFFERENCE_RAD)).collect()
            })
            .collect();
        let pairs = (0..joints).flat_map(|i| (0..joints).map(move |j| (i, j)));
        let values = pairs.map(|(i, j)| slopes[i][j] - slopes[j][i] + here[i].cross(&here[j]));
        Self { joints, values: values.collect() }
    }

    /// Number of joints j.
    pub fn joints(&self) -> usize {
        self.joints
    }

    /// F_ij of joints `i` and `j`, counted from zero.
    pub fn between(&self, i: usize, j: usize) -> Vector3<f64> {
        self.values[i * self.joints + j]
    }

    /// Σ_ij c_i s_j F_ij: how far the base turns, a unit of area, along a small loop in the plane of two
    /// orthogonal unit vectors of joint space, from `cosine` towards `sine`.
    pub fn turned(&self, cosine: &DVector<f64>, sine: &DVector<f64>) -> Vector3<f64> {
        let pairs = (0..self.joints).flat_map(|i| (0..self.joints).map(move |j| (i, j)));
        pairs.map(|(i, j)| self.between(i, j) * (cosine[i] * sine[j])).sum()
    }
}
