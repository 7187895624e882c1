//! What the factorisation keeps of each node.

use super::defect_regularization::DefectRegularization;
use super::elimination::{Breakdown, Elimination, NOISE};
use super::lanes::{AlignedVec, zeros};
use super::packed::packed_length;
use super::pattern::NodePattern;

/// Factor of one node and of the defect that leads from it to the next.
#[derive(Debug, Clone)]
pub(super) struct NodeFactor {
    /// Hessian P of the cost to go in the node's states: all later nodes eliminated. Packed.
    pub value: AlignedVec,
    /// Elimination of the controls and all else that is not a state.
    pub leading: Elimination,
    /// Jacobian of the defects, rows scaled so that the next state has coefficient one, and of the
    /// inequalities; as the pattern stores it.
    pub jacobian: AlignedVec,
    /// Reciprocal coefficient of each next state in its defect row.
    pub defect_scales: Vec<f64>,
    /// Elimination of each inequality's slack and multiplier.
    pub inequalities: Vec<InequalityPivot>,
    /// Elimination of next state and defect multiplier where the defects are regularised.
    pub regularization: Option<Box<DefectRegularization>>,
}

impl NodeFactor {
    pub fn new(pattern: &NodePattern, lanes: usize) -> Self {
        let shape = pattern.shape;
        let mut leading = Elimination::default();
        leading.shape(shape.leading(), pattern.split, pattern.stride);
        Self {
            value: zeros(packed_length(shape.states, lanes)),
            leading,
            jacobian: zeros(pattern.jacobian.length),
            defect_scales: vec![1.0; shape.defects],
            inequalities: vec![InequalityPivot::default(); shape.inequalities],
            regularization: None,
        }
    }

    /// The same room for a node of this pattern, if it is as large.
    pub fn reused(mut self, pattern: &NodePattern, lanes: usize) -> Option<Self> {
        let shape = pattern.shape;
        let fits = self.value.len() == packed_length(shape.states, lanes)
            && self.jacobian.len() == pattern.jacobian.length
            && self.defect_scales.len() == shape.defects
            && self.inequalities.len() == shape.inequalities;
        // What stands between the entries of a pattern is zero.
        self.jacobian.fill(0.0);
        self.leading.shape(shape.leading(), pattern.split, pattern.stride);
        fits.then_some(self)
    }
}

/// Inverse of the block `[[σ, e], [e, −δ]]` of a slack and its multiplier, up to signs.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct InequalityPivot {
    /// σ / (e² + σδ): the weight of the row's outer product in the node's Hessian.
    pub weight: f64,
    /// e / (e² + σδ)
    pub coupling: f64,
    /// δ / (e² + σδ)
    pub compliance: f64,
}

impl InequalityPivot {
    /// The pivot and its number of negative eigenvalues.
    #[inline(always)]
    pub fn new(sigma: f64, e: f64, delta: f64) -> Result<(Self, usize), Breakdown> {
        let determinant = e * e + sigma * delta;
        let terms = e * e + (sigma * delta).abs();
        if !terms.is_finite() {
            return Err(Breakdown::Failed);
        }
        if determinant.abs() <= NOISE * terms {
            return Err(Breakdown::Singular);
        }
        // The block's determinant is −(e² + σδ): opposite signs when that is negative, else both
        // eigenvalues have the sign of σ (and of −δ).
        let negative = match (determinant > 0.0, sigma < 0.0) {
            (true, _) => 1,
            (false, true) => 2,
            (false, false) => 0,
        };
        let inverse = 1.0 / determinant;
        let pivot =
            Self { weight: sigma * inverse, coupling: e * inverse, compliance: delta * inverse };
        Ok((pivot, negative))
    }

    /// Slack and multiplier from their right-hand sides, the node's variables being known.
    #[inline(always)]
    pub fn solve(&self, slack: f64, multiplier: f64) -> (f64, f64) {
        (
            self.compliance * slack + self.coupling * multiplier,
            self.coupling * slack - self.weight * multiplier,
        )
    }
}
