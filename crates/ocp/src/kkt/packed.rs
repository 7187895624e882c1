//! Symmetric matrices as they are kept: the lower triangle by rows, each as long as the vectors that
//! it reaches into, so that blocks on the diagonal are whole. Half the memory of a full matrix, and
//! memory is what a solution waits for.

use pulp::Simd;

use super::lanes::{add_rows, dot, vectors, vectors_mut};

/// First vector of a row.
#[inline(always)]
fn row_start(row: usize, lanes: usize) -> usize {
    let (block, offset) = (row / lanes, row % lanes);
    lanes * block * (block + 1) / 2 + offset * (block + 1)
}

/// Length of a packed matrix.
pub(super) fn packed_length(size: usize, lanes: usize) -> usize {
    (0..size).map(|row| (row / lanes + 1) * lanes).sum()
}

/// Packs a full matrix with rows of `stride`.
#[inline(always)]
pub(super) fn pack<S: Simd>(full: &[f64], size: usize, stride: usize, packed: &mut [f64]) {
    let mut rest = packed;
    for (i, row) in full.chunks_exact(stride.max(1)).take(size).enumerate() {
        let (own, after) = rest.split_at_mut((i / S::F64_LANES + 1) * S::F64_LANES);
        own.copy_from_slice(&row[..own.len()]);
        rest = after;
    }
}

/// `out ← out − matrix · vector`; both are padded.
#[inline(always)]
pub(super) fn subtract_product<S: Simd>(
    simd: S,
    packed: &[f64],
    size: usize,
    vector: &[f64],
    out: &mut [f64],
) {
    let lanes = S::F64_LANES;
    let matrix = vectors::<S>(packed);
    for (block, first) in (0..size).step_by(lanes).enumerate() {
        let (length, last) = (block + 1, size.min(first + lanes));
        let start = row_start(first, lanes);
        let terms = (first..last).map(|i| (-vector[i], start + (i - first) * length));
        add_rows(simd, &mut vectors_mut::<S>(out)[..length], matrix, terms);
        if block > 0 {
            let before = &vectors::<S>(vector)[..block];
            for i in first..last {
                let row = &matrix[start + (i - first) * length..][..block];
                out[i] -= dot(simd, row, before);
            }
        }
    }
}
