//! Partial LDLᵀ: eliminates the leading unknowns of a symmetric block matrix
//!
//! ```text
//! [ M_ll  M_lt ]        M_ll = Lᵀ D L,   M_lt = Lᵀ D R,
//! [ M_tl  M_tt ]        what remains for the trailing block: M_tt − Rᵀ D R
//! ```
//!
//! with rows `[L R]` unit upper triangular in their leading part. Blocks that allow it take plain
//! pivots in order. Others take 1×1 and 2×2 pivots chosen for small multipliers, those onto
//! the trailing unknowns counted too; unknowns without an acceptable pivot are *delayed*: they
//! stay, coupled to the trailing block, for the caller to eliminate elsewhere (the threshold and
//! delayed pivoting of multifrontal solvers: Duff & Reid 1983, MA57).

use pulp::Simd;

use super::lanes::{AlignedVec, add_rows, reset, scale_row, vectors, vectors_mut};

/// A pivot this small beside the terms it was summed from is rounding noise.
pub(super) const NOISE: f64 = 64.0 * f64::EPSILON;

/// Multipliers up to this are small enough not to look for better ones.
const SMALL_MULTIPLIER: f64 = 100.0;

/// Why a factorisation stops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Breakdown {
    /// The matrix is singular to working precision.
    Singular,
    /// Not finite, or beyond what this elimination order can handle.
    Failed,
}

/// Factor of a leading block: rows `[L R]`, pivots, and for each unknown who it is.
#[derive(Debug, Clone)]
pub(super) struct Elimination {
    /// Leading unknowns.
    pub size: usize,
    /// How many of them were eliminated; the rest are delayed.
    pub eliminated: usize,
    /// First trailing column.
    pub split: usize,
    /// Length of a row.
    pub stride: usize,
    /// `size` rows in elimination order: `[L R]`, and for delayed unknowns what remains of `[M_ll M_lt]`.
    pub rows: AlignedVec,
    /// Diagonal of D⁻¹.
    pub inverse_pivots: Vec<f64>,
    /// D⁻¹ between a row and the next; all zero, and left out, without 2×2 pivots.
    pub inverse_couplings: Vec<f64>,
    /// Who the unknowns are, in elimination order (the caller's numbering).
    pub unknowns: Vec<u32>,
    /// Magnitude of the terms that each delayed unknown's row was summed from.
    pub scales: Vec<f64>,
}

impl Default for Elimination {
    fn default() -> Self {
        Self {
            size: 0,
            eliminated: 0,
            split: 0,
            stride: 0,
            rows: super::lanes::zeros(0),
            inverse_pivots: Vec::new(),
            inverse_couplings: Vec::new(),
            unknowns: Vec::new(),
            scales: Vec::new(),
        }
    }
}

impl Elimination {
    /// Sets the sizes and makes room; the unknowns are to be listed by the caller.
    pub fn shape(&mut self, size: usize, split: usize, stride: usize) {
        self.size = size;
        self.eliminated = 0;
        self.split = split;
        self.stride = stride;
        if self.rows.len() != size * stride {
            reset(&mut self.rows, size * stride);
        }
        self.inverse_pivots.clear();
        self.inverse_couplings.clear();
    }

    /// Unknowns left for elsewhere.
    pub fn delayed(&self) -> usize {
        self.size - self.eliminated
    }

    pub fn row(&self, k: usize) -> &[f64] {
        &self.rows[k * self.stride..(k + 1) * self.stride]
    }

    /// Eliminates the leading block, in order if that is stable; returns its negative eigenvalues.
    /// See [`Self::eliminate_pivoted`].
    #[inline(always)]
    pub fn eliminate<S: Simd>(
        &mut self,
        simd: S,
        matrix: &[f64],
        scales: &[f64],
        scaled: &mut [f64],
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        match self.eliminate_in_order(simd, matrix, scales, scaled, tolerance) {
            Some(negative) => Ok(negative),
            None => self.eliminate_pivoted(matrix, scales, scaled, tolerance),
        }
    }

    /// Eliminates the leading block in order, from the upper triangle of `matrix`. Leaves
    /// `D [L R]` in `scaled` and returns the number of negative pivots; nothing when a pivot may be
    /// noise or a multiplier is too large: then [`Self::eliminate_pivoted`] has to do it.
    #[inline(always)]
    fn eliminate_in_order<S: Simd>(
        &mut self,
        simd: S,
        matrix: &[f64],
        scales: &[f64],
        scaled: &mut [f64],
        tolerance: f64,
    ) -> Option<usize> {
        let (stride, lanes) = (self.stride, S::F64_LANES);
        let mut largest = simd.splat_f64s(0.0);
        let mut negative = 0;
        for k in 0..self.size {
            // Vectors before the diagonal's are zero, or symmetric to what is done.
            let start = k / lanes;
            let (above, row) = scaled.split_at_mut(k * stride);
            let row = &mut row[..stride];
            row[..start * lanes].fill(0.0);
            row[start * lanes..]
                .copy_from_slice(&matrix[k * stride + start * lanes..(k + 1) * stride]);
            let terms = (0..k).map(|j| (-above[j * stride + k], (j * stride) / lanes + start));
            let out = &mut vectors_mut::<S>(row)[start..];
            add_rows(simd, out, vectors::<S>(&self.rows), terms);
            let pivot = row[k];
            let is_clear = pivot.abs() > NOISE * scales[k];
            if !is_clear {
                return None;
            }
            negative += usize::from(pivot < 0.0);
            row[start * lanes..=k].fill(0.0);
            let inverse = 1.0 / pivot;
            let unit = vectors_mut::<S>(&mut self.rows[k * stride..(k + 1) * stride]);
            largest = scale_row(simd, unit, inverse, vectors::<S>(row), largest);
            self.inverse_pivots.push(inverse);
        }
        self.eliminated = self.size;
        // A definite block cannot grow; there the limit is for the trailing block alone.
        let limit = if negative == 0 { 1.0 / tolerance } else { SMALL_MULTIPLIER };
        (simd.reduce_max_f64s(largest) <= limit).then_some(negative)
    }

    /// Eliminates any leading block with threshold pivoting, from the upper triangle of `matrix`.
    /// Leaves `D [L R]` of the eliminated rows in `scaled`; returns the number of negative
    /// eigenvalues of D.
    pub fn eliminate_pivoted(
        &mut self,
        matrix: &[f64],
        scales: &[f64],
        scaled: &mut [f64],
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        let (size, stride) = (self.size, self.stride);
        self.rows.copy_from_slice(&matrix[..size * stride]);
        for i in 0..size {
            for j in 0..i {
                self.rows[i * stride + j] = self.rows[j * stride + i];
            }
        }
        self.scales.clear();
        for (row, &scale) in self.rows.chunks_exact(stride).zip(scales) {
            self.scales.push(row.iter().fold(scale, |largest, value| largest.max(value.abs())));
        }
        self.eliminated = 0;
        self.inverse_pivots.clear();
        self.inverse_couplings.clear();
        let mut negative = 0;
        while self.eliminated < size {
            let first = self.eliminated;
            match self.choose_pivot(tolerance)? {
                None => break,
                Some(Pivot::Single(i)) => {
                    self.swap(first, i, scaled);
                    negative += self.eliminate_single(scaled);
                }
                Some(Pivot::Pair(i, j)) => {
                    self.swap(first, i, scaled);
                    self.swap(first + 1, j, scaled);
                    negative += self.eliminate_pair(scaled);
                }
            }
        }
        Ok(negative)
    }

    /// The first pivot with small multipliers, or that with the smallest if they do not exceed
    /// `1/tolerance`.
    fn choose_pivot(&self, tolerance: f64) -> Result<Option<Pivot>, Breakdown> {
        let first = self.eliminated;
        let mut best = (f64::INFINITY, None);
        for i in first..self.size {
            let row = self.row(i);
            let beside = self.largest_beside(row, [i, i]);
            let pivot = row[i].abs();
            if !(beside.is_finite() && pivot.is_finite()) {
                return Err(Breakdown::Failed);
            }
            if pivot.max(beside) <= NOISE * self.scales[i] {
                return Err(Breakdown::Singular);
            }
            if pivot <= NOISE * self.scales[i] {
                continue;
            }
            if beside <= SMALL_MULTIPLIER * pivot {
                return Ok(Some(Pivot::Single(i)));
            }
            if beside < best.0 * pivot {
                best = (beside / pivot, Some(Pivot::Single(i)));
            }
        }
        for i in first..self.size {
            for j in i + 1..self.size {
                let multiplier = self.pair_multiplier(i, j);
                if multiplier < best.0 {
                    best = (multiplier, Some(Pivot::Pair(i, j)));
                }
            }
        }
        Ok(if best.0 * tolerance <= 1.0 { best.1 } else { None })
    }

    /// Largest magnitude in a row that has not been eliminated, but for two columns.
    fn largest_beside(&self, row: &[f64], except: [usize; 2]) -> f64 {
        let leading = (self.eliminated..self.size).filter(|j| !except.contains(j)).map(|j| row[j]);
        // Written so that a NaN stays one.
        let largest = |a: f64, b: f64| if b.abs() > a || b.is_nan() { b.abs() } else { a };
        row[self.split..].iter().copied().chain(leading).fold(0.0, largest)
    }

    /// Largest multiplier of a 2×2 pivot, infinite when the pivot is singular.
    fn pair_multiplier(&self, i: usize, j: usize) -> f64 {
        let (first, second) = (self.row(i), self.row(j));
        let Some(inverse) = inverse_pair(first[i], first[j], second[j]) else {
            return f64::INFINITY;
        };
        let multiplier = |t: usize| {
            let one = inverse[0] * first[t] + inverse[1] * second[t];
            let two = inverse[1] * first[t] + inverse[2] * second[t];
            one.abs().max(two.abs())
        };
        let leading = (self.eliminated..self.size).filter(|&t| t != i && t != j);
        leading.chain(self.split..self.stride).map(multiplier).fold(0.0, f64::max)
    }

    fn swap(&mut self, i: usize, j: usize, scaled: &mut [f64]) {
        if i == j {
            return;
        }
        let stride = self.stride;
        for t in 0..stride {
            self.rows.swap(i * stride + t, j * stride + t);
        }
        for k in 0..self.size {
            self.rows.swap(k * stride + i, k * stride + j);
        }
        for k in 0..self.eliminated {
            scaled.swap(k * stride + i, k * stride + j);
        }
        self.unknowns.swap(i, j);
        self.scales.swap(i, j);
    }

    fn eliminate_single(&mut self, scaled: &mut [f64]) -> usize {
        let (k, stride) = (self.eliminated, self.stride);
        let pivot = self.rows[k * stride + k];
        let inverse = 1.0 / pivot;
        let row = &mut self.rows[k * stride..(k + 1) * stride];
        row[..=k].fill(0.0);
        scaled[k * stride..(k + 1) * stride].copy_from_slice(row);
        row.iter_mut().for_each(|value| *value *= inverse);
        self.inverse_pivots.push(inverse);
        self.inverse_couplings.push(0.0);
        self.eliminated += 1;
        self.update_remaining(&scaled[k * stride..(k + 1) * stride]);
        usize::from(pivot < 0.0)
    }

    fn eliminate_pair(&mut self, scaled: &mut [f64]) -> usize {
        let (k, stride) = (self.eliminated, self.stride);
        let block = [
            self.rows[k * stride + k],
            self.rows[k * stride + k + 1],
            self.rows[(k + 1) * stride + k + 1],
        ];
        let inverse = inverse_pair(block[0], block[1], block[2]).unwrap_or([0.0; 3]);
        let (first, second) = self.rows[k * stride..(k + 2) * stride].split_at_mut(stride);
        first[..k + 2].fill(0.0);
        second[..k + 2].fill(0.0);
        scaled[k * stride..(k + 1) * stride].copy_from_slice(first);
        scaled[(k + 1) * stride..(k + 2) * stride].copy_from_slice(second);
        for (one, two) in first.iter_mut().zip(second) {
            let (a, b) = (*one, *two);
            *one = inverse[0] * a + inverse[1] * b;
            *two = inverse[1] * a + inverse[2] * b;
        }
        self.inverse_pivots.extend([inverse[0], inverse[2]]);
        self.inverse_couplings.extend([inverse[1], 0.0]);
        self.eliminated += 2;
        self.update_remaining(&scaled[k * stride..(k + 2) * stride]);
        // Opposite signs, or both that of the inverse's diagonal.
        if inverse[0] * inverse[2] < inverse[1] * inverse[1] {
            1
        } else if inverse[0] < 0.0 {
            2
        } else {
            0
        }
    }

    /// Subtracts the last pivot rows' contribution from the rows not yet eliminated.
    fn update_remaining(&mut self, scaled: &[f64]) {
        let stride = self.stride;
        let (done, rest) = self.rows.split_at_mut(self.eliminated * stride);
        let pivots = scaled.len() / stride;
        let unit = &done[(self.eliminated - pivots) * stride..];
        for (offset, row) in rest.chunks_exact_mut(stride).enumerate() {
            let i = self.eliminated + offset;
            for (scaled, unit) in scaled.chunks_exact(stride).zip(unit.chunks_exact(stride)) {
                let coefficient = scaled[i];
                if coefficient == 0.0 {
                    continue;
                }
                let mut largest = self.scales[i];
                for (value, &unit) in row.iter_mut().zip(unit) {
                    let term = coefficient * unit;
                    *value -= term;
                    largest = largest.max(term.abs());
                }
                self.scales[i] = largest;
            }
        }
    }
}

#[derive(Debug, Clone, Copy)]
enum Pivot {
    Single(usize),
    Pair(usize, usize),
}

/// Upper triangle of the inverse of `[[a, b], [b, c]]`, nothing when that is noise.
fn inverse_pair(a: f64, b: f64, c: f64) -> Option<[f64; 3]> {
    let scale = a.abs().max(b.abs()).max(c.abs());
    let (sa, sb, sc) = (a / scale, b / scale, c / scale);
    let determinant = sa * sc - sb * sb;
    if determinant.abs() > NOISE * ((sa * sc).abs() + sb * sb) {
        let factor = 1.0 / (determinant * scale);
        Some([sc * factor, -sb * factor, sa * factor])
    } else {
        None
    }
}
