//! How near links come to each other and to the base within a step.
//!
//! Over a stretch of time a distance is no less than the gap between two parallel planes that part the two
//! things at its beginning and at its end, less what their points can be off the straight way between:
//! max |p̈| Δt²/8 for each (the error of linear interpolation). With R_j the lengths from joint j to the
//! end of a link, |p̈| ≤ Σ R_j |q̈_j| + (Σ |q̇_j|)(Σ R_j |q̇_j|). Where that is not enough, the stretch is
//! halved, so that links that pass through each other between two places are found.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use righting_multibody::{DhConvention, Segment, System};
use righting_scenario::collision::Between;

use super::{PassedClearance, Step};
use crate::formulation::Clearances;

/// Halvings of a step at most.
const DEEPEST: usize = 30;
/// Postures looked at in one motion at most beyond the nodes'. A distance that is not known to be kept
/// after that counts as passed.
const MOST_LOOKS: usize = 100_000;
/// Parts of a step within which a clearance is stated at most.
const MOST_PARTS: usize = 12;

pub(super) struct Approach<'a> {
    clearances: &'a Clearances,
    /// How much of a clearance may be lacking.
    lacking: f64,
    /// R_j of each link, one a joint that moves it.
    reach: Vec<Vec<f64>>,
    /// The links where the step ends that was followed last.
    links: Vec<Segment<f64>>,
    looks_left: usize,
}

/// The two things of a clearance at a time after the beginning of a step.
#[derive(Clone)]
struct Moment {
    after: f64,
    things: [Segment<f64>; 2],
    /// From the nearest place of the first to that of the second.
    shortest: Vector3<f64>,
}

impl<'a> Approach<'a> {
    pub(super) fn new(clearances: &'a Clearances, lacking: f64) -> Self {
        Self {
            clearances,
            lacking,
            reach: reach(&clearances.system),
            links: Vec::new(),
            looks_left: MOST_LOOKS,
        }
    }

    /// Through the next step, which ends with the joints at `end`: adds the clearances that it does not
    /// keep.
    pub(super) fn follow(
        &mut self,
        step: &Step<'_>,
        end: &[f64],
        passed: &mut BTreeMap<usize, PassedClearance>,
    ) {
        if self.clearances.len() == 0 {
            return;
        }
        let system = &self.clearances.system;
        if self.links.is_empty() {
            self.links = system.kinematics(step.angles).segments;
        }
        let start = std::mem::replace(&mut self.links, system.kinematics(end).segments);
        for place in 0..self.clearances.len() {
            let between = self.clearances.between(place);
            let least = self.clearances.least_m(place);
            let enough = least - self.lacking;
            if enough <= 0.0 {
                continue;
            }
            let before = Moment::new(between, &start, 0.0);
            let after = Moment::new(between, &self.links, step.duration);
            let nearest = self.nearest(step, between, [&before, &after], enough, DEEPEST);
            if let Some(nearest) = nearest.filter(|&nearest| nearest < enough) {
                let parts = self.parts(least - nearest, after.moved_since(&before), enough);
                let worst = passed.entry(place).or_default();
                worst.parts = worst.parts.max(parts);
                worst.is_crossing |= nearest < 0.5 * least;
            }
        }
    }

    /// The least distance between two moments as far as it is seen; none where it is known to be no less
    /// than `enough`.
    fn nearest(
        &mut self,
        step: &Step<'_>,
        between: Between,
        [before, after]: [&Moment; 2],
        enough: f64,
        depth: usize,
    ) -> Option<f64> {
        let bound = before.gap(after, &before.shortest).max(before.gap(after, &after.shortest))
            - self.bend(step, between, before.after, after.after);
        if bound >= enough {
            return None;
        }
        let seen = before.shortest.norm().min(after.shortest.norm());
        // How deep a distance falls is known well enough at a tenth of what may be lacking.
        if seen < enough && bound >= seen - 0.1 * self.lacking {
            return Some(seen);
        }
        if depth == 0 || self.looks_left == 0 || !bound.is_finite() {
            return Some(bound.max(0.0));
        }
        self.looks_left -= 1;
        let middle = 0.5 * (before.after + after.after);
        let posture: Vec<f64> =
            (0..step.angles.len()).map(|joint| step.angle(joint, middle)).collect();
        let links = self.clearances.system.kinematics(&posture).segments;
        let middle = Moment::new(between, &links, middle);
        let halves = [[before, &middle], [&middle, after]];
        let found = halves
            .into_iter()
            .filter_map(|half| self.nearest(step, between, half, enough, depth - 1))
            .fold(f64::INFINITY, f64::min);
        found.is_finite().then_some(found)
    }

    /// The most that points of both things are off their straight ways in a part of a step.
    fn bend(&self, step: &Step<'_>, between: Between, from: f64, to: f64) -> f64 {
        let (first, second) = match between {
            Between::LinkAndBody(link) => (None, link),
            Between::Links(a, b) => (Some(a), b),
        };
        let largest = |joint: usize| {
            let at = |after: f64| (step.rates[joint] + after * step.accelerations[joint]).abs();
            at(from).max(at(to))
        };
        let of_link = |link: usize| {
            let reach = self.reach[link].iter().enumerate();
            let mut sums = [0.0; 3];
            for (joint, reach) in reach {
                sums[0] += reach * step.accelerations[joint].abs();
                sums[1] += largest(joint);
                sums[2] += reach * largest(joint);
            }
            (sums[0] + sums[1] * sums[2]) * (to - from).powi(2) / 8.0
        };
        of_link(second) + first.map_or(0.0, of_link)
    }

    /// Between how many equal parts of a step a clearance should be stated that is passed by `lacking`
    /// where the things move by `moved` in a step. A dip between two places shrinks with the square of
    /// their distance. What moves by less than twice the clearance between two places that keep it does
    /// not change sides.
    fn parts(&self, lacking: f64, moved: f64, enough: f64) -> usize {
        let against_dips = (lacking / self.lacking).sqrt().ceil();
        let against_crossing = (moved / (2.0 * enough)).ceil();
        // A number that is too large, or none, is cut.
        (against_dips.max(against_crossing) as usize).clamp(2, MOST_PARTS)
    }
}

impl Moment {
    fn new(between: Between, links: &[Segment<f64>], after: f64) -> Self {
        let things = match between {
            Between::LinkAndBody(link) => {
                [Segment::new(Vector3::zeros(), Vector3::zeros()), links[link].clone()]
            }
            Between::Links(a, b) => [links[a].clone(), links[b].clone()],
        };
        let shortest = things[1].shortest_from_segment(&things[0]);
        Self { after, things, shortest }
    }

    /// The gap between two planes across `normal` that part the things now and at another moment;
    /// negative where those do not part them.
    fn gap(&self, other: &Self, normal: &Vector3<f64>) -> f64 {
        let Some(normal) = normal.try_normalize(0.0) else { return 0.0 };
        let gap = |moment: &Self| {
            let [first, second] = [0, 1].map(|thing| {
                let segment = &moment.things[thing];
                let (start, end) = (segment.start.dot(&normal), segment.end().dot(&normal));
                (start.min(end), start.max(end))
            });
            second.0 - first.1
        };
        gap(self).min(gap(other))
    }

    /// How far an end of the one thing has moved at most as seen from an end of the other.
    fn moved_since(&self, other: &Self) -> f64 {
        let ends = |moment: &Self| {
            let [a, b] =
                [0, 1].map(|thing| [moment.things[thing].start, moment.things[thing].end()]);
            [b[0] - a[0], b[0] - a[1], b[1] - a[0], b[1] - a[1]]
        };
        let moved = ends(self).into_iter().zip(ends(other)).map(|(now, then)| (now - then).norm());
        moved.fold(0.0, f64::max)
    }
}

/// Of each link the lengths from each joint that moves it to its end.
fn reach(system: &System) -> Vec<Vec<f64>> {
    let lengths: Vec<f64> = system.links().iter().map(|link| link.length_m()).collect();
    // The first link beyond joint j: its own, or by Craig's convention the next.
    let first = match system.convention() {
        DhConvention::Standard => 0,
        DhConvention::Modified => 1,
    };
    (0..lengths.len())
        .map(|link| {
            let joints = 0..(link + 1 - first);
            joints.map(|joint| lengths[joint + first..=link].iter().sum()).collect()
        })
        .collect()
}
