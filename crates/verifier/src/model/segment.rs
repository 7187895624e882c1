//! Distances of straight segments from points and from each other, by cases.

use nalgebra::Vector3;

/// A straight segment between two points; of no length where they coincide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// One end, m.
    pub start: Vector3<f64>,
    /// The other end, m.
    pub end: Vector3<f64>,
}

impl Segment {
    /// Distance to a point, m.
    pub fn distance_to_point(&self, point: &Vector3<f64>) -> f64 {
        self.shortest_to_point(point).norm()
    }

    /// From the nearest place of the segment to a point, m.
    fn shortest_to_point(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let along = self.end - self.start;
        let from_start = point - self.start;
        let length_squared = along.norm_squared();
        let part = if length_squared > 0.0 {
            (from_start.dot(&along) / length_squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        from_start - along * part
    }

    /// Distance to another segment, m.
    ///
    /// The squared distance is a convex function of the two places along the segments. Its least
    /// value is at an end of one of them, or between the feet of the common perpendicular of the two
    /// lines, where both lie within the segments.
    pub fn distance_to_segment(&self, other: &Self) -> f64 {
        let ends = other
            .distance_to_point(&self.start)
            .min(other.distance_to_point(&self.end))
            .min(self.distance_to_point(&other.start))
            .min(self.distance_to_point(&other.end));
        self.common_perpendicular(other).map_or(ends, |way| way.norm().min(ends))
    }

    /// From the place of this segment that is nearest to another one to that place of the other, m.
    pub fn shortest_to_segment(&self, other: &Self) -> Vector3<f64> {
        let ends = [
            self.shortest_to_point(&other.start),
            self.shortest_to_point(&other.end),
            -other.shortest_to_point(&self.start),
            -other.shortest_to_point(&self.end),
        ];
        let ways = ends.into_iter().chain(self.common_perpendicular(other));
        ways.min_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared())).unwrap_or(ends[0])
    }

    /// The common perpendicular of the two lines, from this one, if both feet lie within the segments.
    fn common_perpendicular(&self, other: &Self) -> Option<Vector3<f64>> {
        let (u, v) = (self.end - self.start, other.end - other.start);
        let normal = u.cross(&v);
        let apart = other.start - self.start;
        // By Cramer's rule from apart + t v - s u = k normal; of parallel lines s and t are no numbers.
        let s = apart.cross(&v).dot(&normal) / normal.norm_squared();
        let t = apart.cross(&u).dot(&normal) / normal.norm_squared();
        let is_within = |part: f64| (0.0..=1.0).contains(&part);
        // From foot to foot: never less than the distance, however the normal was rounded.
        (is_within(s) && is_within(t)).then(|| apart + v * t - u * s)
    }
}
