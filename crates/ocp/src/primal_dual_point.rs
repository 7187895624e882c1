use crate::decision_layout::DecisionLayout;
use crate::samples::Samples;

/// A primal–dual point of a transcribed problem: what a solve ends at and what the next one can
/// start from.
#[derive(Debug, Clone)]
pub struct PrimalDualPoint {
    pub(crate) layout: DecisionLayout,
    /// The decision vector.
    pub(crate) z: Vec<f64>,
    /// Multipliers of the constraint vector.
    pub(crate) constraints: Vec<f64>,
    /// Multipliers of the lower bounds, at least zero.
    pub(crate) lower: Vec<f64>,
    /// Multipliers of the upper bounds, at least zero.
    pub(crate) upper: Vec<f64>,
}

impl PrimalDualPoint {
    /// Costate at the end of each step: the multipliers of x_{k+1} − F(x_k, u_k) = 0, one row a step.
    pub fn costates(&self) -> Samples {
        let dimensions = self.layout.dimensions();
        let mut costates = Samples::new(dimensions.states);
        for step in 0..dimensions.steps {
            costates.push(&self.constraints[self.layout.defect(step)]);
        }
        costates
    }
}
