//! Motions that follow from the controls of a point.

use righting_nlp::Problem;

use crate::block::{Block, lanes};
use crate::component_bounds::ComponentBounds;
use crate::evaluation::load_terminal;
use crate::multiple_shooting::MultipleShooting;
use crate::primal_dual_point::PrimalDualPoint;
use crate::shooting_workspace::ShootingWorkspace;

/// Passes over the steps after which gaps stay as they are.
const PASSES: usize = 10;

/// What a motion comes to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionOutcome {
    /// The objective.
    pub objective: f64,
    /// The part of it that its last state costs.
    pub terminal_cost: f64,
    /// By how much it passes a bound or a constraint at most, gaps among them.
    pub violation: f64,
}

impl MultipleShooting<'_> {
    /// Moves the states of a point to where its controls lead, until no gap x_{k+1} − F(x_k, u_k) is larger than
    /// `tolerance`; the largest that was found last.
    ///
    /// Newton's method on the gaps with the controls held, δ_{k+1} = A_k δ_k + F(x_k, u_k) − x_{k+1}, evaluates steps
    /// side by side where an integration would take one after the other (Bock & Plitt, *IFAC Proceedings* 17, 1984,
    /// condense the same recursion). Multipliers stay.
    ///
    /// # Panics
    /// The point is of another grid.
    pub fn close_gaps(&mut self, point: &mut PrimalDualPoint, tolerance: f64) -> f64 {
        assert_eq!(point.layout, self.layout(), "a point of this program");
        let mut largest = f64::INFINITY;
        for _ in 0..PASSES {
            largest = self.narrow_gaps(&mut point.z);
            if largest <= tolerance || !largest.is_finite() {
                break;
            }
        }
        largest
    }

    /// One pass; the largest gap before it. A block of steps starts where the last one has been moved to.
    fn narrow_gaps(&mut self, z: &mut [f64]) -> f64 {
        self.start_from(z);
        self.workspace.stored_at.clear();
        let Self { functions, layout, initial, grid, workspace, .. } = self;
        let ShootingWorkspace { evaluator, store, .. } = workspace;
        let states = functions.states;
        let (mut largest, mut moved, mut next) = (0.0_f64, vec![0.0; states], vec![0.0; states]);
        for (block, mut stored) in Block::cover(grid.steps()).zip(store.blocks_mut()) {
            let point: &[f64] = z;
            let state = |k: usize| if k == 0 { &initial[..] } else { &point[layout.state(k)] };
            evaluator.step_jacobian(
                functions,
                block,
                grid.step_s(),
                state,
                |k| &point[layout.control(k)],
                &mut stored,
            );
            let (jacobian, reached) = evaluator.linearization();
            moved.fill(0.0);
            for (lane, step) in block.items() {
                let x = &mut z[layout.state(step + 1)];
                for (index, (next, x)) in next.iter_mut().zip(&*x).enumerate() {
                    *next = lanes(reached, index)[lane] - x;
                    largest =
                        largest.max(if next.is_finite() { next.abs() } else { f64::INFINITY });
                }
                let before_controls = functions.step.jacobian.at_lane(jacobian, lane);
                for (row, column, value) in before_controls.filter(|entry| entry.1 < states) {
                    // The entries are those of −∂F/∂x.
                    next[row] -= value * moved[column];
                }
                x.iter_mut().zip(&next).for_each(|(x, moved)| *x += moved);
                std::mem::swap(&mut moved, &mut next);
            }
        }
        largest
    }

    /// What the motion of a point comes to.
    ///
    /// # Panics
    /// The point is of another grid.
    pub fn outcome(&mut self, point: &PrimalDualPoint) -> MotionOutcome {
        assert_eq!(point.layout, self.layout(), "a point of this program");
        let (layout, steps) = (self.layout, self.steps());
        let mut rows = vec![0.0; layout.constraints()];
        let objective = self.objective(&point.z, true).unwrap_or(f64::INFINITY);
        let is_defined = self.constraints(&point.z, true, &mut rows).is_ok();
        let functions = self.functions;
        let mut violation = if is_defined { 0.0 } else { f64::INFINITY };
        let mut keeps = |bounds: &ComponentBounds, values: &[f64]| {
            for ((value, lower), upper) in values.iter().zip(&bounds.lower).zip(&bounds.upper) {
                violation = f64::max(violation, (lower - value).max(value - upper));
            }
        };
        for step in 0..steps {
            keeps(&functions.control_bounds, &point.z[layout.control(step)]);
            keeps(&functions.state_bounds, &point.z[layout.state(step + 1)]);
            keeps(functions.stage_bounds.of_step(step), &rows[layout.stage(step)]);
            keeps(&functions.path_bounds, &rows[layout.path(step + 1)]);
        }
        keeps(&functions.terminal_bounds, &rows[layout.terminal()]);
        let gaps = (0..steps).flat_map(|step| &rows[layout.defect(step)]);
        violation = gaps.fold(violation, |most, gap| most.max(gap.abs()));
        let workspace = &mut self.workspace.evaluator.terminal_cost.value;
        load_terminal(workspace, &point.z[layout.state(steps)]);
        functions.terminal_cost.value.evaluate_block(workspace);
        MotionOutcome { objective, terminal_cost: workspace.output(0)[0], violation }
    }
}
