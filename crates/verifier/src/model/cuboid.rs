//! Distances of boxes from straight segments, by bisection.

use nalgebra::Vector3;

use super::segment::Segment;

/// Halvings of a segment: what is left of it is rounding.
const HALVINGS: usize = 60;

/// A box with its edges along the body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// The corner with the least coordinates, m.
    pub low: Vector3<f64>,
    /// The corner with the largest coordinates, m.
    pub high: Vector3<f64>,
}

impl Cuboid {
    /// From the place of the box that is nearest to a segment to that place of the segment, m; zero where
    /// they meet.
    ///
    /// The squared distance of a point from the box is convex, and so it is along the segment: half its
    /// slope there, the way from the box to the point times the direction, never falls. Where it changes
    /// its sign, or at an end if it does not, is the nearest place.
    pub fn shortest_to_segment(&self, segment: &Segment) -> Vector3<f64> {
        let along = segment.end - segment.start;
        let way = |part: f64| {
            let point = segment.start + along * part;
            point - point.sup(&self.low).inf(&self.high)
        };
        let slope = |part: f64| way(part).dot(&along);
        if slope(0.0) >= 0.0 {
            return way(0.0);
        }
        if slope(1.0) <= 0.0 {
            return way(1.0);
        }
        let (mut before, mut after) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + after);
            match slope(middle) < 0.0 {
                true => before = middle,
                false => after = middle,
            }
        }
        way(after)
    }

    /// Least and largest coordinate along a direction of length one, m.
    pub fn extent(&self, direction: &Vector3<f64>) -> [f64; 2] {
        let ends = self
            .low
            .component_mul(direction)
            .zip_map(&self.high.component_mul(direction), |low, high| {
                (low.min(high), low.max(high))
            });
        [ends.iter().map(|(low, _)| low).sum(), ends.iter().map(|(_, high)| high).sum()]
    }
}
