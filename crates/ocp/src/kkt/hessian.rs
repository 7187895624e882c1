//! The matrix of one node with all later nodes eliminated: `W + Jᵀ diag(P, Σ) J`, where the next
//! cost to go weighs the defect rows and the slacks weigh the inequality rows.

use pulp::Simd;

use super::assembly::Assembly;
use super::elimination::Breakdown;
use super::lanes::{
    AlignedVec, add_lanes, add_products, reset, tile_rows, vectors, vectors_mut, zeros,
};
use super::node::NodeFactor;
use super::pattern::NodePattern;

/// Hessian P of a cost to go: a full matrix with padded rows, with a vector of zeros before and
/// after, so that vectors may be read across its ends.
#[derive(Debug, Clone)]
pub(super) struct CostToGo {
    pub padded: AlignedVec,
}

impl Default for CostToGo {
    fn default() -> Self {
        Self { padded: zeros(0) }
    }
}

impl CostToGo {
    /// The rows.
    pub fn rows(&self, lanes: usize) -> &[f64] {
        let end = self.padded.len().saturating_sub(lanes);
        self.padded.get(lanes..end).unwrap_or_default()
    }

    /// The rows.
    pub fn rows_mut(&mut self, lanes: usize) -> &mut [f64] {
        let end = self.padded.len().saturating_sub(lanes);
        self.padded.get_mut(lanes..end).unwrap_or_default()
    }

    /// Padded to a square of `width`.
    fn resize(&mut self, width: usize, lanes: usize) {
        let length = width * width + 2 * lanes;
        if self.padded.len() != length {
            reset(&mut self.padded, length);
        }
    }
}

/// `diag(P, Σ) J`.
#[derive(Debug, Clone)]
pub(super) struct Image {
    rows: AlignedVec,
    /// Pattern of the last node: where its values stand all else is zero already.
    pattern: Option<usize>,
}

impl Default for Image {
    fn default() -> Self {
        Self { rows: zeros(0), pattern: None }
    }
}

impl Image {
    /// Forms the image.
    #[inline(always)]
    pub fn form<S: Simd>(
        &mut self,
        simd: S,
        pattern: &NodePattern,
        pattern_index: usize,
        node: &NodeFactor,
        value: &CostToGo,
    ) {
        if self.pattern != Some(pattern_index) {
            let rows = pattern.jacobian.image_rows(S::F64_LANES);
            reset(&mut self.rows, rows * pattern.stride);
            self.pattern = Some(pattern_index);
        }
        let weights = node.inequalities.iter().map(|pivot| pivot.weight);
        let jacobian = &pattern.jacobian;
        jacobian.image(simd, &node.jacobian, &value.padded, weights, &mut self.rows);
    }

    /// Leading rows, upper triangle.
    #[inline(always)]
    pub fn leading_rows<S: Simd>(
        &self,
        simd: S,
        pattern: &NodePattern,
        node: &NodeFactor,
        assembly: &Assembly,
        matrix: &mut AlignedVec,
    ) {
        let (lanes, tile) = (S::F64_LANES, tile_rows::<S>());
        let stride = pattern.stride / lanes;
        let leading = pattern.shape.leading();
        matrix.resize(leading.next_multiple_of(tile) * pattern.stride, 0.0);
        let own = assembly.leading_rows(pattern);
        matrix[..own.len()].copy_from_slice(own);
        matrix[own.len()..].fill(0.0);
        for first in (0..pattern.shape.free).step_by(tile) {
            let start = first / lanes;
            let out = &mut vectors_mut::<S>(matrix)[first * stride + start..];
            pattern.jacobian.add_pulled(
                simd,
                &node.jacobian,
                &self.rows,
                first,
                (start, stride - start),
                (out, stride),
            );
        }
    }

    /// Hessian of the cost to go in the node's states, after the elimination `Rᵀ D R` of the
    /// leading unknowns; `scaled` is `D R`.
    #[inline(always)]
    pub fn cost_to_go<S: Simd>(
        &self,
        simd: S,
        pattern: &NodePattern,
        node: &NodeFactor,
        assembly: &Assembly,
        scaled: &[f64],
        value: &mut CostToGo,
    ) -> Result<(), Breakdown> {
        let leading = &node.leading;
        let (lanes, tile, states) = (S::F64_LANES, tile_rows::<S>(), pattern.shape.states);
        let width = pattern.state_stride / lanes;
        let unit = vectors::<S>(&leading.rows);
        value.resize(pattern.state_stride, lanes);
        let rows = value.rows_mut(lanes);
        let own = assembly.state_rows(pattern);
        rows[..own.len()].copy_from_slice(own);
        rows[own.len()..].fill(0.0);
        let mut sum = simd.splat_f64s(0.0);
        for first in (0..states).step_by(tile) {
            let length = first / lanes + 1;
            let out = &mut vectors_mut::<S>(rows)[first * width..];
            pattern.jacobian.add_pulled(
                simd,
                &node.jacobian,
                &self.rows,
                pattern.split + first,
                (pattern.split / lanes, length),
                (out, width),
            );
            let (split, stride) = (leading.split, leading.stride);
            let terms = (0..leading.eliminated)
                .map(|k| (k * stride + split + first, (k * stride + split) / lanes));
            add_products::<S, true>(simd, out, (length, width), scaled, unit, terms);
            for row in out.chunks_exact(width).take(tile) {
                sum = add_lanes(simd, sum, &row[..length]);
            }
        }
        mirror(rows, states, pattern.state_stride);
        if simd.reduce_sum_f64s(sum).is_finite() { Ok(()) } else { Err(Breakdown::Failed) }
    }
}

/// Magnitude of the terms that each leading diagonal is summed from (a bound when P is
/// semidefinite: |P_rs| ≤ max(P_rr, P_ss)).
#[inline(always)]
pub(super) fn leading_scales<S: Simd>(
    _: S,
    pattern: &NodePattern,
    node: &NodeFactor,
    value: &CostToGo,
    assembly: &Assembly,
    scales: &mut Vec<f64>,
) {
    let shape = pattern.shape;
    let width = shape.defects.next_multiple_of(S::F64_LANES);
    let value = value.rows(S::F64_LANES);
    scales.clear();
    for i in 0..shape.leading() {
        let mut scale = assembly.leading_rows(pattern)[i * pattern.stride + i].abs();
        if i < shape.free {
            let entries = pattern.jacobian.column(i);
            let count = entries.len() as f64;
            for entry in entries {
                let row = entry.row as usize;
                let weight = match row.checked_sub(shape.defects) {
                    None => count * value[row * width + row].abs(),
                    Some(row) => node.inequalities[row].weight.abs(),
                };
                let coefficient = node.jacobian[entry.slot as usize];
                scale += weight * coefficient * coefficient;
            }
        }
        scales.push(scale);
    }
}

/// Copies the lower triangle to the upper one.
#[inline(always)]
fn mirror(matrix: &mut [f64], size: usize, stride: usize) {
    for i in 1..size {
        let (above, row) = matrix.split_at_mut(i * stride);
        for (above, &value) in above.chunks_exact_mut(stride).zip(&row[..i]) {
            above[i] = value;
        }
    }
}
