//! Trajectories to start the optimizer from.

use std::f64::consts::PI;

use righting_ocp::Guess;

use crate::formulation::Coordinates;
use crate::halton::Halton;
use crate::scenario::Scenario;

/// How far a swing takes a joint without limits, rad.
const FREE_SWING_RAD: f64 = 2.0;
/// Share of the way to a joint's limit that a swing may take.
const LIMIT_SHARE: f64 = 0.8;

/// Starts in which every joint swings smoothly, rest to rest, to somewhere within its limits, and
/// some of the way back. The base's attitude is held. Swing `index` is the same every time.
pub(crate) struct Swings<'a> {
    pub(crate) scenario: &'a Scenario,
    pub(crate) coordinates: &'a Coordinates,
    /// x_0.
    pub(crate) initial: &'a [f64],
    pub(crate) steps: usize,
}

impl Swings<'_> {
    /// The state held at the start, no control: the paper's guess.
    pub(crate) fn constant(&self) -> Guess {
        Guess::constant(self.initial, self.scenario.system().joint_count(), self.steps)
    }

    /// Swings `first`, `first + 1`, … without end.
    pub(crate) fn from(&self, first: u64) -> impl Iterator<Item = Guess> {
        let joints = self.scenario.system().joint_count();
        // Two points a swing: how far each joint goes, and how much of it stays.
        let mut points = Halton::starting_after(joints, 2 * first);
        std::iter::from_fn(move || Some(self.swing(&points.next()?, &points.next()?)))
    }

    fn swing(&self, reach: &[f64], back: &[f64]) -> Guess {
        let mut guess = self.constant();
        let duration_s = self.scenario.horizon().duration_s;
        let limits = &self.scenario.system().joint_limits;
        for (joint, limits) in limits.iter().enumerate() {
            let (angle, rate) =
                (self.coordinates.joint_angle(joint), self.coordinates.joint_rate(joint));
            let start = self.initial[angle];
            let signed = 2.0 * reach[joint] - 1.0;
            let room = match signed > 0.0 {
                true => limits.angle_max_rad - start,
                false => start - limits.angle_min_rad,
            };
            let amplitude = signed * room.clamp(0.0, FREE_SWING_RAD) * LIMIT_SHARE;
            let motion = Motion { amplitude, back: back[joint], duration_s };
            for node in 1..=self.steps {
                let row = guess.states.row_mut(node);
                let phase = node as f64 / self.steps as f64;
                row[angle] += motion.angle(phase);
                row[rate] = motion.rate(phase);
            }
            for step in 0..self.steps {
                let phase = (step as f64 + 0.5) / self.steps as f64;
                guess.controls.row_mut(step)[joint] = motion.acceleration(phase);
            }
        }
        guess
    }
}

/// `amplitude · ((1 − b) (1 − cos πs)/2 + b sin² πs)` at the share s of the duration.
struct Motion {
    amplitude: f64,
    /// b: 0 stays there, 1 comes back.
    back: f64,
    duration_s: f64,
}

impl Motion {
    fn angle(&self, s: f64) -> f64 {
        let (stay, back) = (0.5 * (1.0 - (PI * s).cos()), (PI * s).sin().powi(2));
        self.amplitude * ((1.0 - self.back) * stay + self.back * back)
    }

    fn rate(&self, s: f64) -> f64 {
        let (stay, back) = (0.5 * (PI * s).sin(), (2.0 * PI * s).sin());
        self.amplitude * PI * ((1.0 - self.back) * stay + self.back * back) / self.duration_s
    }

    fn acceleration(&self, s: f64) -> f64 {
        let (stay, back) = (0.5 * (PI * s).cos(), 2.0 * (2.0 * PI * s).cos());
        self.amplitude * PI * PI * ((1.0 - self.back) * stay + self.back * back)
            / self.duration_s.powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_and_accelerations_are_the_derivatives_of_the_angle() {
        let motion = Motion { amplitude: 0.7, back: 0.3, duration_s: 5.0 };
        let step = 1e-5;
        for s in [0.0, 0.1, 0.5, 0.83, 1.0] {
            let difference =
                |f: &dyn Fn(f64) -> f64| (f(s + step) - f(s - step)) / (2.0 * step * 5.0);
            assert!((motion.rate(s) - difference(&|s| motion.angle(s))).abs() < 1e-8);
            assert!((motion.acceleration(s) - difference(&|s| motion.rate(s))).abs() < 1e-8);
        }
        assert!(motion.rate(0.0).abs() < 1e-15 && motion.rate(1.0).abs() < 1e-15);
    }
}
