//! Dual numbers through the model against finite differences of its values.

mod support;

use nalgebra::Vector3;
use num_dual::{Dual64, HyperDual64};
use righting_multibody::System;
use righting_scalar::Scalar;
use support::{assert_near, table_one};

/// A point in general position.
fn somewhere(n: usize, seed: f64) -> Vec<f64> {
    (0..n).map(|i| (1.7 * i as f64 + seed).sin() * 0.8).collect()
}

fn reduced<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let j = system.joint_count();
    let h = Vector3::new(T::from(3.0), T::from(-2.0), T::from(5.0));
    system.reduced_angular_rate(&y[..j], &y[j..], &h).as_slice().to_vec()
}

fn full<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let (x, u) = y.split_at(13 + 2 * system.joint_count());
    system.state_derivative(x, u, None)
}

fn torques<T: Scalar>(system: &System, y: &[T]) -> Vec<T> {
    let j = system.joint_count();
    let omega = Vector3::new(y[0], y[1], y[2]);
    let (q, rest) = y[3..].split_at(j);
    system.joint_torques(&omega, q, &rest[..j], &rest[j..], None)
}

/// Both derivatives of a function at y: first along each axis, second along one axis and a direction.
macro_rules! check {
    ($f:ident, $system:expr, $y:expr) => {{
        let (system, y): (&System, &[f64]) = ($system, $y);
        let value = $f(system, y);
        let h = 1e-5;
        let along = |i: usize, step: f64, y: &[f64]| {
            let mut moved = y.to_vec();
            moved[i] += step;
            moved
        };
        let gradient = |i: usize, y: &[f64]| -> Vec<f64> {
            let mut dual: Vec<Dual64> = y.iter().map(|x| Dual64::from(*x)).collect();
            dual[i].eps = 1.0;
            $f(system, &dual).iter().map(|x| x.eps).collect()
        };
        for i in 0..y.len() {
            let (ahead, behind) = ($f(system, &along(i, h, y)), $f(system, &along(i, -h, y)));
            let difference: Vec<f64> =
                ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * h)).collect();
            let scale = value.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
            assert_near(&gradient(i, y), &difference, 1e-7, scale);

            let k = (i + 1) % y.len();
            let mut hyper: Vec<HyperDual64> = y.iter().map(|x| HyperDual64::from(*x)).collect();
            hyper[i].eps1 = 1.0;
            hyper[k].eps2 = 1.0;
            let second: Vec<f64> = $f(system, &hyper).iter().map(|x| x.eps1eps2).collect();
            let (ahead, behind) = (gradient(i, &along(k, h, y)), gradient(i, &along(k, -h, y)));
            let difference: Vec<f64> =
                ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * h)).collect();
            assert_near(&second, &difference, 1e-7, scale);
        }
    }};
}

#[test]
fn reduced_rate() {
    for (_, system) in table_one::all() {
        check!(reduced, &system, &somewhere(2 * system.joint_count(), 0.3));
    }
}

#[test]
fn state_derivative() {
    for (_, system) in table_one::all() {
        check!(full, &system, &somewhere(13 + 3 * system.joint_count(), 0.7));
    }
}

#[test]
fn joint_torques() {
    for (_, system) in table_one::all() {
        check!(torques, &system, &somewhere(3 + 3 * system.joint_count(), 1.1));
    }
}
