//! Duration and grid of a scenario.

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Location, Number};

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

    /// Checks a horizon that was read from `place`: as long as it may be where its duration is free.
    pub(crate) fn from_file(
        horizon: &file::Horizon,
        place: &Location,
    ) -> Result<(Horizon, Option<FreeDuration>), Error> {
        let duration_place = place.key("duration_s");
        let free = match horizon.duration_s {
            file::Duration::Given(duration_s) => {
                duration_place.within(duration_s, DURATION_S)?;
                None
            }
            file::Duration::Free(file::DurationRange { min, max }) => {
                duration_place.key("max").within(max, DURATION_S)?;
                duration_place.key("min").within(min, DURATION_S)?;
                if min >= max {
                    let allowed = format!("a number below max, {}", Number(max));
                    return Err(duration_place.key("min").refuse(Number(min), allowed));
                }
                Some(FreeDuration { shortest_s: min })
            }
        };
        let horizon = Horizon {
            duration_s: horizon.duration_s.longest_s(),
            steps: place.key("steps").within(horizon.steps, STEPS)? as usize,
        };
        Ok((horizon, free))
    }
}

/// A duration that the plan chooses: at most that of the [`Horizon`], and at least this.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeDuration {
    /// The shortest, s.
    pub shortest_s: f64,
}
