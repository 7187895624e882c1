//! How well the steps of a grid are integrated.

use std::num::NonZeroUsize;

use crate::block::{Block, lanes};
use crate::multiple_shooting::MultipleShooting;
use crate::primal_dual_point::PrimalDualPoint;
use crate::samples::Samples;

impl MultipleShooting<'_> {
    /// By how much each step from the states and controls of `point` would end elsewhere if it were
    /// integrated in `substeps` Runge–Kutta steps: one row a step, one column for each state of the problem;
    /// zero for passive states.
    ///
    /// Of a method of fourth order, and twice as many substeps as it takes itself, that is 15/16 of its own
    /// error (Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, section II.4).
    pub fn step_errors(&mut self, point: &PrimalDualPoint, substeps: NonZeroUsize) -> Samples {
        self.start_from(&point.z);
        let Self { functions, layout, initial, workspace, grid, .. } = self;
        let evaluator = &mut workspace.evaluator;
        let (h, z) = (grid.step_s(), &point.z);
        let state = |k: usize| if k == 0 { &initial[..] } else { &z[layout.state(k)] };
        let control = |k: usize| &z[layout.control(k)];
        let mut errors = Samples::repeated(&vec![0.0; functions.all_states], grid.steps());
        for block in Block::cover(grid.steps()) {
            let own = functions.substeps();
            let reached = evaluator.step_values(functions, block, h, own, state, control).to_vec();
            let better = evaluator.step_values(functions, block, h, substeps, state, control);
            for (lane, step) in block.items() {
                let row = errors.row_mut(step);
                for (index, &target) in functions.active.iter().enumerate() {
                    let error = lanes(better, index)[lane] - lanes(&reached, index)[lane];
                    row[target] = error.abs();
                }
            }
        }
        errors
    }
}
