//! Duration and grid of a scenario.

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Location};

/// The most intervals a horizon may have.
pub const MAX_STEPS: usize = 100_000;
/// The longest duration, s.
pub const LONGEST_S: f64 = 1e8;

const DURATION_S: Bounds = Bounds::Above(0.0, LONGEST_S);
const STEPS: Bounds = Bounds::Whole(1.0, MAX_STEPS as f64);

/// Duration and grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Horizon {
    /// Duration, s.
    pub duration_s: f64,
    /// Number of equal intervals N.
    pub steps: usize,
}

impl Horizon {
    /// Length of an interval Δt, s.
    pub fn step_s(self) -> f64 {
        self.duration_s / self.steps as f64
    }

    /// Time of node `k`, s.
    pub fn time_s(self, k: usize) -> f64 {
        self.duration_s * k as f64 / self.steps as f64
    }

    /// Checks a horizon that was read from `place`.
    pub(crate) fn from_file(horizon: &file::Horizon, place: &Location) -> Result<Horizon, Error> {
        Ok(Horizon {
            duration_s: place.key("duration_s").within(horizon.duration_s, DURATION_S)?,
            steps: place.key("steps").within(horizon.steps, STEPS)? as usize,
        })
    }
}
