//! Defects with a diagonal of their own: the pivot of next state and multiplier is
//! `[[P, I], [I, −Δ]]`, eliminated through `S = I + √Δ P √Δ`.

use pulp::Simd;

use super::delayed::Delayed;
use super::elimination::{Breakdown, Elimination};
use super::lanes::{AlignedVec, add_rows, reset, vectors, vectors_mut, zeros};

/// Elimination of next state and defect multiplier.
#[derive(Debug, Clone, Default)]
pub(super) struct DefectRegularization {
    /// √Δ of the scaled defect rows.
    roots: Vec<f64>,
    /// S eliminated from `[[S, √Δ P], [P √Δ, P]]`; trailing are the states, then the unknowns
    /// that the next node delayed.
    elimination: Elimination,
}

/// Scratch of the factorisation.
#[derive(Debug, Clone)]
pub(super) struct DefectRegularizationWorkspace {
    matrix: AlignedVec,
    scaled: AlignedVec,
    scales: Vec<f64>,
}

impl Default for DefectRegularizationWorkspace {
    fn default() -> Self {
        Self { matrix: zeros(0), scaled: zeros(0), scales: Vec::new() }
    }
}

impl DefectRegularization {
    /// Sets √Δ from the defect rows' diagonals and scales.
    pub fn set_roots(&mut self, diagonals: &[f64], scales: &[f64]) -> Result<(), Breakdown> {
        self.roots.clear();
        for (&diagonal, &scale) in diagonals.iter().zip(scales) {
            if diagonal > 0.0 || diagonal.is_nan() {
                return Err(Breakdown::Failed);
            }
            self.roots.push((-diagonal).sqrt() * scale.abs());
        }
        Ok(())
    }

    /// Turns the next cost to go into the one seen through the defects, `P ← P − P√Δ S⁻¹ √ΔP`,
    /// and the delayed unknowns' coupling likewise; returns the negative eigenvalues of S.
    #[inline(always)]
    pub fn factor<S: Simd>(
        &mut self,
        simd: S,
        work: &mut DefectRegularizationWorkspace,
        value: &mut [f64],
        delayed: &mut Delayed,
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        let states = self.roots.len();
        let lanes = S::F64_LANES;
        let width = states.next_multiple_of(lanes);
        let stride = 2 * width + delayed.count.next_multiple_of(lanes);
        self.elimination.shape(states, width, stride);
        self.elimination.unknowns.clear();
        self.elimination.unknowns.extend(0..states as u32);
        reset(&mut work.matrix, states * stride);
        work.scales.clear();
        for (i, &root) in self.roots.iter().enumerate() {
            let row = &mut work.matrix[i * stride..(i + 1) * stride];
            let value = &value[i * width..(i + 1) * width];
            for (j, &other) in self.roots.iter().enumerate() {
                row[j] = root * value[j] * other;
                row[width + j] = root * value[j];
            }
            work.scales.push(1.0 + row[i].abs());
            row[i] += 1.0;
            for j in 0..delayed.count {
                row[2 * width + j] = root * delayed.states[j * width + i];
            }
        }
        if work.scaled.len() < work.matrix.len() {
            work.scaled.resize(work.matrix.len(), 0.0);
        }
        let scaled = &mut work.scaled;
        let negative =
            self.elimination.eliminate(simd, &work.matrix, &work.scales, scaled, tolerance)?;
        if self.elimination.delayed() > 0 {
            return Err(Breakdown::Singular);
        }

        let unit = vectors::<S>(&self.elimination.rows);
        let start = |k: usize| (k * stride + width) / lanes;
        for (i, row) in value.chunks_exact_mut(width.max(1)).enumerate() {
            let terms = (0..states).map(|k| (-scaled[k * stride + width + i], start(k)));
            add_rows(simd, vectors_mut::<S>(row), unit, terms);
        }
        for j in 0..delayed.count {
            let coefficient = |k: usize| -scaled[k * stride + 2 * width + j];
            let row = &mut delayed.states[j * width..(j + 1) * width];
            let terms = (0..states).map(|k| (coefficient(k), start(k)));
            add_rows(simd, vectors_mut::<S>(row), unit, terms);
            for i in 0..delayed.count {
                delayed.corner[j * delayed.count + i] += (0..states)
                    .map(|k| coefficient(k) * self.elimination.row(k)[2 * width + i])
                    .sum::<f64>();
            }
        }
        Ok(negative)
    }

    /// Multipliers `y ← (I + PΔ)⁻¹ y` and states `x ← x + Δ y`, all padded.
    #[inline(always)]
    pub fn solve<S: Simd>(
        &self,
        simd: S,
        inner: &mut AlignedVec,
        multipliers: &mut [f64],
        states: &mut [f64],
    ) {
        let elimination = &self.elimination;
        let (lanes, width) = (S::F64_LANES, elimination.split);
        reset(inner, width);
        for (inner, &unknown) in inner.iter_mut().zip(&elimination.unknowns) {
            let i = unknown as usize;
            *inner = self.roots[i] * multipliers[i];
        }
        let rows = vectors::<S>(&elimination.rows);
        for k in 0..elimination.eliminated {
            let coefficient = -inner[k];
            let own = k * elimination.stride / lanes;
            let once = |start: usize| std::iter::once((coefficient, start));
            add_rows(simd, vectors_mut::<S>(inner), rows, once(own));
            add_rows(simd, vectors_mut::<S>(multipliers), rows, once(own + width / lanes));
        }
        for ((state, root), multiplier) in states.iter_mut().zip(&self.roots).zip(multipliers) {
            *state += root * root * *multiplier;
        }
    }
}
