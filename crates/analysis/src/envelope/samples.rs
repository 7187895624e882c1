//! Uniform samples of an arm's motion, as the paper takes them.

use nalgebra::Vector3;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::arm::{Arm, range};

/// Momenta and torques of `count` motions: angles uniform in their limits (±π where there are none),
/// rates and accelerations in theirs. The same seed gives the same samples everywhere.
pub(super) fn draw(arm: Arm<'_>, count: usize, seed: u64) -> [Vec<Vector3<f64>>; 2] {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let motion = |_| {
        let mut several = |bounds: &dyn Fn(usize) -> [f64; 2]| -> Vec<f64> {
            let draw = |i| {
                let [low, high] = bounds(i);
                low + random.random::<f64>() * (high - low)
            };
            (0..arm.joints()).map(draw).collect()
        };
        let angles = several(&|i| range(&arm.limits[i]));
        let rates = several(&|i| [-1.0, 1.0].map(|s| s * arm.rate_max_rad_s(i)));
        let accelerations = several(&|i| [-1.0, 1.0].map(|s| s * arm.acceleration_max_rad_s2(i)));
        (arm.momentum(&angles, &rates), arm.torque(&angles, &rates, &accelerations))
    };
    let (momenta, torques) = (0..count).map(motion).unzip();
    [momenta, torques]
}
