//! How a plan is flown.

use std::time::Duration;

use crate::faults::Faults;
use crate::joint_drives::JointDrives;
use crate::sensors::Sensors;
use crate::spreads::Spreads;

/// What is done about a spacecraft that is not as planned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Nothing: the plan is flown as it is.
    OpenLoop,
    /// Its gains correct every step from what is measured then.
    Feedback,
    /// The rest is planned anew every [`period`](Settings::period_s).
    Replan,
    /// The rest is planned anew, and gains correct the steps between.
    Both,
}

impl Control {
    /// Whether gains correct steps.
    pub fn has_feedback(self) -> bool {
        matches!(self, Self::Feedback | Self::Both)
    }

    /// Whether the rest is planned anew on the way.
    pub fn has_replans(self) -> bool {
        matches!(self, Self::Replan | Self::Both)
    }
}

/// How a plan is flown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How far the plants are from the model.
    pub spreads: Spreads,
    /// How the joints follow what they are told.
    pub drives: JointDrives,
    /// What is measured.
    pub sensors: Sensors,
    /// What fails.
    pub faults: Faults,
    /// What is done about it.
    pub control: Control,
    /// Time from one replan to the next, s; rounded to whole steps of the plan, at least one.
    pub period_s: f64,
    /// Time from a measurement to the first step of the replan that it leads to, s; rounded to whole steps.
    pub delay_s: f64,
    /// Whether replans are made with the masses that the flight has shown, rather than the plan's.
    pub estimates_masses: bool,
    /// A replan that takes longer is missed, and the last plan goes on; none if there is no deadline.
    pub deadline: Option<Duration>,
    /// Seed of all draws.
    pub seed: u64,
}

impl Default for Settings {
    /// Masses and inertias off by up to 10 %, a replan a second with the masses that the flight has shown, perfect
    /// sensors and drives.
    fn default() -> Self {
        Self {
            spreads: Spreads { masses: 0.1, inertias: 0.1, ..Spreads::default() },
            drives: JointDrives::default(),
            sensors: Sensors::default(),
            faults: Faults::default(),
            control: Control::Replan,
            period_s: 1.0,
            delay_s: 0.0,
            estimates_masses: true,
            deadline: None,
            seed: 0,
        }
    }
}
