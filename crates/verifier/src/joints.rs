//! The joints between two nodes.

use crate::model::State;

/// Joint angles and rates under constant acceleration.
pub(super) struct Joints {
    pub angles: Vec<f64>,
    pub rates: Vec<f64>,
}

impl Joints {
    pub fn new(count: usize) -> Self {
        Self { angles: vec![0.0; count], rates: vec![0.0; count] }
    }

    /// From `state`, `after_s` later.
    pub fn move_on(&mut self, state: &State<'_>, control: &[f64], after_s: f64) {
        for (joint, acceleration) in control.iter().enumerate() {
            let (angle, rate) = (state.joint_angles[joint], state.joint_rates[joint]);
            let gained = acceleration * after_s;
            self.angles[joint] = angle + (rate + 0.5 * gained) * after_s;
            self.rates[joint] = rate + gained;
        }
    }
}
