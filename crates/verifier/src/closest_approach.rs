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

use crate::clearances::{Inner, Pair, Situation};
use crate::joints::{Accelerations, Joints};
use crate::ledger::{Subject, Worst};
use crate::model::{Pose, State};
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
    /// Largest rates and accelerations in a stretch.
    rates: Vec<f64>,
    accelerations: Vec<f64>,
    /// The arm's frames at the beginning of the interval, at its end, and within.
    start: Vec<Pose>,
    end: Vec<Pose>,
    within: Vec<Pose>,
    looks_left: usize,
}

/// An interval between two nodes.
#[derive(Clone, Copy)]
pub(super) struct Interval<'i> {
    pub start: State<'i>,
    pub end: State<'i>,
    pub accelerations: Accelerations<'i>,
    pub start_s: f64,
    pub duration_s: f64,
}

/// The two things of a clearance at a time.
#[derive(Clone, Copy)]
struct Moment {
    after_s: f64,
    situation: Situation,
    distance_m: f64,
}

impl<'a> ClosestApproach<'a> {
    /// Before the first interval, which begins with `start`.
    pub fn new(asked: &'a Requirements, start: &State<'_>) -> Self {
        let joints = asked.model.joint_count();
        let mut frames = vec![Pose::identity(); asked.model.frame_count()];
        asked.model.frames(start.joint_angles, &mut frames);
        Self {
            asked,
            joints: Joints::new(joints),
            rates: vec![0.0; joints],
            accelerations: vec![0.0; joints],
            start: frames.clone(),
            end: frames.clone(),
            within: frames,
            looks_left: MOST_LOOKS,
        }
    }

    /// Through the next interval: enters the places where a distance falls below what is allowed.
    pub fn follow(&mut self, interval: &Interval<'_>, body: &mut Worst, links: &mut Worst) {
        let asked = self.asked;
        asked.model.frames(interval.end.joint_angles, &mut self.end);
        for pair in asked.clearances.all() {
            let before = self.moment(pair, &self.start, 0.0);
            let after = self.moment(pair, &self.end, interval.duration_s);
            let worst = if pair.is_with_base() { &mut *body } else { &mut *links };
            self.look(interval, pair, &before, &after, 0, worst);
        }
        std::mem::swap(&mut self.start, &mut self.end);
    }

    /// Looks between two moments for as long as the distance may be too small there.
    fn look(
        &mut self,
        interval: &Interval<'_>,
        pair: &Pair,
        before: &Moment,
        after: &Moment,
        depth: usize,
        worst: &mut Worst,
    ) {
        let least_m = pair.least_m;
        let too_small_m = worst.counts_below(least_m);
        let bound_m = self.bound_m(interval, pair, before, after, too_small_m);
        // What is no number has been entered as such at the fixed places.
        if bound_m.is_nan() || bound_m >= too_small_m {
            return;
        }
        let subject = Some(Subject::Clearance(pair.between));
        if depth == DEEPEST || self.looks_left == 0 || bound_m.is_infinite() {
            worst.at_least(bound_m, least_m, subject, Some(interval.start_s + before.after_s));
            return;
        }
        self.looks_left -= 1;
        let after_s = 0.5 * (before.after_s + after.after_s);
        self.joints.move_on(&interval.start, interval.accelerations, after_s);
        self.asked.model.frames(&self.joints.angles, &mut self.within);
        let middle = self.moment(pair, &self.within, after_s);
        worst.at_least(middle.distance_m, least_m, subject, Some(interval.start_s + after_s));
        self.look(interval, pair, before, &middle, depth + 1, worst);
        self.look(interval, pair, &middle, after, depth + 1, worst);
    }

    fn moment(&self, pair: &Pair, frames: &[Pose], after_s: f64) -> Moment {
        let situation = self.asked.clearances.situation(pair, frames);
        Moment { after_s, situation, distance_m: situation.distance_m() }
    }

    /// The distance is no less between the two moments. The better bound is only looked for where the
    /// cheap one is below `enough_m`.
    fn bound_m(
        &mut self,
        interval: &Interval<'_>,
        pair: &Pair,
        before: &Moment,
        after: &Moment,
        enough_m: f64,
    ) -> f64 {
        let ends = [before.after_s, after.after_s];
        let duration_s = after.after_s - before.after_s;
        let accelerations = interval.accelerations;
        for (joint, rate) in interval.start.joint_rates.iter().enumerate() {
            let jerk = accelerations.jerk(joint);
            let at = |after_s: f64| {
                let gained = accelerations.at(joint, 0.0) * after_s;
                (rate + gained + 0.5 * jerk * after_s * after_s).abs()
            };
            // Between the ends a parabola is off its chord by |q⃛| Δt²/8 at most.
            let bulge = jerk.abs() * duration_s * duration_s / 8.0;
            self.rates[joint] = at(before.after_s).max(at(after.after_s)) + bulge;
            self.accelerations[joint] = accelerations.largest(joint, ends);
        }
        let stretch = Stretch {
            reach: &self.asked.reach,
            rates: &self.rates,
            accelerations: &self.accelerations,
            duration_s,
        };
        let (inboard, outboard) = match pair.inner {
            Inner::Segment(_) | Inner::Cuboid(_) => (None, pair.outer),
            Inner::Solid(inboard) => (Some(inboard), pair.outer),
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
    /// The gap between two planes that part the two things now and at another moment, m, across the
    /// shortest way between them at a third; negative where those planes do not part them.
    fn gap_m(&self, other: &Self, across: &Self) -> f64 {
        match across.situation.direction() {
            Some(direction) => {
                self.situation.gap_m(&direction).min(other.situation.gap_m(&direction))
            }
            None => across.situation.least_m(),
        }
    }
}
