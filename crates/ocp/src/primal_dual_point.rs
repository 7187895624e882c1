use crate::decision_layout::{DecisionLayout, ShootingDimensions};
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

    /// The number of steps N of its grid.
    pub fn steps(&self) -> usize {
        self.layout.dimensions().steps
    }

    /// What is left of the point after its first `steps` steps: the warm start of the same problem from the
    /// node reached then. Nothing is interpolated. The free entries of x_0 stay as they were.
    ///
    /// # Panics
    /// No step is left.
    pub fn after(&self, steps: usize) -> Self {
        let old = self.layout;
        assert!(steps < self.steps(), "{steps} steps of {} are all", self.steps());
        let steps_left = self.steps() - steps;
        let layout =
            DecisionLayout::new(ShootingDimensions { steps: steps_left, ..old.dimensions() });
        let of_variables = |values: &[f64]| {
            let left = old.control(steps).start;
            [&values[old.free()], &values[left..]].concat()
        };
        let first_row = old.stage(steps).start;
        Self {
            layout,
            z: of_variables(&self.z),
            constraints: self.constraints[first_row..].to_vec(),
            lower: of_variables(&self.lower),
            upper: of_variables(&self.upper),
        }
    }
}
