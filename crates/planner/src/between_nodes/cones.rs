//! How far boresights come on the wrong side of their cones within a step.
//!
//! Between two moments a boresight goes no farther than the base turns. So with the angles θ₀ and θ₁ from the
//! cone's axis there and the turn φ, it comes no nearer to the axis than (θ₀ + θ₁ − φ)/2, and no farther from
//! it than (θ₀ + θ₁ + φ)/2; an axis that moves adds how far it does. Where that is not enough, the step is
//! followed at places so close together that the base hardly turns between them.

use std::collections::BTreeMap;

use righting_scenario::{ConeSide, Pointing};

use super::ANGLE_RAD;
use crate::formulation::{Cones, Coordinates};

/// How far the base turns between two places that are looked at, rad.
const TURN_RAD: f64 = 5e-3;
/// Places that are looked at within a step at most.
const MOST_PLACES: usize = 1000;
/// Parts of a step within which a cone is stated at most.
const MOST_PARTS: usize = 12;
/// A boresight that comes nearer to the axis than this share of the half-angle goes through the cone.
const CROSSING_SHARE: f64 = 0.5;

/// A cone on whose wrong side a boresight is between nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PassedCone {
    /// Between how many equal parts of every step it would have to be stated, by what is seen of it.
    pub(crate) parts: usize,
    /// Whether the boresight goes right through a cone that it keeps out of.
    pub(crate) is_crossing: bool,
}

/// Looks at a step from state `x` with the controls `u` that takes `duration` and ends in `next`: adds
/// the cones on whose wrong side the boresights are within it.
pub(super) fn follow(
    cones: &Cones,
    coordinates: &Coordinates,
    [x, next, u]: [&[f64]; 3],
    duration: f64,
    passed: &mut BTreeMap<usize, PassedCone>,
) {
    let [start, end] = [x, next].map(|x| coordinates.free_floating_state(x));
    let fastest = start.angular_rate.norm().max(end.angular_rate.norm());
    let [start, end] = [start, end].map(|state| state.attitude.normalized());
    let turn_rad = start.angle_to(&end).max(fastest * duration);
    let [start_time, end_time] = [x, next].map(|x| coordinates.time_of(x));
    let may_pass = |cone: &Pointing| {
        let sum = cone.angle_rad(&start, start_time) + cone.angle_rad(&end, end_time);
        let [from, to] = [start_time, end_time].map(|time| cone.direction.at(time));
        let turn_rad = turn_rad + from.angle(&to);
        let farthest = match cone.side {
            ConeSide::Outside => 0.5 * (sum - turn_rad),
            ConeSide::Inside => 0.5 * (sum + turn_rad),
        };
        cone.excess_rad(farthest) > ANGLE_RAD
    };
    let near: Vec<usize> = (0..cones.len()).filter(|&place| may_pass(cones.get(place))).collect();
    if near.is_empty() {
        return;
    }
    // A turn that is too large, or no number, is cut.
    let parts = ((turn_rad / TURN_RAD).ceil() as usize).clamp(2, MOST_PLACES);
    let share = duration / parts as f64;
    let mut there = x.to_vec();
    let mut worst = vec![f64::NEG_INFINITY; near.len()];
    for _ in 1..parts {
        there = coordinates.moved_on(&there, u, share);
        let (attitude, time) = (coordinates.attitude_of(&there), coordinates.time_of(&there));
        for (&place, worst) in near.iter().zip(&mut worst) {
            let cone = cones.get(place);
            *worst = worst.max(cone.excess_rad(cone.angle_rad(&attitude, time)));
        }
    }
    for (place, excess) in near.into_iter().zip(worst) {
        if excess > ANGLE_RAD {
            let cone = cones.get(place);
            let seen = passed.entry(place).or_default();
            // What is beyond the cone between two places shrinks with the square of their distance.
            let parts = (excess / ANGLE_RAD).sqrt().ceil() as usize;
            seen.parts = seen.parts.max(parts.clamp(2, MOST_PARTS));
            let is_deep = excess > (1.0 - CROSSING_SHARE) * cone.half_angle_rad;
            seen.is_crossing |= cone.side == ConeSide::Outside && is_deep;
        }
    }
}
