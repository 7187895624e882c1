//! Checks about joints: of those that turn and those that slide, each in its own unit.

use crate::ledger::{Ledger, Subject, Worst};

/// The worst places of a quantity of the joints that turn, and of the same of those that slide.
pub(super) struct WorstOfJoints<'a> {
    slides: &'a [bool],
    turning: Worst,
    sliding: Worst,
}

impl<'a> WorstOfJoints<'a> {
    /// Which joints slide, and the check of each kind of joints.
    pub fn new(slides: &'a [bool], turning: Worst, sliding: Worst) -> Self {
        Self { slides, turning, sliding }
    }

    /// A joint's value that must not exceed `limit`.
    pub fn at_most(&mut self, joint: usize, value: f64, limit: f64, time_s: f64) {
        self.of(joint).at_most(value, limit, Some(Subject::Joint(joint)), Some(time_s));
    }

    /// A joint's value that must not fall below `limit`.
    pub fn at_least(&mut self, joint: usize, value: f64, limit: f64, time_s: f64) {
        self.of(joint).at_least(value, limit, Some(Subject::Joint(joint)), Some(time_s));
    }

    /// A joint's value that must not exceed what its kind is allowed: joints that turn, joints that slide.
    pub fn within(&mut self, joint: usize, value: f64, limits: [f64; 2], time_s: f64) {
        self.at_most(joint, value, limits[usize::from(self.slides[joint])], time_s);
    }

    fn of(&mut self, joint: usize) -> &mut Worst {
        if self.slides[joint] { &mut self.sliding } else { &mut self.turning }
    }

    /// The larger of the values at the two worst places.
    pub fn value(&self) -> f64 {
        self.turning.value().max(self.sliding.value())
    }

    /// Enters both checks.
    pub fn enter(self, ledger: &mut Ledger) {
        ledger.add(self.turning);
        ledger.add(self.sliding);
    }
}
