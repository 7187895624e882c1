//! Distance of straight segments from boxes, without comparing.
//!
//! The squared distance of a point p from a box is Σ gᵢ², where gᵢ is how far p is beyond the box in the
//! direction of edge i. Along a segment p(s) = c + s d it is convex, and its slope is piecewise linear: it
//! bends only where the segment crosses the planes of the six faces. Those places, and the sign of the slope
//! at each, bracket the nearest place between two neighbours. What is beyond which face there is the same in
//! the whole bracket, so that with it the nearest place follows from a quadratic:
//!
//! ```text
//! gᵢ(s) = eᵢ + s fᵢ,      s* = −Σ eᵢ fᵢ / Σ fᵢ²   within [0, 1]
//! ```
//!
//! Conditions alone depend on the bracket, so that derivatives are those of the quadratic.
//!
//! Where segment and box touch or cross, that distance is zero and says nothing of a way out. The separation
//! along an axis does: the gap between the projections of the two, negative where these overlap. Its largest
//! value over the normals of all faces of their Minkowski sum, which are the box's edges and the products of
//! those with the segment, is minus the shortest way out (Gottschalk, Lin and Manocha, *OBBTree*, 1996,
//! section 5, for boxes).

use crate::algebra::{dot, offset_by, plus_multiple};
use crate::distance::Segment;
use nalgebra::Vector3;
use righting_scalar::Scalar;

/// Segment and box count as touching below this share of the box's diagonal.
const TOUCHING: f64 = 1e-9;
/// Squared sine of an angle below which a segment is taken to be parallel to an edge, or to a face. The
/// squared distance is then off by at most this number times the segment's squared length.
const PARALLEL: f64 = 1e-12;

/// A box with its edges along the body axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid {
    /// Center, m.
    pub center_m: Vector3<f64>,
    /// Half of each edge, m; zero or more.
    pub half_m: Vector3<f64>,
}

/// A segment as seen from the center of a box.
struct Seen<T> {
    start: Vector3<T>,
    direction: Vector3<T>,
    length_squared: T,
}

impl Cuboid {
    /// Distance to a segment (body axes), m; minus the shortest way out where they cross. Its gradient never
    /// vanishes. It has no second derivative where the feature of the box that is nearest changes, and no
    /// first one at the touch of an edge.
    pub fn signed_distance<T: Scalar>(&self, segment: &Segment<T>) -> T {
        let seen = self.seen(segment);
        let way = self.shortest(&seen);
        let squared = dot(&way, &way);
        let touching = 4.0 * TOUCHING.powi(2) * self.half_m.norm_squared();
        let is_apart = squared - touching;
        let distance = T::select_positive(is_apart, squared, T::from(1.0)).sqrt();
        T::select_positive(is_apart, distance, self.separation(&seen))
    }

    /// From the place of the box that is nearest to a segment (body axes) to that place of the segment, m;
    /// zero where they cross.
    pub fn shortest_to_segment<T: Scalar>(&self, segment: &Segment<T>) -> Vector3<T> {
        self.shortest(&self.seen(segment))
    }

    /// Least and largest coordinate of the box along a direction (body axes) of length one, m.
    pub fn extent_m(&self, direction: &Vector3<f64>) -> [f64; 2] {
        let middle = self.center_m.dot(direction);
        let half = self.half_m.dot(&direction.abs());
        [middle - half, middle + half]
    }

    fn seen<T: Scalar>(&self, segment: &Segment<T>) -> Seen<T> {
        Seen {
            start: offset_by(&segment.start, &-self.center_m),
            direction: segment.direction,
            length_squared: segment.length_squared,
        }
    }

    fn shortest<T: Scalar>(&self, seen: &Seen<T>) -> Vector3<T> {
        let Seen { start, direction, length_squared } = seen;
        let within = self.bracketed(seen);
        let at = seen.at(within);
        // Beyond a face, the gap at the start and how it grows; between two faces there is none.
        let beyond = |i: usize, above: T, below: T| {
            let (p, half) = (at[i], self.half_m[i]);
            let not_above = T::select_positive(-p - half, below, T::from(0.0));
            T::select_positive(p - half, above, not_above)
        };
        let gap = Vector3::from_fn(|i, _| {
            beyond(i, start[i] - self.half_m[i], start[i] + self.half_m[i])
        });
        let growth = Vector3::from_fn(|i, _| beyond(i, direction[i], direction[i]));
        let floor = T::select_positive(*length_squared, *length_squared * PARALLEL, T::from(1.0));
        let steepness = dot(&growth, &growth).maximum(floor);
        let nearest = (-dot(&gap, &growth) / steepness).clamped(T::from(0.0), T::from(1.0));
        Vector3::from_fn(|i, _| gap[i] + growth[i] * nearest)
    }

    /// A place on the segment, 0 to 1, between the same two crossings of faces' planes as the nearest one.
    fn bracketed<T: Scalar>(&self, seen: &Seen<T>) -> T {
        let Seen { start, direction, .. } = seen;
        let (mut low, mut high) = (T::from(0.0), T::from(1.0));
        for i in 0..3 {
            let d = direction[i];
            let per_length = T::select_positive(d * d, d, T::from(1.0)).recip();
            for half in [-self.half_m[i], self.half_m[i]] {
                let crossing =
                    ((-start[i] + half) * per_length).clamped(T::from(0.0), T::from(1.0));
                let slope = self.slope(seen, crossing);
                low = T::select_positive(slope, low, low.maximum(crossing));
                high = T::select_positive(slope, high.minimum(crossing), high);
            }
        }
        (low + high) * 0.5
    }

    /// Half the slope of the squared distance along the segment.
    fn slope<T: Scalar>(&self, seen: &Seen<T>, place: T) -> T {
        let at = seen.at(place);
        let gap = Vector3::from_fn(|i, _| {
            let half = T::from(self.half_m[i]);
            at[i] - at[i].clamped(-half, half)
        });
        dot(&gap, &seen.direction)
    }

    /// The largest gap between the projections of segment and box onto one axis, negative where they cross.
    fn separation<T: Scalar>(&self, seen: &Seen<T>) -> T {
        let Seen { start, direction, length_squared } = seen;
        let half = &self.half_m;
        let middle = seen.at(T::from(0.5));
        let across_face = |i: usize| magnitude(middle[i]) - magnitude(direction[i]) * 0.5 - half[i];
        let mut largest = across_face(0).maximum(across_face(1)).maximum(across_face(2));
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let (dj, dk) = (direction[j], direction[k]);
            let apart = magnitude(start[k] * dj - start[j] * dk);
            let overlap = plus_multiple(magnitude(dk) * half[j], half[k], magnitude(dj));
            let squared = dj * dj + dk * dk;
            let is_turned = squared - *length_squared * PARALLEL;
            let length = T::select_positive(is_turned, squared, T::from(1.0)).sqrt();
            let across_edges = (apart - overlap) / length;
            largest = T::select_positive(is_turned, largest.maximum(across_edges), largest);
        }
        largest
    }
}

impl<T: Scalar> Seen<T> {
    fn at(&self, place: T) -> Vector3<T> {
        Vector3::from_fn(|i, _| self.start[i] + self.direction[i] * place)
    }
}

/// |x|, with the derivative of −x where x is zero.
fn magnitude<T: Scalar>(x: T) -> T {
    T::select_positive(x, x, -x)
}
