//! The clearances over whole intervals: between two samples nothing gets past.
//!
//! A distance that is kept at both ends of a stretch of time says little of the time between, when two
//! thin links can pass through each other. How far they can move in it says more. The distance is never
//! less than
//!
//! - (d₁ + d₂ − s)/2, with d₁ and d₂ the distances at the ends and s the most that a point of the one
//!   moves as seen from the other;
//! - the gap between two parallel planes that have the one link on their one side and the other link on
//!   the other, at both ends of the stretch, less what points of the links can be off their straight way
//!   between.
//!
//! Where neither is enough, the stretch is halved.

use nalgebra::Vector3;
use righting_scenario::collision::Between;

use crate::joints::Joints;
use crate::ledger::{Subject, Worst};
use crate::model::{Segment, State};
use crate::motion_bound::Stretch;
use crate::requirements::Requirements;

/// Halvings of an interval at most: what is then left is of the size of rounding.
const DEEPEST: usize = 40;
/// Places looked at in one maneuver at most, beyond those of a fixed number in every interval. What
/// cannot be decided with them counts at its lower bound.
const MOST_LOOKS: usize = 200_000;

/// Follows the links through a maneuver, one interval after the other.
pub(super) struct ClosestApproach<'a> {
    asked: &'a Requirements,
    joints: Joints,
    /// Largest rates in a stretch.
    rates: Vec<f64>,
    /// Origins of the arm's frames at the beginning of the interval, at its end, and within.
    start: Vec<Vector3<f64>>,
    end: Vec<Vector3<f64>>,
    within: Vec<Vector3<f64>>,
    looks_left: usize,
}

/// An interval with constant joint accelerations.
#[derive(Clone, Copy)]
pub(super) struct Interval<'i> {
    pub start: State<'i>,
    pub end: State<'i>,
    pub accelerations: &'i [f64],
    pub start_s: f64,
    pub duration_s: f64,
}

/// The two things of a clearance at a time.
#[derive(Clone, Copy)]
struct Moment {
    after_s: f64,
    segments: [Segment; 2],
    distance_m: f64,
}

impl<'a> ClosestApproach<'a> {
    /// Before the first interval, which begins with `start`.
    pub fn new(asked: &'a Requirements, start: &State<'_>) -> Self {
        let joints = asked.model.joint_count();
        let mut origins = vec![Vector3::zeros(); joints + 1];
        asked.model.origins(start.joint_angles, &mut origins);
        Self {
            asked,
            joints: Joints::new(joints),
            rates: vec![0.0; joints],
            start: origins.clone(),
            end: origins.clone(),
            within: origins,
            looks_left: MOST_LOOKS,
        }
    }

    /// Through the next interval: enters the places where a distance falls below what is allowed.
    pub fn follow(&mut self, interval: &Interval<'_>, body: &mut Worst, links: &mut Worst) {
        let asked = self.asked;
        asked.model.origins(interval.end.joint_angles, &mut self.end);
        for between in asked.clearances.all() {
            let before = Moment::new(between, &self.start, 0.0);
            let after = Moment::new(between, &self.end, interval.duration_s);
            let worst = match between {
                Between::LinkAndBody(_) => &mut *body,
                Between::Links(..) => &mut *links,
            };
            self.look(interval, between, &before, &after, 0, worst);
        }
        std::mem::swap(&mut self.start, &mut self.end);
    }

    /// Looks between two moments for as long as the distance may be too small there.
    fn look(
        &mut self,
        interval: &Interval<'_>,
        between: Between,
        before: &Moment,
        after: &Moment,
        depth: usize,
        worst: &mut Worst,
    ) {
        let least_m = self.asked.clearances.least_m(between);
        let too_small_m = worst.counts_below(least_m);
        let bound_m = self.bound_m(interval, between, before, after, too_small_m);
        // What is no number has been entered as such at the fixed places.
        if bound_m.is_nan() || bound_m >= too_small_m {
            return;
        }
        let subject = Some(Subject::Clearance(between));
        if depth == DEEPEST || self.looks_left == 0 || bound_m.is_infinite() {
            worst.at_least(bound_m, least_m, subject, Some(interval.start_s + before.after_s));
            return;
        }
        self.looks_left -= 1;
        let after_s = 0.5 * (before.after_s + after.after_s);
        self.joints.move_on(&interval.start, interval.accelerations, after_s);
        self.asked.model.origins(&self.joints.angles, &mut self.within);
        let middle = Moment::new(between, &self.within, after_s);
        worst.at_least(middle.distance_m, least_m, subject, Some(interval.start_s + after_s));
        self.look(interval, between, before, &middle, depth + 1, worst);
        self.look(interval, between, &middle, after, depth + 1, worst);
    }

    /// The distance is no less between the two moments. The better bound is only looked for where the
    /// cheap one is below `enough_m`.
    fn bound_m(
        &mut self,
        interval: &Interval<'_>,
        between: Between,
        before: &Moment,
        after: &Moment,
        enough_m: f64,
    ) -> f64 {
        let joints = interval.start.joint_rates.iter().zip(interval.accelerations);
        for (largest, (rate, acceleration)) in self.rates.iter_mut().zip(joints) {
            let at = |after_s: f64| (rate + acceleration * after_s).abs();
            *largest = at(before.after_s).max(at(after.after_s));
        }
        let stretch = Stretch {
            reach: &self.asked.reach,
            rates: &self.rates,
            accelerations: interval.accelerations,
            duration_s: after.after_s - before.after_s,
        };
        let (inboard, outboard) = match between {
            Between::LinkAndBody(link) => (None, link),
            Between::Links(a, b) => (Some(a), b),
        };
        let travel_m = stretch.travel_m(outboard, inboard);
        let by_travel_m = 0.5 * (before.distance_m + after.distance_m - travel_m);
        if by_travel_m.is_nan() || by_travel_m >= enough_m {
            return by_travel_m;
        }
        let bend_m =
            stretch.bend_m(outboard) + inboard.map_or(0.0, |inboard| stretch.bend_m(inboard));
        let gap_m = before.gap_m(after, before).max(before.gap_m(after, after));
        by_travel_m.max(gap_m - bend_m)
    }
}

impl Moment {
    fn new(between: Between, origins: &[Vector3<f64>], after_s: f64) -> Self {
        let segment = |link: usize| Segment { start: origins[link], end: origins[link + 1] };
        let center = Vector3::zeros();
        let (segments, distance_m) = match between {
            Between::LinkAndBody(link) => (
                [Segment { start: center, end: center }, segment(link)],
                segment(link).distance_to_point(&center),
            ),
            Between::Links(a, b) => {
                let segments = [segment(a), segment(b)];
                (segments, segments[0].distance_to_segment(&segments[1]))
            }
        };
        Self { after_s, segments, distance_m }
    }

    /// The gap between two planes that part the two things now and at another moment, m, across the
    /// shortest way between them at a third; negative where those planes do not part them.
    fn gap_m(&self, other: &Self, across: &Self) -> f64 {
        let [first, second] = &across.segments;
        let Some(normal) = first.shortest_to_segment(second).try_normalize(0.0) else {
            return 0.0;
        };
        let gap_m = |moment: &Self| {
            let [first, second] = moment.segments.map(|segment| {
                let (start, end) = (segment.start.dot(&normal), segment.end.dot(&normal));
                (start.min(end), start.max(end))
            });
            second.0 - first.1
        };
        gap_m(self).min(gap_m(other))
    }
}
