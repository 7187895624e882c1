//! How the joints of a plant follow what they are told.

use rand::rngs::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Parts of a step in which an acceleration that lags is held.
const PARTS: usize = 4;

/// How joints follow the accelerations that they are told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointDrives {
    /// Time in which an acceleration comes within 1/e of what is told, s; none if zero.
    pub lag_s: f64,
    /// Standard deviation of every acceleration in every step, as a share of what is told.
    pub noise: f64,
}

/// The joints of one plant.
pub(crate) struct DrivenJoints {
    drives: JointDrives,
    stuck: Option<Stuck>,
    accelerations: Vec<f64>,
    draws: ChaCha8Rng,
}

/// A joint that stops and does not move any more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stuck {
    /// Which joint, counted from zero.
    pub joint: usize,
    /// From when on, s.
    pub time_s: f64,
}

/// What the joints do for a time.
pub(crate) struct Push {
    pub accelerations: Vec<f64>,
    pub duration_s: f64,
}

impl DrivenJoints {
    pub(crate) fn new(
        drives: JointDrives,
        stuck: Option<Stuck>,
        joints: usize,
        draws: ChaCha8Rng,
    ) -> Self {
        Self { drives, stuck, accelerations: vec![0.0; joints], draws }
    }

    /// What the joints do in a step that begins at `time_s`, where they move at `rates`, when they are told `commands`.
    pub(crate) fn follow(
        &mut self,
        commands: &[f64],
        rates: &[f64],
        [time_s, step_s]: [f64; 2],
    ) -> Vec<Push> {
        let JointDrives { lag_s, noise } = self.drives;
        let draws = &mut self.draws;
        let mut told: Vec<f64> = commands.to_vec();
        if noise > 0.0 {
            told.iter_mut().for_each(|command| {
                let standard: f64 = StandardNormal.sample(draws);
                *command *= 1.0 + noise * standard;
            });
        }
        let parts = if lag_s > 0.0 { PARTS } else { 1 };
        let duration_s = step_s / parts as f64;
        (0..parts)
            .map(|_| {
                let mut accelerations = match lag_s > 0.0 {
                    true => self.lagging(&told, duration_s),
                    false => told.clone(),
                };
                if let Some(Stuck { joint, time_s: from_s }) = self.stuck
                    && time_s >= from_s
                {
                    // The first such step stops it; from then on its rate is rounding.
                    accelerations[joint] = -rates[joint] / step_s;
                }
                Push { accelerations, duration_s }
            })
            .collect()
    }

    /// The mean over a time of accelerations that come nearer to what is told.
    fn lagging(&mut self, told: &[f64], duration_s: f64) -> Vec<f64> {
        let lag_s = self.drives.lag_s;
        let left = (-duration_s / lag_s).exp();
        let mean = (1.0 - left) * lag_s / duration_s;
        let follow = |now: &mut f64, told: &f64| {
            let off = *now - told;
            *now = told + off * left;
            told + off * mean
        };
        self.accelerations.iter_mut().zip(told).map(|(now, told)| follow(now, told)).collect()
    }
}
