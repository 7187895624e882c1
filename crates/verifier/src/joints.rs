//! The joints between two nodes.

use righting_results::trajectory::ControlInterval;

use crate::model::State;

/// What the joints do over an interval: accelerations that are held, or linear in time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Accelerations<'i> {
    at_start: &'i [f64],
    /// Empty where accelerations are held.
    jerks: &'i [f64],
}

impl<'i> Accelerations<'i> {
    pub fn of(interval: &'i ControlInterval) -> Self {
        Self { at_start: &interval.joint_accelerations_rad_s2, jerks: &interval.joint_jerks_rad_s3 }
    }

    pub fn jerk(self, joint: usize) -> f64 {
        self.jerks.get(joint).copied().unwrap_or(0.0)
    }

    /// A joint's acceleration `after_s` the interval's beginning.
    pub fn at(self, joint: usize, after_s: f64) -> f64 {
        match self.jerks.get(joint) {
            Some(jerk) => self.at_start[joint] + jerk * after_s,
            None => self.at_start[joint],
        }
    }

    /// All of them, into `accelerations`.
    pub fn write(self, after_s: f64, accelerations: &mut [f64]) {
        for (joint, acceleration) in accelerations.iter_mut().enumerate() {
            *acceleration = self.at(joint, after_s);
        }
    }

    /// The largest magnitude of a joint's acceleration between two times: of a line, at one of its ends.
    pub fn largest(self, joint: usize, [from_s, to_s]: [f64; 2]) -> f64 {
        self.at(joint, from_s).abs().max(self.at(joint, to_s).abs())
    }

    /// When a joint that has a rate at the interval's beginning stands still, if it ever does: roots of
    /// q̇ + q̈ t + ½ q⃛ t².
    pub fn standstills(self, joint: usize, rate: f64) -> impl Iterator<Item = f64> {
        let (acceleration, jerk) = (self.at_start[joint], self.jerk(joint));
        let roots = if jerk == 0.0 {
            [-rate / acceleration, f64::NAN]
        } else {
            let root = (acceleration * acceleration - 2.0 * jerk * rate).sqrt();
            let sum = acceleration + root.copysign(acceleration);
            [-2.0 * rate / sum, -sum / jerk]
        };
        roots.into_iter()
    }

    /// When a joint's rate is the largest or the least: where its acceleration passes zero.
    pub fn extreme_rate(self, joint: usize) -> f64 {
        -self.at_start[joint] / self.jerk(joint)
    }
}

/// Joint angles and rates under such accelerations.
pub(super) struct Joints {
    pub angles: Vec<f64>,
    pub rates: Vec<f64>,
}

impl Joints {
    pub fn new(count: usize) -> Self {
        Self { angles: vec![0.0; count], rates: vec![0.0; count] }
    }

    /// From `state`, `after_s` later.
    pub fn move_on(&mut self, state: &State<'_>, accelerations: Accelerations<'_>, after_s: f64) {
        for joint in 0..self.angles.len() {
            let (angle, rate) = (state.joint_angles[joint], state.joint_rates[joint]);
            let gained = accelerations.at(joint, 0.0) * after_s;
            let by_jerk = accelerations.jerk(joint) * after_s * after_s;
            self.angles[joint] = angle + (rate + 0.5 * gained + by_jerk / 6.0) * after_s;
            self.rates[joint] = rate + gained + 0.5 * by_jerk;
        }
    }
}
