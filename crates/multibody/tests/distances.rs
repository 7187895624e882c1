//! Distances against a search over the segments, degenerate cases included.

mod support;

use approx::assert_relative_eq;
use nalgebra::Vector3;
use num_dual::HyperDual64;
use proptest::prelude::*;
use righting_multibody::{Core, JointKind, Segment};
use righting_scalar::Scalar;
use support::random;

type Ends = [Vector3<f64>; 4];

fn segment<T: Scalar>(start: &Vector3<T>, end: &Vector3<T>) -> Segment<T> {
    Segment::new(*start, *end)
}

fn between(ends: &Ends) -> f64 {
    let [a, b, c, d] = ends;
    segment(a, b).squared_distance_to_segment(&segment(c, d))
}

/// Squared distance from a point to the nearest of many points of a segment, then to the bottom of
/// the valley around it: the distance is convex along a segment.
fn search(f: impl Fn(f64) -> f64) -> f64 {
    let samples = 64;
    let at = |i: i32| f64::from(i) / f64::from(samples);
    let best = (0..=samples).min_by(|i, k| f(at(*i)).total_cmp(&f(at(*k)))).unwrap();
    let (mut low, mut high) = (at((best - 1).max(0)), at((best + 1).min(samples)));
    for _ in 0..60 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if f(a) < f(b) { high = b } else { low = a }
    }
    f(low).min(f(high)).min(f(0.0)).min(f(1.0))
}

fn searched(ends: &Ends) -> f64 {
    let [a, b, c, d] = *ends;
    search(|s| search(|t| (a + (b - a) * s - c - (d - c) * t).norm_squared()))
}

fn point(size: f64) -> impl Strategy<Value = Vector3<f64>> + Clone {
    [-size..size, -size..size, -size..size].prop_map(Vector3::from)
}

/// Segments in general position and in every special one.
fn ends() -> impl Strategy<Value = Ends> {
    let general = (point(1.0), point(1.0), point(1.0), point(1.0));
    let factor = -1.5..1.5_f64;
    prop_oneof![
        6 => general.clone().prop_map(|(a, b, c, d)| [a, b, c, d]),
        2 => (general.clone(), factor.clone())
            .prop_map(|((a, b, c, _), k)| [a, b, c, c + (b - a) * k]),
        2 => (general.clone(), factor.clone(), factor.clone())
            .prop_map(|((a, b, ..), k, l)| [a, b, a + (b - a) * k, a + (b - a) * l]),
        1 => general.clone().prop_map(|(a, b, c, _)| [a, b, c, c]),
        1 => general.clone().prop_map(|(a, _, c, d)| [a, a, c, d]),
        1 => general.clone().prop_map(|(a, _, c, _)| [a, a, c, c]),
        1 => general.clone().prop_map(|(a, b, _, d)| [a, b, b, d]),
        1 => general.clone().prop_map(|(a, b, ..)| [a, b, a, b]),
        1 => general.clone().prop_map(|(a, b, ..)| [a, b, b, a]),
        2 => (general, factor, -12.0..-4.0_f64).prop_map(|((a, b, c, d), k, exponent)| {
            [a, b, c, c + (b - a) * k + (d - c) * 10.0_f64.powf(exponent)]
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn segments(ends in ends()) {
        let squared = between(&ends);
        let [a, b, c, d] = ends;
        let longer = (b - a).norm_squared().max((d - c).norm_squared());
        // Nearly parallel segments have the error that is documented.
        let bound = 1e-13 + 2e-12 * longer;
        prop_assert!((squared - searched(&ends)).abs() < bound, "{} {}", squared, searched(&ends));
        for same in [[c, d, a, b], [b, a, c, d], [a, b, d, c]] {
            prop_assert!((between(&same) - squared).abs() < bound, "{}", between(&same));
        }
    }

    #[test]
    fn points(ends in ends()) {
        let [a, b, p, _] = ends;
        let squared = segment(&a, &b).squared_distance_to_point(&p);
        let searched = search(|s| (a + (b - a) * s - p).norm_squared());
        prop_assert!((squared - searched).abs() < 1e-13, "{} {}", squared, searched);
        let as_segment = between(&[a, b, p, p]);
        prop_assert!((squared - as_segment).abs() < 1e-14, "{} {}", squared, as_segment);
    }

    /// In every case, first and second derivatives are numbers.
    #[test]
    fn derivatives_are_finite(ends in ends(), i in 0..12_usize, k in 0..12_usize) {
        let mut dual = ends.map(|end| end.map(HyperDual64::from));
        dual[i / 3][i % 3].eps1 = 1.0;
        dual[k / 3][k % 3].eps2 = 1.0;
        let [a, b, c, d] = dual;
        let squared = segment(&a, &b).squared_distance_to_segment(&segment(&c, &d));
        for part in [squared.eps1, squared.eps2, squared.eps1eps2] {
            prop_assert!(part.is_finite(), "{:?}", squared);
        }
        let to_point = segment(&a, &b).squared_distance_to_point(&c);
        for part in [to_point.eps1, to_point.eps2, to_point.eps1eps2] {
            prop_assert!(part.is_finite(), "{:?}", to_point);
        }
    }

    /// The gradient is that of the distance between the two closest points as they are.
    #[test]
    fn gradients_agree_with_differences(
        a in point(1.0), b in point(1.0), c in point(1.0), d in point(1.0), i in 0..12_usize,
    ) {
        let ends = [a, b, c, d];
        let mut dual = ends.map(|end| end.map(num_dual::Dual64::from));
        dual[i / 3][i % 3].eps = 1.0;
        let [da, db, dc, dd] = dual;
        let squared = segment(&da, &db).squared_distance_to_segment(&segment(&dc, &dd));
        let h = 1e-6;
        let moved = |step: f64| {
            let mut ends = ends;
            ends[i / 3][i % 3] += step;
            between(&ends)
        };
        let difference = (moved(h) - moved(-h)) / (2.0 * h);
        // The second derivative is bounded by (b − a)'s length over sin²: stay off parallel ones.
        prop_assume!((b - a).normalize().cross(&(d - c).normalize()).norm() > 0.05);
        prop_assert!((squared.eps - difference).abs() < 1e-4, "{} {}", squared.eps, difference);
    }
}

fn v(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x, y, z)
}

#[test]
fn exact_cases() {
    let cases: [(&str, Ends, f64); 11] = [
        ("crossing", [v(-1., 0., 0.), v(1., 0., 0.), v(0., -1., 0.), v(0., 1., 0.)], 0.0),
        ("skew", [v(-1., 0., 0.), v(1., 0., 0.), v(0., -1., 2.), v(0., 1., 2.)], 4.0),
        (
            "parallel, side by side",
            [v(0., 0., 0.), v(4., 0., 0.), v(1., 3., 0.), v(2., 3., 0.)],
            9.0,
        ),
        ("parallel, apart", [v(0., 0., 0.), v(1., 0., 0.), v(4., 4., 0.), v(9., 4., 0.)], 25.0),
        ("antiparallel, apart", [v(0., 0., 0.), v(1., 0., 0.), v(9., 4., 0.), v(4., 4., 0.)], 25.0),
        ("collinear, apart", [v(0., 0., 0.), v(1., 0., 0.), v(3., 0., 0.), v(5., 0., 0.)], 4.0),
        (
            "collinear, overlapping",
            [v(0., 0., 0.), v(2., 0., 0.), v(1., 0., 0.), v(5., 0., 0.)],
            0.0,
        ),
        ("end to end", [v(0., 0., 0.), v(1., 0., 0.), v(1., 0., 0.), v(1., 1., 0.)], 0.0),
        ("end above middle", [v(-1., 0., 0.), v(1., 0., 0.), v(0., 0., 1.), v(0., 0., 2.)], 1.0),
        ("two points", [v(0., 0., 0.), v(0., 0., 0.), v(3., 4., 0.), v(3., 4., 0.)], 25.0),
        ("point and segment", [v(0., 2., 0.), v(0., 2., 0.), v(-1., 0., 0.), v(1., 0., 0.)], 4.0),
    ];
    for (name, ends, squared) in cases {
        assert_eq!(between(&ends), squared, "{name}");
        let [a, b, c, d] = ends;
        let distance = segment(&c, &d).distance_to_segment(&segment(&a, &b));
        assert_eq!(distance, squared.sqrt(), "{name}, the other way round");
    }
}

#[test]
fn distance_is_the_root_of_its_square() {
    let arm = segment(&v(0., 0., 1.), &v(2., 0., 1.));
    assert_relative_eq!(arm.distance_to_point(&v(1., 3., 5.)), 5.0);
    assert_relative_eq!(arm.distance_to_point(&v(-3., 4., 1.)), 5.0);
    assert_eq!(arm.end(), v(2., 0., 1.));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Both ways to the same number: from the segments in body axes, and link to link.
    #[test]
    fn clearances((system, state, _) in random::motion()) {
        let q = &state.joint_angles;
        let segments = system.kinematics(q).segments;
        for (a, segment) in segments.iter().enumerate() {
            let expected = segment.squared_distance_to_point(&Vector3::zeros());
            let squared = system.squared_distance_to_point(q, &Core::Link(a), &Vector3::zeros());
            prop_assert!((squared - expected).abs() < 1e-12, "{} {}", squared, expected);
            for (b, other) in segments.iter().enumerate() {
                let expected = segment.squared_distance_to_segment(other);
                let squared = system.squared_distance_between(q, &Core::Link(a), &Core::Link(b));
                prop_assert!((squared - expected).abs() < 2e-11, "{} {}", squared, expected);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Wherever cores are on the arm, all ways lead to the same number, and reach is what it says.
    #[test]
    fn cores(
        (system, state, _) in random::motion(),
        seeds in [0..1000_usize, 0..1000],
        [from_m, to_m, a, b] in [point(1.0), point(1.0), point(0.5), point(0.5)],
    ) {
        let q = &state.joint_angles;
        let posture = system.kinematics(q);
        let frames = posture.frames.len();
        let links = posture.segments.len();
        let core = |seed: usize, shift: Vector3<f64>| match (seed % frames, seed % 2) {
            (link, 0) if link < links => Core::Link(link),
            (frame, _) => Core::InFrame { frame, from_m: shift, to_m: a - shift },
        };
        let cores = [core(seeds[0], a), core(seeds[1], b)];
        let [first, second] = cores.map(|core| posture.core(&core));
        let expected = first.squared_distance_to_segment(&second);
        let squared = system.squared_distance_between(q, &cores[0], &cores[1]);
        prop_assert!((squared - expected).abs() < 5e-11, "{} {}", squared, expected);
        let expected = first.squared_distance_to_segment(&Segment::new(from_m, to_m));
        let squared = system.squared_distance_to_segment(q, &cores[0], &[from_m, to_m]);
        prop_assert!((squared - expected).abs() < 5e-11, "{} {}", squared, expected);
        let expected = first.squared_distance_to_point(&from_m);
        let squared = system.squared_distance_to_point(q, &cores[0], &from_m);
        prop_assert!((squared - expected).abs() < 1e-12, "{} {}", squared, expected);
        let farthest: Vec<f64> = q.iter().map(|q| q.abs()).collect();
        let levers = system.levers(&cores[0], &farthest);
        let moving: Vec<usize> = levers.iter().map(|(joint, _)| *joint).collect();
        prop_assert_eq!(moving, system.joints_moving(&cores[0]));
        let kinds = system.joint_kinds();
        for (joint, lever) in levers {
            if kinds[joint] == JointKind::Prismatic {
                prop_assert_eq!(lever, 1.0);
                continue;
            }
            let origin = posture.joint_origins[joint];
            let farthest_m = (first.start - origin).norm().max((first.end() - origin).norm());
            prop_assert!(farthest_m < lever + 1e-12, "{} {}", farthest_m, lever);
        }
    }
}

/// A straight arm is where every maneuver starts: all links on one line.
#[test]
fn links_of_a_straight_arm_are_apart_by_what_lies_between() {
    let arm = support::table_one::xlink_4dof();
    let segments = arm.kinematics(&[0.0; 4]).segments;
    assert!((segments[0].distance_to_segment(&segments[2]) - 0.25).abs() < 1e-15);
    assert!((segments[0].distance_to_segment(&segments[3]) - 0.5).abs() < 1e-15);
    assert!((segments[1].distance_to_segment(&segments[3]) - 0.25).abs() < 1e-15);
    let center = Vector3::zeros();
    assert!((segments[1].distance_to_point(&center) - 0.5).abs() < 1e-15);
    assert_eq!((arm.length_between_m(1, 2), arm.length_between_m(2, 2)), (0.0, 0.0));
    assert_eq!((arm.length_between_m(1, 3), arm.length_between_m(3, 0)), (0.25, 0.5));
    assert_eq!(arm.size_m(), 1.25);
}
