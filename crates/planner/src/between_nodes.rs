//! Where a motion passes a limit between its nodes: the planner's own look, so that it can mend it.

mod approach;
mod cones;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};

use righting_ocp::Samples;
use righting_scenario::JointLimits;

use crate::formulation::{Clearances, Cones, Coordinates, Loads};
use approach::Approach;
use cones::PassedCone;

/// How far an angle may be past its limit, rad: nine tenths of what the verifier lets pass, as below.
const ANGLE_RAD: f64 = 9e-4;
/// How far a rate may be past its limit between nodes, rad a unit of time: the same.
const RATE: f64 = 9e-4;
/// How much of the clearance a distance may lack, …
const CLEARANCE_SHARE: f64 = 0.09;
/// … how much of the system's size at most, and how little is nothing.
const MOST_LACKING: f64 = 9e-4;
/// How much of its limit a load may be past it, …
const LOAD_SHARE: f64 = 9e-3;
/// … looked at where so many equal parts of a step end.
const LOAD_PARTS: usize = 8;
const LEAST_LACKING: f64 = 9e-7;

/// The limits that are passed between nodes.
#[derive(Clone, Debug, Default)]
pub(crate) struct PassedLimits {
    /// Joints whose angle or rate does, counted from zero.
    pub(crate) joints: BTreeSet<usize>,
    /// Clearances that are not kept, by their place in [`Clearances`].
    pub(crate) clearances: BTreeMap<usize, PassedClearance>,
    /// Whether a load is.
    pub(crate) has_load: bool,
    /// Cones on whose wrong side a boresight is, by their place in [`Cones`].
    pub(crate) cones: BTreeMap<usize, PassedCone>,
}

/// A clearance that is not kept between nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PassedClearance {
    /// Between how many equal parts of every step it would have to be stated, by what is seen of it.
    pub(crate) parts: usize,
    /// Whether less than half of it is left somewhere: things that go through each other.
    pub(crate) is_crossing: bool,
}

impl PassedLimits {
    pub(crate) fn is_empty(&self) -> bool {
        self.joints.is_empty()
            && self.clearances.is_empty()
            && self.cones.is_empty()
            && !self.has_load
    }

    /// Whether things go through each other, or a boresight through a cone.
    pub(crate) fn is_crossing(&self) -> bool {
        self.clearances.values().any(|passed| passed.is_crossing)
            || self.cones.values().any(|passed| passed.is_crossing)
    }
}

/// One step of a motion: joint angles, rates and accelerations where it begins, its jerks and its length.
#[derive(Clone, Copy)]
struct Step<'a> {
    angles: &'a [f64],
    rates: &'a [f64],
    accelerations: &'a [f64],
    jerks: &'a [f64],
    duration: f64,
}

impl Step<'_> {
    fn angle(&self, joint: usize, after: f64) -> f64 {
        let acceleration = self.accelerations[joint] + after * self.jerks[joint] / 3.0;
        self.angles[joint] + after * (self.rates[joint] + 0.5 * after * acceleration)
    }

    fn rate(&self, joint: usize, after: f64) -> f64 {
        let acceleration = self.accelerations[joint] + 0.5 * after * self.jerks[joint];
        self.rates[joint] + after * acceleration
    }

    fn acceleration(&self, joint: usize, after: f64) -> f64 {
        self.accelerations[joint] + after * self.jerks[joint]
    }

    /// A bound on the magnitude of a joint's rate between two times: a parabola is off its chord by |q⃛| Δt²/8
    /// at most.
    fn largest_rate(&self, joint: usize, [from, to]: [f64; 2]) -> f64 {
        let bulge = self.jerks[joint].abs() * (to - from).powi(2) / 8.0;
        self.rate(joint, from).abs().max(self.rate(joint, to).abs()) + bulge
    }

    fn largest_acceleration(&self, joint: usize, [from, to]: [f64; 2]) -> f64 {
        self.acceleration(joint, from).abs().max(self.acceleration(joint, to).abs())
    }

    /// The angle farthest past a limit where the joint turns back within the step, rad.
    fn excess_where_it_turns(&self, joint: usize, limits: &JointLimits) -> f64 {
        let (rate, acceleration) = (self.rates[joint], self.accelerations[joint]);
        let jerk = self.jerks[joint];
        let turns = if jerk == 0.0 {
            [-rate / acceleration, f64::NAN]
        } else {
            let root = (acceleration * acceleration - 2.0 * jerk * rate).sqrt();
            let sum = acceleration + root.copysign(acceleration);
            [-2.0 * rate / sum, -sum / jerk]
        };
        let within = turns.into_iter().filter(|&after| after > 0.0 && after < self.duration);
        let excesses = within.map(|after| {
            let angle = self.angle(joint, after);
            (angle - limits.angle_max_rad).max(limits.angle_min_rad - angle)
        });
        excesses.fold(f64::NEG_INFINITY, f64::max)
    }

    /// How far the rate is past its limit where it is the largest within the step.
    fn excess_of_rate(&self, joint: usize, limits: &JointLimits) -> f64 {
        let after = -self.accelerations[joint] / self.jerks[joint];
        match after > 0.0 && after < self.duration {
            true => self.rate(joint, after).abs() - limits.rate_max_rad_s,
            false => f64::NEG_INFINITY,
        }
    }
}

/// Which limits a motion passes between its nodes: `states` are the states there, one row more than
/// `controls`, and `duration` is the length of a step.
pub(crate) fn passed_limits(
    joint_limits: &[JointLimits],
    (clearances, loads, cones): (&Clearances, &Loads, &Cones),
    coordinates: &Coordinates,
    states: &Samples,
    controls: &Samples,
    duration: f64,
) -> PassedLimits {
    let size = clearances.system.size_m();
    let lacking = (CLEARANCE_SHARE * clearances.clearance_m())
        .min(MOST_LACKING * size)
        .max(LEAST_LACKING * size);
    let mut passed = PassedLimits::default();
    let mut approach = Approach::new(clearances, joint_limits, lacking);
    for ((x, next), u) in states.rows().zip(states.rows().skip(1)).zip(controls.rows()) {
        let step = Step {
            angles: coordinates.joint_angles(x),
            rates: coordinates.joint_rates(x),
            accelerations: &coordinates.accelerations(x, u),
            jerks: &coordinates.jerks(u),
            duration,
        };
        for (joint, limits) in joint_limits.iter().enumerate() {
            let is_passed = step.excess_where_it_turns(joint, limits) > ANGLE_RAD
                || step.excess_of_rate(joint, limits) > RATE;
            if is_passed {
                passed.joints.insert(joint);
            }
        }
        approach.follow(&step, coordinates.joint_angles(next), &mut passed.clearances);
        passed.has_load = passed.has_load
            || !loads.is_empty()
                && loads.largest_share(coordinates, (x, u), duration, LOAD_PARTS)
                    > 1.0 + LOAD_SHARE;
        if cones.len() > 0 {
            cones::follow(cones, coordinates, [x, next, u], duration, &mut passed.cones);
        }
    }
    passed
}
