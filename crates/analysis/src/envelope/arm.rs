//! The arm's momentum and torque at given joint angles, and the most of either in a direction.

use nalgebra::{DMatrix, Vector3};
use num_dual::{Dual64, HyperDual64};
use righting_multibody::System;
use righting_scenario::JointLimits;

/// What an envelope is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    /// H_arm = H̃ = B(q) q̇, N m s.
    Momentum,
    /// T_arm = H̃' = B q̈ + Ḃ q̇, N m.
    Torque,
}

/// An arm within its limits.
#[derive(Clone, Copy)]
pub(super) struct Arm<'a> {
    pub model: &'a System,
    pub limits: &'a [JointLimits],
}

/// A motion of the arm and what it gives.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    pub angles: Vec<f64>,
    pub rates: Vec<f64>,
    pub accelerations: Vec<f64>,
    /// Momentum or torque.
    pub vector: Vector3<f64>,
}

/// B(q) and its derivatives.
struct Map {
    /// Columns b_i.
    columns: Vec<Vector3<f64>>,
    /// ∂b_i/∂q_k at `[k][i]`.
    slopes: Vec<Vec<Vector3<f64>>>,
}

impl Arm<'_> {
    pub fn joints(&self) -> usize {
        self.limits.len()
    }

    /// Largest rate of a joint, rad/s: none of a locked one.
    pub fn rate_max_rad_s(&self, joint: usize) -> f64 {
        let limits = &self.limits[joint];
        if limits.is_locked() { 0.0 } else { limits.rate_max_rad_s }
    }

    /// Largest acceleration of a joint, rad/s²: none of a locked one.
    pub fn acceleration_max_rad_s2(&self, joint: usize) -> f64 {
        let limits = &self.limits[joint];
        if limits.is_locked() { 0.0 } else { limits.acceleration_max_rad_s2 }
    }

    /// Joint angles at fractions 0…1 of their ranges; a joint without limits ranges over ±π.
    pub fn angles_at(&self, fractions: &[f64]) -> Vec<f64> {
        let angle = |(limits, fraction): (&JointLimits, &f64)| {
            let [low, high] = range(limits);
            low + fraction * (high - low)
        };
        self.limits.iter().zip(fractions).map(angle).collect()
    }

    /// Joint angles brought back into their limits.
    pub fn within_limits(&self, angles: Vec<f64>) -> Vec<f64> {
        let clamp = |(angle, limits): (f64, &JointLimits)| {
            angle.clamp(limits.angle_min_rad, limits.angle_max_rad)
        };
        angles.into_iter().zip(self.limits).map(clamp).collect()
    }

    /// H̃ of a motion.
    pub fn momentum(&self, angles: &[f64], rates: &[f64]) -> Vector3<f64> {
        self.model.h_tilde(angles, rates)
    }

    /// H̃' of a motion: the derivative of H̃ along (q̇, q̈).
    pub fn torque(&self, angles: &[f64], rates: &[f64], accelerations: &[f64]) -> Vector3<f64> {
        let along = |values: &[f64], slopes: &[f64]| -> Vec<Dual64> {
            values.iter().zip(slopes).map(|(&value, &slope)| Dual64::new(value, slope)).collect()
        };
        let moved = self.model.h_tilde(&along(angles, rates), &along(rates, accelerations));
        moved.map(|entry| entry.eps)
    }

    /// The motion through `angles` with the most of `quantity` along `direction`.
    ///
    /// Momentum is linear in q̇, torque in q̈: each joint is at its limit. Torque is quadratic in q̇.
    pub fn most_at(&self, angles: Vec<f64>, direction: &Vector3<f64>, of: Quantity) -> Motion {
        let joints = self.joints();
        match of {
            Quantity::Momentum => {
                let columns = self.model.momentum_map(&angles).joint_columns;
                let signed = |i| self.rate_max_rad_s(i).copysign(direction.dot(&columns.column(i)));
                let rates: Vec<f64> = (0..joints).map(signed).collect();
                let terms = rates.iter().enumerate().map(|(i, rate)| columns.column(i) * *rate);
                let vector = terms.sum();
                Motion { angles, rates, accelerations: vec![0.0; joints], vector }
            }
            Quantity::Torque => {
                let Map { columns, slopes } = self.map(&angles);
                let accelerations: Vec<f64> = columns
                    .iter()
                    .enumerate()
                    .map(|(i, b)| self.acceleration_max_rad_s2(i).copysign(direction.dot(b)))
                    .collect();
                let form = DMatrix::from_fn(joints, joints, |k, i| {
                    0.5 * direction.dot(&(slopes[k][i] + slopes[i][k]))
                });
                let largest: Vec<f64> = (0..joints).map(|i| self.rate_max_rad_s(i)).collect();
                let rates = super::quadratic::largest_in_box(&form, &largest);
                let mut vector: Vector3<f64> =
                    columns.iter().zip(&accelerations).map(|(b, u)| b * *u).sum();
                for (k, row) in slopes.iter().enumerate() {
                    let swept: Vector3<f64> = row.iter().zip(&rates).map(|(b, v)| b * *v).sum();
                    vector += swept * rates[k];
                }
                Motion { angles, rates, accelerations, vector }
            }
        }
    }

    /// How the component of `motion` along `direction` grows with each joint angle, all else held.
    pub fn slope(&self, motion: &Motion, direction: &Vector3<f64>, of: Quantity) -> Vec<f64> {
        let Motion { angles, rates, accelerations, .. } = motion;
        let joints = 0..self.joints();
        match of {
            Quantity::Momentum => {
                let rates: Vec<Dual64> = rates.iter().map(|&rate| rate.into()).collect();
                let along = |k: usize| {
                    let turned = |(i, &angle): (usize, &f64)| Dual64::new(angle, unit(i == k));
                    let angles: Vec<Dual64> = angles.iter().enumerate().map(turned).collect();
                    direction.dot(&self.model.h_tilde(&angles, &rates).map(|entry| entry.eps))
                };
                joints.map(along).collect()
            }
            Quantity::Torque => {
                let motions = rates.iter().zip(accelerations);
                let rates: Vec<HyperDual64> =
                    motions.map(|(&v, &u)| HyperDual64::new(v, u, 0.0, 0.0)).collect();
                let along = |k: usize| {
                    let angles: Vec<HyperDual64> = angles
                        .iter()
                        .zip(&rates)
                        .enumerate()
                        .map(|(i, (&q, v))| HyperDual64::new(q, v.re, unit(i == k), 0.0))
                        .collect();
                    let moved = self.model.h_tilde(&angles, &rates);
                    direction.dot(&moved.map(|entry| entry.eps1eps2))
                };
                joints.map(along).collect()
            }
        }
    }

    fn map(&self, angles: &[f64]) -> Map {
        let mut columns = Vec::new();
        let slopes = (0..self.joints())
            .map(|k| {
                let turned = |(i, &angle): (usize, &f64)| Dual64::new(angle, unit(i == k));
                let angles: Vec<Dual64> = angles.iter().enumerate().map(turned).collect();
                let map = self.model.momentum_map(&angles).joint_columns;
                if k == 0 {
                    columns = map.column_iter().map(|b| b.map(|entry| entry.re)).collect();
                }
                map.column_iter().map(|b| b.map(|entry| entry.eps)).collect()
            })
            .collect();
        Map { columns, slopes }
    }
}

/// The range of a joint's angle; ±π where it has no limit.
pub(super) fn range(limits: &JointLimits) -> [f64; 2] {
    use std::f64::consts::{PI, TAU};
    match (limits.angle_min_rad.is_finite(), limits.angle_max_rad.is_finite()) {
        (true, true) => [limits.angle_min_rad, limits.angle_max_rad],
        (true, false) => [limits.angle_min_rad, limits.angle_min_rad + TAU],
        (false, true) => [limits.angle_max_rad - TAU, limits.angle_max_rad],
        (false, false) => [-PI, PI],
    }
}

fn unit(is_one: bool) -> f64 {
    f64::from(u8::from(is_one))
}
