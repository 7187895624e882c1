//! Random numbers that depend on nothing but what they are asked for.
//!
//! Draw i of a field comes from stream i of the ChaCha8 generator whose key is SHA-256 of (seed, field):
//! any case can be expanded by itself, on any machine, and two fields under one seed do not draw the
//! same numbers.

use rand::distr::Distribution;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rand_distr::{StandardNormal, UnitSphere};
use sha2::{Digest, Sha256};

/// The draws of one field.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Draws {
    key: [u8; 32],
}

impl Draws {
    /// The key is SHA-256 of the seed, as eight bytes with the lowest first, and the field's path.
    pub fn new(seed: u64, field: &str) -> Self {
        let key = Sha256::new().chain_update(seed.to_le_bytes()).chain_update(field).finalize();
        Self { key: key.into() }
    }

    fn stream(&self, index: usize) -> ChaCha8Rng {
        let mut stream = ChaCha8Rng::from_seed(self.key);
        stream.set_stream(index as u64);
        stream
    }

    pub fn uniform(&self, index: usize, low: f64, high: f64) -> f64 {
        self.stream(index).random_range(low..high)
    }

    pub fn normal(&self, index: usize, mean: f64, deviation: f64) -> f64 {
        let standard: f64 = StandardNormal.sample(&mut self.stream(index));
        mean + deviation * standard
    }

    /// A unit vector, all directions alike.
    pub fn direction(&self, index: usize) -> [f64; 3] {
        UnitSphere.sample(&mut self.stream(index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_have_the_moments_they_should_and_fields_differ() {
        let [a, b] = ["a", "b"].map(|field| Draws::new(7, field));
        let count = 20_000;
        let mean = |f: &dyn Fn(usize) -> f64| (0..count).map(f).sum::<f64>() / count as f64;
        assert!((mean(&|i| a.uniform(i, 0.9, 1.1)) - 1.0).abs() < 2e-3);
        assert!((mean(&|i| a.normal(i, 2.0, 3.0)) - 2.0).abs() < 0.1);
        assert!((mean(&|i| (a.normal(i, 2.0, 3.0) - 2.0).powi(2)) - 9.0).abs() < 0.3);
        for axis in 0..3 {
            assert!((mean(&|i| a.direction(i)[axis].powi(2)) - 1.0 / 3.0).abs() < 0.01);
        }
        let covariance = mean(&|i| a.uniform(i, -1.0, 1.0) * b.uniform(i, -1.0, 1.0));
        assert!(covariance.abs() < 0.01, "{covariance}");
        assert!((0..count).all(|i| (0.9..1.1).contains(&a.uniform(i, 0.9, 1.1))));
    }

    /// A draw that changes makes another case of a sweep: none may, with whatever version of a crate.
    #[test]
    fn draws_stay_what_they_are() {
        let draws = Draws::new(1, "system.base.mass_kg");
        assert_eq!(
            [0, 1, 999].map(|i| draws.uniform(i, 0.9, 1.1)),
            [0.9056068782613509, 1.028107377030731, 1.0253385762041312]
        );
        assert_eq!(
            [0, 1, 999].map(|i| draws.normal(i, 2.0, 3.0)),
            [-1.8349432914660504, 4.1177877965060015, 3.2402752558521737]
        );
        assert_eq!(
            [0, 1].map(|i| draws.direction(i)),
            [
                [-0.4433275412826045, -0.6764007914669407, 0.5881689046891352],
                [0.2721332703368035, -0.8022849546395672, -0.5313024889220677]
            ]
        );
    }
}
