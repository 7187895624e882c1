//! The backward sweep: eliminates node after node, the last first.

use pulp::{Simd, WithSimd};

use super::assembly::Assembly;
use super::defect_regularization::DefectRegularizationWorkspace;
use super::delayed::Delayed;
use super::dims::SystemLayout;
use super::elimination::Breakdown;
use super::hessian::{CostToGo, Image, leading_scales};
use super::lanes::{AlignedVec, zeros};
use super::node::NodeFactor;
use super::packed::pack;
use super::structure::Structure;

/// Scratch of the sweep.
#[derive(Debug, Clone)]
pub(super) struct FactorWorkspace {
    assembly: Assembly,
    image: Image,
    /// Leading rows of the node's matrix.
    matrix: AlignedVec,
    /// Pivot rows times D.
    scaled: AlignedVec,
    /// Magnitude of the terms of each leading diagonal.
    scales: Vec<f64>,
    /// Behind the node.
    value: CostToGo,
    delayed: Delayed,
    regularization: DefectRegularizationWorkspace,
}

impl Default for FactorWorkspace {
    fn default() -> Self {
        Self {
            assembly: Assembly::default(),
            image: Image::default(),
            matrix: zeros(0),
            scaled: zeros(0),
            scales: Vec::new(),
            value: CostToGo::default(),
            delayed: Delayed::default(),
            regularization: DefectRegularizationWorkspace::default(),
        }
    }
}

/// One factorisation.
pub(super) struct Factor<'a> {
    pub layout: &'a SystemLayout,
    pub structure: &'a Structure,
    pub nodes: &'a mut [NodeFactor],
    pub work: &'a mut FactorWorkspace,
    pub values: &'a [f64],
    /// Smallest pivot allowed beside the rest of its row.
    pub tolerance: f64,
    /// Stop as soon as there are more negative eigenvalues than constraints.
    pub stop_at_excess: bool,
}

/// How far a factorisation came.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Inertia {
    /// All the way.
    Exact {
        /// Negative eigenvalues.
        negative: usize,
    },
    /// Until the matrix was known to have more negative eigenvalues than constraints.
    Excess,
}

impl WithSimd for Factor<'_> {
    type Output = Result<Inertia, Breakdown>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Self::Output {
        let mut negative = 0;
        let mut constraints = 0;
        for k in (0..self.nodes.len()).rev() {
            negative += self.eliminate_node(simd, k)?;
            // Whatever is left has at least one negative eigenvalue for each of its constraints,
            // whose diagonal block is not positive.
            let shape = self.structure.pattern(k).shape;
            constraints += shape.defects + shape.equalities + shape.inequalities;
            if self.stop_at_excess && negative > constraints {
                return Ok(Inertia::Excess);
            }
        }
        match self.nodes.first() {
            Some(first) if first.leading.delayed() > 0 => Err(Breakdown::Singular),
            _ => Ok(Inertia::Exact { negative }),
        }
    }
}

impl Factor<'_> {
    /// Eliminates the next node's states with the defect's multipliers, then all of node `k` but
    /// its states; returns the negative eigenvalues.
    #[inline(always)]
    fn eliminate_node<S: Simd>(&mut self, simd: S, k: usize) -> Result<usize, Breakdown> {
        let pattern_index = self.structure.gather(k).pattern;
        let pattern = &self.structure.patterns[pattern_index];
        let shape = pattern.shape;
        let work = &mut *self.work;
        let (before, after) = self.nodes.split_at_mut(k + 1);
        let (node, next) = (&mut before[k], after.first());
        let mut negative = work.assembly.collect(self.structure, k, self.values, node)?;

        negative += shape.defects;
        match next {
            Some(next) => work.delayed.copy(&next.leading),
            None => work.delayed.count = 0,
        }
        let diagonals = work.assembly.defect_diagonals(pattern);
        if diagonals.iter().all(|&diagonal| diagonal == 0.0) {
            node.regularization = None;
        } else {
            let regularization = node.regularization.get_or_insert_default();
            regularization.set_roots(diagonals, &node.defect_scales)?;
            let scratch = &mut work.regularization;
            let value = work.value.rows_mut(S::F64_LANES);
            negative +=
                regularization.factor(simd, scratch, value, &mut work.delayed, self.tolerance)?;
        }

        let delayed = work.delayed.count;
        let leading = &mut node.leading;
        let split = (shape.leading() + delayed).next_multiple_of(S::F64_LANES);
        leading.shape(shape.leading() + delayed, split, split + pattern.state_stride);
        leading.unknowns.clear();
        let at = &self.layout.nodes[k];
        let first = if k == 0 { at.variable } else { at.control() };
        let free = first as u32..(first + shape.free) as u32;
        let equalities = at.equality as u32..(at.equality + shape.equalities) as u32;
        leading.unknowns.extend(free.chain(equalities));

        work.image.form(simd, pattern, pattern_index, node, &work.value);
        work.image.leading_rows(simd, pattern, node, &work.assembly, &mut work.matrix);
        leading_scales(simd, pattern, node, &work.value, &work.assembly, &mut work.scales);
        if let Some(next) = next.filter(|_| delayed > 0) {
            let from = next.leading.eliminated;
            node.leading.unknowns.extend_from_slice(&next.leading.unknowns[from..]);
            work.scales.extend_from_slice(&next.leading.scales[from..]);
            work.delayed.append(pattern, &node.leading, &node.jacobian, &mut work.matrix);
        }
        if work.scaled.len() < work.matrix.len() {
            work.scaled.resize(work.matrix.len(), 0.0);
        }
        let (matrix, scales, scaled) = (&work.matrix, &work.scales, &mut work.scaled);
        negative += if shape.equalities == 0 && delayed == 0 {
            node.leading.eliminate(simd, matrix, scales, scaled, self.tolerance)?
        } else {
            node.leading.eliminate_pivoted(matrix, scales, scaled, self.tolerance)?
        };
        let (assembly, value) = (&work.assembly, &mut work.value);
        work.image.cost_to_go(simd, pattern, node, assembly, &work.scaled, value)?;
        pack::<S>(
            work.value.rows(S::F64_LANES),
            shape.states,
            pattern.state_stride,
            &mut node.value,
        );
        Ok(negative)
    }
}
