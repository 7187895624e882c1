//! Random numbers that depend on nothing but what they are asked for.
//!
//! Draw i of a field is computed from SHA-256 of (seed, field, i): any case can be expanded by
//! itself, on any machine, and two fields under one seed do not draw the same numbers.

use std::f64::consts::TAU;

use sha2::{Digest, Sha256};

/// The draws of one field.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stream {
    seed: u64,
    field: String,
}

impl Stream {
    pub fn new(seed: u64, field: &str) -> Self {
        Self { seed, field: field.to_owned() }
    }

    /// Two independent numbers of [0, 1).
    fn pair(&self, index: usize) -> [f64; 2] {
        let mut hash = Sha256::new();
        hash.update(self.seed.to_le_bytes());
        hash.update((index as u64).to_le_bytes());
        hash.update(self.field.as_bytes());
        let digest = hash.finalize();
        let number = |at: usize| {
            let bytes: [u8; 8] = digest[at..at + 8].try_into().expect("eight bytes of 32");
            // The 53 bits that a double holds.
            (u64::from_le_bytes(bytes) >> 11) as f64 / (1u64 << 53) as f64
        };
        [number(0), number(8)]
    }

    pub fn uniform(&self, index: usize, low: f64, high: f64) -> f64 {
        low + (high - low) * self.pair(index)[0]
    }

    /// By Box and Muller's transform.
    pub fn normal(&self, index: usize, mean: f64, deviation: f64) -> f64 {
        let [a, b] = self.pair(index);
        mean + deviation * (-2.0 * (1.0 - a).ln()).sqrt() * (TAU * b).cos()
    }

    /// A unit vector: uniform in z and longitude, as Archimedes has it.
    pub fn direction(&self, index: usize) -> [f64; 3] {
        let [a, b] = self.pair(index);
        let z = 2.0 * a - 1.0;
        let radius = (1.0 - z * z).sqrt();
        let (sin, cos) = (TAU * b).sin_cos();
        [radius * cos, radius * sin, z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_have_the_moments_they_should_and_fields_differ() {
        let [a, b] = ["a", "b"].map(|field| Stream::new(7, field));
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
}
