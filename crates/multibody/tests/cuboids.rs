//! Distances of segments from boxes against a search, with their derivatives, degenerate cases included.

use nalgebra::Vector3;
use num_dual::{Dual64, HyperDual64};
use proptest::prelude::*;
use righting_multibody::{Cuboid, Segment};
use righting_scalar::Scalar;

type Case = (Cuboid, [Vector3<f64>; 2]);

fn distance<T: Scalar>(cuboid: &Cuboid, ends: &[Vector3<T>; 2]) -> T {
    cuboid.signed_distance(&Segment::new(ends[0], ends[1]))
}

/// The distance of the nearest of all points, by a ternary search: it is convex along the segment.
fn searched(cuboid: &Cuboid, [a, b]: &[Vector3<f64>; 2]) -> f64 {
    let at = |s: f64| {
        let p = a + (b - a) * s - cuboid.center_m;
        (p.abs() - cuboid.half_m).map(|beyond| beyond.max(0.0)).norm()
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let third = (high - low) / 3.0;
        if at(low + third) < at(high - third) { high -= third } else { low += third }
    }
    at(low).min(at(high)).min(at(0.0)).min(at(1.0))
}

/// How far the segment has to go in a direction of length one to leave the box on that side.
fn way_out(cuboid: &Cuboid, [a, b]: &[Vector3<f64>; 2], direction: &Vector3<f64>) -> f64 {
    let [_, top] = cuboid.extent_m(direction);
    top - a.dot(direction).min(b.dot(direction))
}

fn point(size: f64) -> impl Strategy<Value = Vector3<f64>> + Clone {
    [-size..size, -size..size, -size..size].prop_map(Vector3::from)
}

fn edges() -> impl Strategy<Value = Vector3<f64>> {
    let edge = || prop_oneof![6 => 0.05..1.0_f64, 1 => Just(0.01), 1 => Just(0.0)];
    [edge(), edge(), edge()].prop_map(Vector3::from)
}

/// Boxes, thin ones too, and segments anywhere about them.
fn general_case() -> impl Strategy<Value = Case> {
    (point(0.3), edges(), point(2.0), point(2.0))
        .prop_map(|(center_m, half_m, a, b)| (Cuboid { center_m, half_m }, [a, b]))
}

/// The same, and segments that are parallel to edges and faces, through the box, of no length, on a lattice.
fn case() -> impl Strategy<Value = Case> {
    let lattice = prop::array::uniform3(-3_i8..=3)
        .prop_map(|entries| Vector3::from(entries.map(|entry| 0.5 * f64::from(entry))));
    let ends = prop_oneof![
        6 => (point(2.0), point(2.0)).prop_map(|(a, b)| [a, b]),
        2 => (point(2.0), 0..3_usize, -3.0..3.0_f64).prop_map(|(a, axis, length)| {
            let mut b = a;
            b[axis] += length;
            [a, b]
        }),
        2 => (point(2.0), point(2.0), 0..3_usize).prop_map(|(a, mut b, axis)| {
            b[axis] = a[axis];
            [a, b]
        }),
        1 => point(1.0).prop_map(|a| [a, a]),
        2 => (lattice.clone(), lattice).prop_map(|(a, b)| [a, b]),
        1 => (point(2.0), point(1e-7)).prop_map(|(a, shift)| [a, -a + shift]),
    ];
    (point(0.3), edges(), ends, any::<bool>()).prop_map(|(center_m, half_m, ends, is_centered)| {
        let center_m = if is_centered { Vector3::zeros() } else { center_m };
        (Cuboid { center_m, half_m }, ends)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn outside_it_is_the_distance((cuboid, ends) in case()) {
        let found = distance(&cuboid, &ends);
        let expected = searched(&cuboid, &ends);
        prop_assert!((found.max(0.0) - expected).abs() < 2e-8, "{found} {expected}");
        if expected > 1e-3 {
            prop_assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
        let backwards = distance(&cuboid, &[ends[1], ends[0]]);
        prop_assert!((backwards - found).abs() < 2e-9, "{backwards} {found}");
    }

    /// No way out is shorter, and there is one that is as short.
    #[test]
    fn inside_it_is_the_shortest_way_out(
        (cuboid, ends) in case(),
        directions in prop::collection::vec(point(1.0), 100),
    ) {
        let found = distance(&cuboid, &ends);
        if found > -1e-6 {
            return Ok(());
        }
        for direction in directions.iter().filter(|direction| direction.norm() > 1e-3) {
            let way_out = way_out(&cuboid, &ends, &direction.normalize());
            prop_assert!(way_out > -found - 1e-9, "{way_out} {found}");
        }
        let gradient = gradient(&cuboid, &ends);
        let out = ends.map(|end| end + gradient.normalize() * (1e-6 - found));
        prop_assert!(searched(&cuboid, &out) > 0.9e-6, "{found} {gradient}");
        let short_of = ends.map(|end| end - gradient.normalize() * (found + 1e-6));
        prop_assert!(searched(&cuboid, &short_of) < 1e-9, "{found} {gradient}");
    }

    /// Wherever the segment is, moving it as a whole along the gradient leads away at full speed.
    #[test]
    fn the_gradient_never_vanishes((cuboid, ends) in case()) {
        let norm = gradient(&cuboid, &ends).norm();
        prop_assert!((norm - 1.0).abs() < 1e-6, "{norm}");
    }

    #[test]
    fn derivatives_are_numbers((cuboid, ends) in case(), i in 0..6_usize, k in 0..6_usize) {
        let found = hyper_dual(&cuboid, &ends, i, k);
        for part in [found.re, found.eps1, found.eps2, found.eps1eps2] {
            prop_assert!(part.is_finite(), "{found:?}");
        }
    }

    /// Off the places where another feature becomes the nearest, which slopes to both sides tell.
    #[test]
    fn derivatives_agree_with_differences(
        (cuboid, ends) in general_case(),
        i in 0..6_usize,
        k in 0..6_usize,
    ) {
        let moved = |step: f64, of: usize| {
            let mut ends = ends;
            ends[of / 3][of % 3] += step;
            ends
        };
        let h = 1e-5;
        let found = hyper_dual(&cuboid, &ends, i, k);
        if found.re.abs() < 0.02 {
            return Ok(());
        }
        let slope = |h: f64| (distance(&cuboid, &moved(h, i)) - found.re) / h;
        if (slope(h) - slope(-h)).abs() < 1e-3 {
            let slope = 0.5 * (slope(h) + slope(-h));
            prop_assert!((slope - found.eps1).abs() < 1e-5, "{} {}", slope, found.eps1);
        }
        let exact = |ends: &[Vector3<f64>; 2]| hyper_dual(&cuboid, ends, i, i).eps1;
        let curvature = |h: f64| (exact(&moved(h, k)) - found.eps1) / h;
        if (curvature(h) - curvature(-h)).abs() < 1e-2 {
            let curvature = 0.5 * (curvature(h) + curvature(-h));
            let allowed = 1e-3 * (1.0 + curvature.abs());
            prop_assert!((curvature - found.eps1eps2).abs() < allowed, "{} {:?}", curvature, found);
        }
    }
}

/// Of the distance, where both ends move.
fn gradient(cuboid: &Cuboid, ends: &[Vector3<f64>; 2]) -> Vector3<f64> {
    Vector3::from_fn(|i, _| {
        let mut dual = ends.map(|end| end.map(Dual64::from));
        dual[0][i].eps = 1.0;
        dual[1][i].eps = 1.0;
        // The segment is as long wherever it is.
        let length_squared = Dual64::from((ends[1] - ends[0]).norm_squared());
        let segment = Segment { length_squared, ..Segment::new(dual[0], dual[1]) };
        cuboid.signed_distance(&segment).eps
    })
}

fn hyper_dual(cuboid: &Cuboid, ends: &[Vector3<f64>; 2], i: usize, k: usize) -> HyperDual64 {
    let mut dual = ends.map(|end| end.map(HyperDual64::from));
    dual[i / 3][i % 3].eps1 = 1.0;
    dual[k / 3][k % 3].eps2 = 1.0;
    distance(cuboid, &dual)
}

/// A rod through the middle of a panel has to go back or around.
#[test]
fn a_rod_through_a_panel_gets_out_the_nearest_way() {
    let panel = Cuboid { center_m: Vector3::zeros(), half_m: Vector3::new(0.01, 1.0, 0.4) };
    let rod = |from: f64, to: f64, z: f64| [Vector3::new(from, 0.2, z), Vector3::new(to, 0.2, z)];
    assert!((distance(&panel, &rod(-0.5, 0.2, 0.0)) + 0.21).abs() < 1e-15);
    assert!((distance(&panel, &rod(-0.5, 0.6, 0.1)) + 0.3).abs() < 1e-15);
    assert!((gradient(&panel, &rod(-0.5, 0.6, 0.1)) - Vector3::z()).norm() < 1e-15);
    assert!((distance(&panel, &rod(-0.5, 0.6, 0.6)) - 0.2).abs() < 1e-15);
    // From corner to rod across an edge.
    let across = [Vector3::new(0.31, 1.0, 0.5), Vector3::new(0.01, 1.4, 0.5)];
    assert!((distance(&panel, &across) - 0.24_f64.hypot(0.1)).abs() < 1e-12);
}
