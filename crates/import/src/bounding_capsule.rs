//! Small capsules around points.

use nalgebra::{Matrix3, Vector3};

use crate::shape::Capsule;

/// Steps towards the center of the smallest circle around points; after n its radius is within 1/n.
const CIRCLE_STEPS: usize = 200;
/// Of more points than this only some say where the center is; the radius is that of all.
const CIRCLE_POINTS: usize = 2000;

/// A capsule that holds all `points`, of small volume: the smallest of those along the principal axes of
/// the points' spread and along the axes of their frame, and of the spheres about as many centers.
///
/// Across an axis the points are held by the circle of Bădoiu and Clarkson (*Smaller core-sets for balls*,
/// SODA 2003); along it the caps are as far in as every point allows. A point at the origin stands for none.
pub(crate) fn bounding_capsule(points: &[Vector3<f64>]) -> Capsule {
    let axes = frame_axes().into_iter().chain(principal_axes(points));
    let candidates = axes.flat_map(|axis| {
        let along = capsule_along(&axis, points);
        [along, sphere(along.ends_m[0].lerp(&along.ends_m[1], 0.5), points)]
    });
    let smallest = candidates.min_by(|a, b| a.volume_m3().total_cmp(&b.volume_m3()));
    smallest.unwrap_or(Capsule { ends_m: [Vector3::zeros(); 2], radius_m: 0.0 })
}

fn frame_axes() -> [Vector3<f64>; 3] {
    [Vector3::x(), Vector3::y(), Vector3::z()]
}

fn principal_axes(points: &[Vector3<f64>]) -> [Vector3<f64>; 3] {
    let mean = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let spread: Matrix3<f64> =
        points.iter().map(|point| (point - mean) * (point - mean).transpose()).sum();
    let axes = spread.symmetric_eigen().eigenvectors;
    [0, 1, 2].map(|index| axes.column(index).into_owned())
}

fn sphere(center: Vector3<f64>, points: &[Vector3<f64>]) -> Capsule {
    let farthest = points.iter().map(|point| (point - center).norm()).fold(0.0, f64::max);
    Capsule { ends_m: [center; 2], radius_m: farthest }
}

/// The capsule along `axis`, a unit vector, of the smallest radius, and with that of the smallest length.
fn capsule_along(axis: &Vector3<f64>, points: &[Vector3<f64>]) -> Capsule {
    let across = |point: &Vector3<f64>| point - axis * axis.dot(point);
    let mut center = points.first().map(across).unwrap_or_default();
    let some: Vec<Vector3<f64>> =
        points.iter().step_by(points.len() / CIRCLE_POINTS + 1).map(across).collect();
    for step in 1..=CIRCLE_STEPS {
        let distance_squared = |point: &Vector3<f64>| (point - center).norm_squared();
        let farthest =
            some.iter().max_by(|a, b| distance_squared(a).total_cmp(&distance_squared(b)));
        if let Some(farthest) = farthest {
            center += (farthest - center) / (step + 1) as f64;
        }
    }
    let distance = |point: &Vector3<f64>| (across(point) - center).norm();
    let radius_m = points.iter().map(distance).fold(0.0, f64::max);
    // A cap whose center is at z holds a point at ζ that is ρ off the axis where |ζ − z| ≤ √(R² − ρ²).
    let reach = |point: &Vector3<f64>| (radius_m.powi(2) - distance(point).powi(2)).max(0.0).sqrt();
    let high = points.iter().map(|point| axis.dot(point) - reach(point));
    let low = points.iter().map(|point| axis.dot(point) + reach(point));
    let high = high.fold(f64::NEG_INFINITY, f64::max);
    let low = low.fold(f64::INFINITY, f64::min);
    // Where one sphere of this radius is long enough, it sits between the two.
    let (low, high) =
        if low <= high { (low, high) } else { ((low + high) / 2.0, (low + high) / 2.0) };
    let at = |z: f64| if z.is_finite() { center + axis * z } else { center };
    Capsule { ends_m: [at(low), at(high)], radius_m }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn distance(point: &Vector3<f64>, capsule: &Capsule) -> f64 {
        let [from, to] = capsule.ends_m;
        let along = to - from;
        let share = along.dot(&(point - from)) / along.norm_squared().max(f64::MIN_POSITIVE);
        (point - from - along * share.clamp(0.0, 1.0)).norm()
    }

    proptest! {
        #[test]
        fn every_point_is_inside(points in prop::collection::vec(prop::array::uniform3(-2.0..2.0_f64), 1..40)) {
            let points: Vec<Vector3<f64>> = points.into_iter().map(Vector3::from).collect();
            let capsule = bounding_capsule(&points);
            for point in &points {
                prop_assert!(distance(point, &capsule) <= capsule.radius_m * (1.0 + 1e-12) + 1e-15);
            }
        }
    }

    #[test]
    fn a_long_box_and_a_disc_are_held_closely() {
        let corners = |size: [f64; 3]| -> Vec<Vector3<f64>> {
            (0..8)
                .map(|index| {
                    let half =
                        |axis: usize| size[axis] * if index >> axis & 1 == 0 { -0.5 } else { 0.5 };
                    Vector3::new(half(0), half(1), half(2))
                })
                .collect()
        };
        let long = bounding_capsule(&corners([0.06, 0.08, 1.0]));
        // The circle is found to half a percent.
        assert!((long.radius_m - 0.05).abs() < 3e-4, "{long:?}");
        assert!(((long.ends_m[1] - long.ends_m[0]).norm() - 1.0).abs() < 0.02, "{long:?}");
        let cube = bounding_capsule(&corners([1.0; 3]));
        assert!(cube.volume_m3() <= 4.0 / 3.0 * std::f64::consts::PI * 0.75_f64.powf(1.5) * 1.01);
    }
}
