//! Collects one node's values from the triplets.

use super::elimination::Breakdown;
use super::lanes::{AlignedVec, reset, zeros};
use super::node::{InequalityPivot, NodeFactor};
use super::pattern::NodePattern;
use super::structure::Structure;

/// One node's values as [`super::pattern::Sections`] lays them out.
#[derive(Debug, Clone)]
pub(super) struct Assembly {
    values: AlignedVec,
    /// Pattern of the last node: where its values stand all else is zero already.
    pattern: Option<usize>,
}

impl Default for Assembly {
    fn default() -> Self {
        Self { values: zeros(0), pattern: None }
    }
}

impl Assembly {
    /// Collects the node's values; the Jacobian goes to the node, with the defect rows scaled so
    /// that the next state has coefficient one. Returns the negative eigenvalues of slacks and
    /// inequality multipliers, which are eliminated here.
    #[inline(always)]
    pub fn collect(
        &mut self,
        structure: &Structure,
        k: usize,
        values: &[f64],
        node: &mut NodeFactor,
    ) -> Result<usize, Breakdown> {
        let gather = structure.gather(k);
        let pattern = &structure.patterns[gather.pattern];
        if self.pattern != Some(gather.pattern) {
            reset(&mut self.values, pattern.sections.end);
            self.pattern = Some(gather.pattern);
        }
        let sources = &structure.sources[structure.nodes[k].start..];
        let (own, sources) = sources.split_at(gather.assembly.sources());
        gather.assembly.collect(own, values, &mut self.values);
        let own = &sources[..gather.jacobian.sources()];
        gather.jacobian.collect(own, values, &mut node.jacobian);

        let sections = &pattern.sections;
        let couplings = &self.values[sections.defect_couplings..];
        let mut scaled = false;
        for (scale, &coupling) in node.defect_scales.iter_mut().zip(couplings) {
            *scale = 1.0 / coupling;
            if !scale.is_finite() || *scale == 0.0 {
                return Err(Breakdown::Failed);
            }
            scaled |= coupling != 1.0;
        }
        if scaled {
            pattern.jacobian.scale(&mut node.jacobian, &node.defect_scales);
        }

        let mut negative = 0;
        for (row, pivot) in node.inequalities.iter_mut().enumerate() {
            let sigma = self.values[sections.slack_diagonals + row];
            let e = self.values[sections.slack_couplings + row];
            let delta = -self.values[sections.inequality_diagonals + row];
            let (inverse, count) = InequalityPivot::new(sigma, e, delta)?;
            *pivot = inverse;
            negative += count;
        }
        Ok(negative)
    }

    /// Rows of the leading unknowns, upper triangle: their leading columns, then their states'.
    #[inline(always)]
    pub fn leading_rows(&self, pattern: &NodePattern) -> &[f64] {
        &self.values[..pattern.sections.states]
    }

    /// Rows of the states, lower triangle.
    #[inline(always)]
    pub fn state_rows(&self, pattern: &NodePattern) -> &[f64] {
        &self.values[pattern.sections.states..pattern.sections.defect_couplings]
    }

    /// Diagonals of the defect rows, −Δ.
    #[inline(always)]
    pub fn defect_diagonals(&self, pattern: &NodePattern) -> &[f64] {
        &self.values[pattern.sections.defect_diagonals..][..pattern.shape.defects]
    }
}
