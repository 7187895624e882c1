//! Evenly spread points of the unit cube, the same every time.

/// The first primes, one base a dimension.
const PRIMES: [u64; 32] = [
    2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89, 97,
    101, 103, 107, 109, 113, 127, 131,
];

/// The Halton sequence (Halton, *Numerische Mathematik* 2, 1960).
#[derive(Clone, Debug)]
pub struct Halton {
    dimensions: usize,
    index: u64,
}

impl Halton {
    /// Points in as many dimensions as an arm may have joints.
    pub fn new(dimensions: usize) -> Self {
        Self::starting_after(dimensions, 0)
    }

    /// The points after the first `skipped`.
    pub fn starting_after(dimensions: usize, skipped: u64) -> Self {
        Self { dimensions: dimensions.min(PRIMES.len()), index: skipped }
    }
}

impl Iterator for Halton {
    type Item = Vec<f64>;

    fn next(&mut self) -> Option<Vec<f64>> {
        self.index += 1;
        Some(PRIMES[..self.dimensions].iter().map(|&base| inverse(self.index, base)).collect())
    }
}

/// The digits of `index` in `base`, mirrored at the point.
fn inverse(mut index: u64, base: u64) -> f64 {
    let mut value = 0.0;
    let mut place = 1.0 / base as f64;
    while index > 0 {
        value += (index % base) as f64 * place;
        place /= base as f64;
        index /= base;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_fill_the_cube_evenly() {
        let first: Vec<Vec<f64>> = Halton::new(2).take(3).collect();
        assert_eq!(first[0], [0.5, 1.0 / 3.0]);
        assert_eq!(first[1], [0.25, 2.0 / 3.0]);
        assert_eq!(first[2][0], 0.75);
        let count = 4000;
        let mut sums = [0.0; 7];
        for point in Halton::new(7).take(count) {
            assert!(point.iter().all(|x| (0.0..1.0).contains(x)));
            sums.iter_mut().zip(point).for_each(|(sum, x)| *sum += x);
        }
        assert!(sums.iter().all(|sum| (sum / count as f64 - 0.5).abs() < 0.01));
    }
}
