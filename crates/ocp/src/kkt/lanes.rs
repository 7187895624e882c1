//! SIMD lanes: which are used, and the row operations that everything here is made of.
//!
//! All rows are padded with zeros to whole vectors of the lanes chosen, so no loop has a tail.

use aligned_vec::{AVec, ConstAlign};
use pulp::{Arch, Scalar, Simd, WithSimd};

/// Storage aligned to a cache line, the widest vector there is.
pub(super) type AlignedVec = AVec<f64, ConstAlign<64>>;

/// `length` zeros.
pub(super) fn zeros(length: usize) -> AlignedVec {
    AVec::from_iter(64, std::iter::repeat_n(0.0, length))
}

/// Makes `buffer` hold `length` zeros, keeping its storage.
pub(super) fn reset(buffer: &mut AlignedVec, length: usize) {
    buffer.clear();
    buffer.resize(length, 0.0);
}

/// Instruction set of the row operations.
#[derive(Debug, Clone, Copy)]
pub(super) enum Lanes {
    /// The widest that this processor has.
    Native(Arch),
    /// One number at a time; the reference for tests.
    Scalar,
}

impl Lanes {
    pub fn native() -> Self {
        Self::Native(Arch::new())
    }

    pub fn run<Op: WithSimd>(self, op: Op) -> Op::Output {
        match self {
            Self::Native(arch) => arch.dispatch(op),
            Self::Scalar => op.with_simd(Scalar),
        }
    }

    /// Numbers in a vector.
    pub fn width(self) -> usize {
        struct Width;
        impl WithSimd for Width {
            type Output = usize;
            #[inline(always)]
            fn with_simd<S: Simd>(self, _: S) -> usize {
                S::F64_LANES
            }
        }
        self.run(Width)
    }
}

/// Adds `coefficient · row` to `out` for each term. All rows have the length of `out`.
#[inline(always)]
pub(super) fn add_rows<'a, S: Simd>(
    simd: S,
    out: &mut [f64],
    terms: impl Iterator<Item = (f64, &'a [f64])> + Clone,
) {
    let out = S::as_mut_simd_f64s(out).0;
    let mut start = 0;
    while out.len() - start >= 4 {
        add_block::<S, 4>(simd, out, start, terms.clone());
        start += 4;
    }
    match out.len() - start {
        3 => add_block::<S, 3>(simd, out, start, terms),
        2 => add_block::<S, 2>(simd, out, start, terms),
        1 => add_block::<S, 1>(simd, out, start, terms),
        _ => {}
    }
}

/// [`add_rows`] for `V` vectors from `start` on, which stay in registers over all terms.
#[inline(always)]
fn add_block<'a, S: Simd, const V: usize>(
    simd: S,
    out: &mut [S::f64s],
    start: usize,
    terms: impl Iterator<Item = (f64, &'a [f64])>,
) {
    let out = &mut out[start..start + V];
    let mut sums = [simd.splat_f64s(0.0); V];
    sums.copy_from_slice(out);
    for (coefficient, row) in terms {
        let coefficient = simd.splat_f64s(coefficient);
        let row = &S::as_simd_f64s(row).0[start..start + V];
        for (sum, &value) in sums.iter_mut().zip(row) {
            *sum = simd.mul_add_e_f64s(coefficient, value, *sum);
        }
    }
    out.copy_from_slice(&sums);
}

/// Writes `factor · row` to `out` and returns the lanes' largest magnitudes, `largest` included.
#[inline(always)]
pub(super) fn scale_row<S: Simd>(
    simd: S,
    out: &mut [f64],
    factor: f64,
    row: &[f64],
    largest: S::f64s,
) -> S::f64s {
    let factor = simd.splat_f64s(factor);
    let mut largest = largest;
    for (out, &value) in S::as_mut_simd_f64s(out).0.iter_mut().zip(S::as_simd_f64s(row).0) {
        *out = simd.mul_f64s(factor, value);
        largest = simd.max_f64s(largest, simd.abs_f64s(*out));
    }
    largest
}

/// Inner product of two padded rows.
#[inline(always)]
pub(super) fn dot<S: Simd>(simd: S, a: &[f64], b: &[f64]) -> f64 {
    let mut sum = simd.splat_f64s(0.0);
    for (&a, &b) in S::as_simd_f64s(a).0.iter().zip(S::as_simd_f64s(b).0) {
        sum = simd.mul_add_e_f64s(a, b, sum);
    }
    simd.reduce_sum_f64s(sum)
}

/// Adds a row's vectors to `sum`.
#[inline(always)]
pub(super) fn add_lanes<S: Simd>(simd: S, sum: S::f64s, row: &[f64]) -> S::f64s {
    S::as_simd_f64s(row).0.iter().fold(sum, |sum, &value| simd.add_f64s(sum, value))
}
