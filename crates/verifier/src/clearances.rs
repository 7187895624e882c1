//! The distances that links keep, from the system file.

use nalgebra::Vector3;
use righting_scenario::collision::Between;
use righting_scenario::file;

use crate::ledger::{Subject, Worst};
use crate::model::Segment;

/// A length below this part of the arm's is none.
const ROUNDING: f64 = 1e-9;

/// Which links keep how far from the base and from each other.
///
/// A link is the straight segment between its two origins. One without length, or with a rounding of
/// none, collides with nothing. Two links between which the arm is no longer than the clearance can
/// never be that far apart: they share a joint.
#[derive(Clone, Debug)]
pub(super) struct Clearances {
    /// Links that keep away from the base, counted from zero.
    body_links: Vec<usize>,
    /// Pairs of links that keep away from each other, inboard link first.
    link_pairs: Vec<(usize, usize)>,
    /// Least distance from the base's center of mass: keep-out radius and clearance, m.
    least_from_body_m: f64,
    /// Least distance of two links, m.
    least_between_links_m: f64,
}

impl Clearances {
    pub fn new(system: &file::System, clearance_m: f64) -> Self {
        let lengths_m: Vec<f64> =
            system.links.iter().map(|link| link.a_m.hypot(link.d_m)).collect();
        let rounding_m = ROUNDING * lengths_m.iter().sum::<f64>();
        let solid: Vec<usize> =
            (0..lengths_m.len()).filter(|&link| lengths_m[link] > rounding_m).collect();
        let mut link_pairs = Vec::new();
        for (nth, &inboard) in solid.iter().enumerate() {
            for &outboard in &solid[nth + 1..] {
                let between_m: f64 = lengths_m[inboard + 1..outboard].iter().sum();
                if between_m > clearance_m && between_m > rounding_m {
                    link_pairs.push((inboard, outboard));
                }
            }
        }
        let exempt = |link: &usize| system.links[*link].body_exempt;
        // Half the space diagonal of a cube.
        let circumscribed_m = |side_m: f64| Vector3::repeat(side_m / 2.0).norm();
        let keep_out_m = system
            .base
            .keep_out_radius_m
            .or(system.base.cube_side_m.map(circumscribed_m))
            .unwrap_or(0.0);
        Self {
            body_links: solid.iter().copied().filter(|link| !exempt(link)).collect(),
            link_pairs,
            least_from_body_m: keep_out_m + clearance_m,
            least_between_links_m: clearance_m,
        }
    }

    /// Every distance that is kept.
    pub fn all(&self) -> impl Iterator<Item = Between> + '_ {
        let body = self.body_links.iter().map(|&link| Between::LinkAndBody(link));
        body.chain(self.link_pairs.iter().map(|&(a, b)| Between::Links(a, b)))
    }

    /// The least that is allowed, m.
    pub fn least_m(&self, between: Between) -> f64 {
        match between {
            Between::LinkAndBody(_) => self.least_from_body_m,
            Between::Links(..) => self.least_between_links_m,
        }
    }

    /// Whether no distance is kept.
    pub fn is_empty(&self) -> bool {
        self.body_links.is_empty() && self.link_pairs.is_empty()
    }

    /// Looks at every distance in a posture of the arm, given by the origins of its frames in body
    /// axes (m): `body` and `links` are the worst places so far.
    pub fn look(&self, origins: &[Vector3<f64>], time_s: f64, body: &mut Worst, links: &mut Worst) {
        let segment = |link: usize| Segment { start: origins[link], end: origins[link + 1] };
        for &link in &self.body_links {
            let distance_m = segment(link).distance_to_point(&Vector3::zeros());
            let subject = Some(Subject::Clearance(Between::LinkAndBody(link)));
            body.at_least(distance_m, self.least_from_body_m, subject, Some(time_s));
        }
        for &(a, b) in &self.link_pairs {
            let distance_m = segment(a).distance_to_segment(&segment(b));
            let subject = Some(Subject::Clearance(Between::Links(a, b)));
            links.at_least(distance_m, self.least_between_links_m, subject, Some(time_s));
        }
    }
}
