//! Distances between points and straight segments, without comparing.
//!
//! The squared distance is smooth where the distance itself has a corner (at contact) and needs no
//! root: prefer it in constraints. Every division is by a number that the degenerate case has
//! replaced beforehand, so segments may have no length and may be parallel or collinear, on any
//! scalar.

use crate::algebra::{difference, dot, scaled};
use nalgebra::Vector3;
use righting_scalar::Scalar;

/// Squared sine of an angle below which the crossing point of two lines is lost in rounding. Closer
/// to parallel than that, lines are taken to cross at that angle: the squared distance is then off by
/// at most twice this number times the squared length of the longer segment.
const PARALLEL: f64 = 1e-12;

/// A straight segment.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment<T> {
    /// One end, m.
    pub start: Vector3<T>,
    /// From there to the other end, m.
    pub direction: Vector3<T>,
    /// Squared length of `direction`, m². Known beforehand for a rigid link, which spares its
    /// computation and makes it a constant for derivatives.
    pub length_squared: T,
}

impl<T: Scalar> Segment<T> {
    /// The segment between two points.
    pub fn new(start: Vector3<T>, end: Vector3<T>) -> Self {
        let direction = difference(&end, &start);
        let length_squared = dot(&direction, &direction);
        Self { start, direction, length_squared }
    }

    /// The other end, m.
    pub fn end(&self) -> Vector3<T> {
        crate::algebra::sum(&self.start, &self.direction)
    }

    /// Squared distance to a point, m².
    pub fn squared_distance_to_point(&self, point: &Vector3<T>) -> T {
        let from_start = difference(point, &self.start);
        let s = clamped_ratio(dot(&from_start, &self.direction), self.length_squared);
        squared(&difference(&from_start, &scaled(&self.direction, s)))
    }

    /// Distance to a point, m. Its derivative does not exist where it is zero.
    pub fn distance_to_point(&self, point: &Vector3<T>) -> T {
        self.squared_distance_to_point(point).sqrt()
    }

    /// Squared distance to another segment, m².
    pub fn squared_distance_to_segment(&self, other: &Self) -> T {
        squared(&self.shortest_from_segment(other))
    }

    /// From the place of another segment that is nearest to this one to that place of this one, m.
    ///
    /// Finds the closest points of the two lines, then holds each point within its segment in turn
    /// (Ericson, *Real-Time Collision Detection*, section 5.1.9).
    pub fn shortest_from_segment(&self, other: &Self) -> Vector3<T> {
        let apart = difference(&self.start, &other.start);
        let (a, e) = (self.length_squared, other.length_squared);
        let b = dot(&self.direction, &other.direction);
        let c = dot(&self.direction, &apart);
        let f = dot(&other.direction, &apart);
        // Of parallel lines every point is a closest one; of nearly parallel ones an end of the
        // segments is, which the sign of the numerator still tells.
        let both = a * e;
        let floor = T::select_positive(both, both * PARALLEL, T::from(1.0));
        let denominator = (both - b * b).maximum(floor);
        let on_line = (b * f - c * e) / denominator;
        let t = clamped_ratio(b * unit_clamped(on_line) + f, e);
        // Where t was not held back this gives the same point again.
        let s = clamped_ratio(b * t - c, a);
        Vector3::from_fn(|i, _| apart[i] + self.direction[i] * s - other.direction[i] * t)
    }

    /// Distance to another segment, m. Its derivative does not exist where it is zero.
    pub fn distance_to_segment(&self, other: &Self) -> T {
        self.squared_distance_to_segment(other).sqrt()
    }
}

/// numerator/denominator within [0, 1]; 0 where the denominator, which is never negative, is zero.
fn clamped_ratio<T: Scalar>(numerator: T, denominator: T) -> T {
    let guarded = T::select_positive(denominator, denominator, T::from(1.0));
    unit_clamped(numerator * guarded.recip())
}

fn unit_clamped<T: Scalar>(x: T) -> T {
    x.clamped(T::from(0.0), T::from(1.0))
}

fn squared<T: Scalar>(v: &Vector3<T>) -> T {
    dot(v, v)
}
