//! What fails on a flight.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::joint_drives::Stuck;

/// What fails, at random times and once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Faults {
    /// Share of the measurements that are lost: they are no numbers.
    pub lost_measurements: f64,
    /// Share of the replans that are not made in time.
    pub missed_replans: f64,
    /// A joint that stops and does not move any more.
    pub stuck: Option<Stuck>,
}

impl Faults {
    pub(crate) fn loses_measurement(&self, draws: &mut ChaCha8Rng) -> bool {
        happens(self.lost_measurements, draws)
    }

    pub(crate) fn misses_replan(&self, draws: &mut ChaCha8Rng) -> bool {
        happens(self.missed_replans, draws)
    }
}

/// Draws nothing where it never happens, so that a fault changes no other draw.
fn happens(share: f64, draws: &mut ChaCha8Rng) -> bool {
    share > 0.0 && draws.random_range(0.0..1.0) < share
}
