//! SIMD lanes: which are used, and the row operations that everything here is made of.
//!
//! All rows are padded with zeros to whole vectors of the lanes chosen, so no loop has a tail.
//!
//! Vector operations stand in `#[inline(always)]` functions and never in closures: a closure that is
//! not inlined is compiled without the instruction set of its caller.

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

/// Padded rows as vectors.
#[inline(always)]
pub(super) fn vectors<S: Simd>(rows: &[f64]) -> &[S::f64s] {
    S::as_simd_f64s(rows).0
}

/// Padded rows as vectors.
#[inline(always)]
pub(super) fn vectors_mut<S: Simd>(rows: &mut [f64]) -> &mut [S::f64s] {
    S::as_mut_simd_f64s(rows).0
}

/// Adds to `out`, for each term `(coefficient, start)`, the coefficient times the row of `matrix`
/// that starts at that vector and is as long as `out`.
#[inline(always)]
pub(super) fn add_rows<S: Simd>(
    simd: S,
    out: &mut [S::f64s],
    matrix: &[S::f64s],
    terms: impl Iterator<Item = (f64, usize)> + Clone,
) {
    let mut start = 0;
    while out.len() - start >= 4 {
        let terms = terms.clone().map(|(coefficient, row)| (coefficient, row + start));
        add_block::<S, 4>(simd, &mut out[start..start + 4], matrix, terms);
        start += 4;
    }
    let terms = terms.map(|(coefficient, row)| (coefficient, row + start));
    let out = &mut out[start..];
    match out.len() {
        3 => add_block::<S, 3>(simd, out, matrix, terms),
        2 => add_block::<S, 2>(simd, out, matrix, terms),
        1 => add_block::<S, 1>(simd, out, matrix, terms),
        _ => {}
    }
}

/// [`add_rows`] for `V` vectors, which stay in registers over all terms.
#[inline(always)]
fn add_block<S: Simd, const V: usize>(
    simd: S,
    out: &mut [S::f64s],
    matrix: &[S::f64s],
    terms: impl Iterator<Item = (f64, usize)>,
) {
    let mut sums = [simd.splat_f64s(0.0); V];
    sums.copy_from_slice(out);
    for (coefficient, start) in terms {
        let coefficient = simd.splat_f64s(coefficient);
        let Some(row) = matrix[start..].first_chunk::<V>() else { return };
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
    out: &mut [S::f64s],
    factor: f64,
    row: &[S::f64s],
    largest: S::f64s,
) -> S::f64s {
    let factor = simd.splat_f64s(factor);
    let mut largest = largest;
    for (out, &value) in out.iter_mut().zip(row) {
        *out = simd.mul_f64s(factor, value);
        largest = simd.max_f64s(largest, simd.abs_f64s(*out));
    }
    largest
}

/// Inner product of two padded rows.
#[inline(always)]
pub(super) fn dot<S: Simd>(simd: S, a: &[S::f64s], b: &[S::f64s]) -> f64 {
    let mut sum = simd.splat_f64s(0.0);
    for (&a, &b) in a.iter().zip(b) {
        sum = simd.mul_add_e_f64s(a, b, sum);
    }
    simd.reduce_sum_f64s(sum)
}

/// Adds a row's vectors to `sum`.
#[inline(always)]
pub(super) fn add_lanes<S: Simd>(simd: S, sum: S::f64s, row: &[S::f64s]) -> S::f64s {
    let mut sum = sum;
    for &value in row {
        sum = simd.add_f64s(sum, value);
    }
    sum
}

/// Rows that [`add_products`] takes at a time: a divisor of the lanes, so that they share a block.
#[inline(always)]
pub(super) fn tile_rows<S: Simd>() -> usize {
    S::F64_LANES.min(4)
}

/// A tile of a matrix product: adds to each of the [`tile_rows`] rows of `out`, for each term
/// `(a, b)`, the coefficient `left[a + r]` times the row of `right` that starts at vector `b`; with
/// `SUBTRACT` it subtracts. A row of `out` has `length` vectors, the next is `stride` vectors on.
#[inline(always)]
pub(super) fn add_products<S: Simd, const SUBTRACT: bool>(
    simd: S,
    out: &mut [S::f64s],
    (length, stride): (usize, usize),
    left: &[f64],
    right: &[S::f64s],
    terms: impl Iterator<Item = (usize, usize)> + Clone,
) {
    match tile_rows::<S>() {
        4 => add_tile::<S, SUBTRACT, 4>(simd, out, (length, stride), left, right, terms),
        2 => add_tile::<S, SUBTRACT, 2>(simd, out, (length, stride), left, right, terms),
        _ => add_tile::<S, SUBTRACT, 1>(simd, out, (length, stride), left, right, terms),
    }
}

#[inline(always)]
fn add_tile<S: Simd, const SUBTRACT: bool, const R: usize>(
    simd: S,
    out: &mut [S::f64s],
    (length, stride): (usize, usize),
    left: &[f64],
    right: &[S::f64s],
    terms: impl Iterator<Item = (usize, usize)> + Clone,
) {
    let mut start = 0;
    // Sixteen sums fit into the registers of eight lanes, eight into those of fewer.
    while S::F64_LANES >= 8 && length - start >= 4 {
        let terms = terms.clone().map(|(a, b)| (a, b + start));
        add_registers::<S, SUBTRACT, R, 4>(simd, &mut out[start..], stride, left, right, terms);
        start += 4;
    }
    while length - start >= 2 {
        let terms = terms.clone().map(|(a, b)| (a, b + start));
        add_registers::<S, SUBTRACT, R, 2>(simd, &mut out[start..], stride, left, right, terms);
        start += 2;
    }
    if length > start {
        let terms = terms.map(|(a, b)| (a, b + start));
        add_registers::<S, SUBTRACT, R, 1>(simd, &mut out[start..], stride, left, right, terms);
    }
}

#[inline(always)]
fn add_registers<S: Simd, const SUBTRACT: bool, const R: usize, const V: usize>(
    simd: S,
    out: &mut [S::f64s],
    stride: usize,
    left: &[f64],
    right: &[S::f64s],
    terms: impl Iterator<Item = (usize, usize)>,
) {
    let mut sums = [[simd.splat_f64s(0.0); V]; R];
    for (r, sums) in sums.iter_mut().enumerate() {
        sums.copy_from_slice(&out[r * stride..r * stride + V]);
    }
    for (a, b) in terms {
        // Arrays, for the loops to have known lengths and the sums to stay in registers.
        let Some(coefficients) = left[a..].first_chunk::<R>() else { return };
        let Some(row) = right[b..].first_chunk::<V>() else { return };
        for (sums, &coefficient) in sums.iter_mut().zip(coefficients) {
            let coefficient = simd.splat_f64s(coefficient);
            for (sum, &value) in sums.iter_mut().zip(row) {
                *sum = if SUBTRACT {
                    simd.negate_mul_add_e_f64s(coefficient, value, *sum)
                } else {
                    simd.mul_add_e_f64s(coefficient, value, *sum)
                };
            }
        }
    }
    for (r, sums) in sums.iter().enumerate() {
        out[r * stride..r * stride + V].copy_from_slice(sums);
    }
}

/// Copies a short row in pieces of known length; a call of the system's copy would take longer.
#[inline(always)]
pub(super) fn copy_short(from: &[f64], to: &mut [f64]) {
    let length = to.len();
    let from = &from[..length];
    let mut start = 0;
    while length - start >= 8 {
        to[start..start + 8].copy_from_slice(&from[start..start + 8]);
        start += 8;
    }
    if length - start >= 4 {
        to[start..start + 4].copy_from_slice(&from[start..start + 4]);
        start += 4;
    }
    if length - start >= 2 {
        to[start..start + 2].copy_from_slice(&from[start..start + 2]);
        start += 2;
    }
    if length > start {
        to[start] = from[start];
    }
}
