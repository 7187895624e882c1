//! Uniform samples of an arm's motion, as the paper takes them.

use nalgebra::Vector3;

use super::arm::{Arm, range};

/// Vigna's SplitMix64: the same seed gives the same samples for ever, which no generator of a crate
/// promises across versions.
struct SplitMix64(u64);

impl SplitMix64 {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        let fraction = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        low + fraction * (high - low)
    }
}

/// Momenta and torques of `count` motions: angles uniform in their limits (±π where there are none),
/// rates and accelerations in theirs.
pub(super) fn draw(arm: Arm<'_>, count: usize, seed: u64) -> [Vec<Vector3<f64>>; 2] {
    let mut random = SplitMix64(seed);
    let motion = |_| {
        let mut several = |bounds: &dyn Fn(usize) -> [f64; 2]| -> Vec<f64> {
            let draw = |i| {
                let [low, high] = bounds(i);
                random.between(low, high)
            };
            (0..arm.joints()).map(draw).collect()
        };
        let angles = several(&|i| range(&arm.limits[i]));
        let rates = several(&|i| [-1.0, 1.0].map(|s| s * arm.limits[i].rate_max_rad_s));
        let accelerations =
            several(&|i| [-1.0, 1.0].map(|s| s * arm.limits[i].acceleration_max_rad_s2));
        (arm.momentum(&angles, &rates), arm.torque(&angles, &rates, &accelerations))
    };
    let (momenta, torques) = (0..count).map(motion).unzip();
    [momenta, torques]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_generator_is_the_published_one() {
        // The reference implementation's first outputs for seed 1234567.
        let mut random = SplitMix64(1_234_567);
        let first = [random.next(), random.next(), random.next()];
        assert_eq!(
            first,
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]
        );
        assert!((0..1000).all(|_| (-2.0..3.0).contains(&random.between(-2.0, 3.0))));
    }
}
