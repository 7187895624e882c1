//! How near links come to each other and to the base within a step.
//!
//! Over a stretch of time a distance is no less than the gap between two parallel planes that part the two
//! things at its beginning and at its end, less what their points can be off the straight way between:
//! max |p̈| Δt²/8 for each (the error of linear interpolation). With R_j how far a point can be from joint j,
//! |p̈| ≤ Σ R_j |q̈_j| + (Σ |q̇_j|)(Σ R_j |q̇_j|). Where that is not enough, the stretch is
//! halved, so that links that pass through each other between two places are found. A joint that slides has an
//! R_j of 1, does not count in Σ |q̇_j|, and counts twice in what that multiplies: it adds q̈_j e_j and
//! 2 q̇_i q̇_j e_i × e_j for every joint i that turns it.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use righting_multibody::{Core, Cuboid, JointKind, Kinematics, Segment};
use righting_scenario::JointLimits;
use righting_scenario::bodies::KeepOut;
use righting_scenario::collision::{Other, Pair};

use super::{PassedClearance, Step};
use crate::formulation::Clearances;

/// Halvings of a step at most.
const DEEPEST: usize = 30;
/// Postures looked at in one motion at most beyond the nodes'. A distance that is not known to be kept
/// after that counts as passed.
const MOST_LOOKS: usize = 100_000;
/// Parts of a step within which a clearance is stated at most.
const MOST_PARTS: usize = 12;

/// Joints, and how far from the axis of each a point can be.
type Reach = Vec<(usize, f64)>;

pub(super) struct Approach<'a> {
    clearances: &'a Clearances,
    /// How much of a clearance may be lacking.
    lacking: f64,
    /// Of each clearance, R_j of what it has of the arm: of the outer thing, then of the inner one if that
    /// moves too; of each joint that moves it.
    reach: Vec<Vec<Reach>>,
    /// Which joints slide.
    slides: Vec<bool>,
    /// The arm where the step ends that was followed last.
    posture: Option<Kinematics<f64>>,
    looks_left: usize,
}

/// The two things of a clearance at a time after the beginning of a step, without their radii.
#[derive(Clone)]
struct Moment {
    after: f64,
    inner: Thing,
    outer: Segment<f64>,
    /// From the nearest place of the first to that of the second.
    shortest: Vector3<f64>,
}

impl<'a> Approach<'a> {
    pub(super) fn new(
        clearances: &'a Clearances,
        joint_limits: &[JointLimits],
        lacking: f64,
    ) -> Self {
        let farthest: Vec<f64> = joint_limits.iter().map(JointLimits::farthest).collect();
        let places = 0..clearances.len();
        Self {
            clearances,
            lacking,
            reach: places.map(|place| reach(clearances, place, &farthest)).collect(),
            slides: joint_limits.iter().map(|of| of.kind == JointKind::Prismatic).collect(),
            posture: None,
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
        let start = self.posture.take().unwrap_or_else(|| system.kinematics(step.angles));
        let end = system.kinematics(end);
        for place in 0..self.clearances.len() {
            let pair = self.clearances.pair(place);
            let least = pair.least_of_cores_m();
            let enough = least - self.lacking;
            if enough <= 0.0 {
                continue;
            }
            let before = Moment::new(pair, &start, 0.0);
            let after = Moment::new(pair, &end, step.duration);
            let nearest = self.nearest(step, place, [&before, &after], enough, DEEPEST);
            if let Some(nearest) = nearest.filter(|&nearest| nearest < enough) {
                let parts = self.parts(least - nearest, after.moved_since(&before), enough);
                let worst = passed.entry(place).or_default();
                worst.parts = worst.parts.max(parts);
                worst.is_crossing |= nearest < 0.5 * least;
            }
        }
        self.posture = Some(end);
    }

    /// The least distance between two moments as far as it is seen; none where it is known to be no less
    /// than `enough`.
    fn nearest(
        &mut self,
        step: &Step<'_>,
        place: usize,
        [before, after]: [&Moment; 2],
        enough: f64,
        depth: usize,
    ) -> Option<f64> {
        let bound = before.gap(after, &before.shortest).max(before.gap(after, &after.shortest))
            - self.bend(step, place, before.after, after.after);
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
        let posture = self.clearances.system.kinematics(&posture);
        let middle = Moment::new(self.clearances.pair(place), &posture, middle);
        let halves = [[before, &middle], [&middle, after]];
        let found = halves
            .into_iter()
            .filter_map(|half| self.nearest(step, place, half, enough, depth - 1))
            .fold(f64::INFINITY, f64::min);
        found.is_finite().then_some(found)
    }

    /// The most that points of both things are off their straight ways in a part of a step.
    fn bend(&self, step: &Step<'_>, place: usize, from: f64, to: f64) -> f64 {
        let of_thing = |reach: &Reach| {
            let mut sums = [0.0; 3];
            for &(joint, reach) in reach {
                let rate = step.largest_rate(joint, [from, to]);
                sums[0] += reach * step.largest_acceleration(joint, [from, to]);
                match self.slides[joint] {
                    true => sums[2] += 2.0 * reach * rate,
                    false => {
                        sums[1] += rate;
                        sums[2] += reach * rate;
                    }
                }
            }
            (sums[0] + sums[1] * sums[2]) * (to - from).powi(2) / 8.0
        };
        self.reach[place].iter().map(of_thing).sum()
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

/// The inner thing of a clearance.
#[derive(Clone)]
enum Thing {
    Segment(Segment<f64>),
    Cuboid(Cuboid),
}

impl Thing {
    /// Least and largest coordinate along a direction of length one.
    fn extent(&self, direction: &Vector3<f64>) -> [f64; 2] {
        match self {
            Self::Segment(segment) => extent(segment, direction),
            Self::Cuboid(cuboid) => cuboid.extent_m(direction),
        }
    }

    /// The ends of a segment; a box does not move, whatever is taken of it.
    fn ends(&self) -> [Vector3<f64>; 2] {
        match self {
            Self::Segment(segment) => [segment.start, segment.end()],
            Self::Cuboid(cuboid) => [cuboid.center_m; 2],
        }
    }
}

fn extent(segment: &Segment<f64>, direction: &Vector3<f64>) -> [f64; 2] {
    let (start, end) = (segment.start.dot(direction), segment.end().dot(direction));
    [start.min(end), start.max(end)]
}

impl Moment {
    fn new(pair: &Pair, posture: &Kinematics<f64>, after: f64) -> Self {
        let outer = posture.core(&pair.solid.core);
        let inner = match &pair.other {
            Other::Center => Thing::Segment(Segment::new(Vector3::zeros(), Vector3::zeros())),
            Other::KeepOut(KeepOut::Capsule { ends_m: [from, to], .. }) => {
                Thing::Segment(Segment::new(*from, *to))
            }
            Other::KeepOut(KeepOut::Cuboid(cuboid)) => Thing::Cuboid(*cuboid),
            Other::Solid(inboard) => Thing::Segment(posture.core(&inboard.core)),
        };
        let shortest = match &inner {
            Thing::Segment(inner) => outer.shortest_from_segment(inner),
            Thing::Cuboid(cuboid) => cuboid.shortest_to_segment(&outer),
        };
        Self { after, inner, outer, shortest }
    }

    /// The gap between two planes across `normal` that part the things now and at another moment;
    /// negative where those do not part them.
    fn gap(&self, other: &Self, normal: &Vector3<f64>) -> f64 {
        let Some(normal) = normal.try_normalize(0.0) else { return 0.0 };
        let gap = |moment: &Self| {
            let ([_, top], [bottom, _]) =
                (moment.inner.extent(&normal), extent(&moment.outer, &normal));
            bottom - top
        };
        gap(self).min(gap(other))
    }

    /// How far an end of the one thing has moved at most as seen from an end of the other.
    fn moved_since(&self, other: &Self) -> f64 {
        let ends = |moment: &Self| {
            let (a, b) = (moment.inner.ends(), [moment.outer.start, moment.outer.end()]);
            [b[0] - a[0], b[0] - a[1], b[1] - a[0], b[1] - a[1]]
        };
        let moved = ends(self).into_iter().zip(ends(other)).map(|(now, then)| (now - then).norm());
        moved.fold(0.0, f64::max)
    }
}

/// R_j of what a clearance has of the arm, the coordinates of joints that slide being no larger than `farthest`.
fn reach(clearances: &Clearances, place: usize, farthest: &[f64]) -> Vec<Reach> {
    let pair = clearances.pair(place);
    let reach = |core: &Core| clearances.system.levers(core, farthest);
    match &pair.other {
        Other::Solid(inboard) => vec![reach(&pair.solid.core), reach(&inboard.core)],
        Other::Center | Other::KeepOut(_) => vec![reach(&pair.solid.core)],
    }
}
