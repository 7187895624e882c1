//! What the factorisation keeps of each node.

use super::elimination::{Breakdown, Elimination};
use super::lanes::{AlignedVec, zeros};
use super::pattern::NodePattern;

/// Factor of one node and of the defect that leads from it to the next.
#[derive(Debug)]
pub(super) struct NodeFactor {
    /// Hessian P of the cost to go in the node's states: all later nodes eliminated. Full, by rows.
    pub value: AlignedVec,
    /// Elimination of the controls and all else that is not a state.
    pub leading: Elimination,
    /// Jacobian of the step, rows scaled so that the next state has coefficient one, and of the
    /// inequalities; in the pattern's order.
    pub constraints: AlignedVec,
    /// Reciprocal coefficient of each next state in its defect row.
    pub defect_scales: Vec<f64>,
    /// Elimination of each inequality's slack and multiplier.
    pub inequalities: Vec<InequalityPivot>,
    /// Elimination of next state and defect multiplier where the defects are regularised.
    pub regularization: Option<Box<Regularization>>,
}

impl NodeFactor {
    pub fn new(pattern: &NodePattern) -> Self {
        let shape = pattern.shape;
        let mut leading = Elimination::default();
        leading.shape(shape.leading(), pattern.split, pattern.stride);
        Self {
            value: zeros(shape.states * pattern.state_stride),
            leading,
            constraints: zeros(pattern.entries()),
            defect_scales: vec![1.0; shape.defects],
            inequalities: vec![InequalityPivot::default(); shape.inequalities],
            regularization: None,
        }
    }
}

/// Elimination of next state x and defect multiplier y when the defect's diagonal is −Δ ≠ 0:
/// `[[P, I], [I, −Δ]]`, through `S = I + √Δ P √Δ`.
#[derive(Debug, Default)]
pub(super) struct Regularization {
    /// √Δ of the scaled defect rows.
    pub roots: Vec<f64>,
    /// S eliminated from `[[S, √Δ P], [P √Δ, P]]`; trailing are the states, then the unknowns
    /// that the next node delayed.
    pub elimination: Elimination,
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
    pub fn new(sigma: f64, e: f64, delta: f64) -> Result<(Self, usize), Breakdown> {
        let determinant = e * e + sigma * delta;
        let terms = e * e + (sigma * delta).abs();
        if !terms.is_finite() {
            return Err(Breakdown::Failed);
        }
        if determinant.abs() <= super::elimination::NOISE * terms {
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
    pub fn solve(&self, slack: f64, multiplier: f64) -> (f64, f64) {
        (
            self.compliance * slack + self.coupling * multiplier,
            self.coupling * slack - self.weight * multiplier,
        )
    }
}
