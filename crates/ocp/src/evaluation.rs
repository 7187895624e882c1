//! The functions and derivatives of the nonlinear program, block by block of stages.

use righting_nlp::{Bounds, EvaluationError, Problem, TripletStructure};

use crate::block::{Block, lanes};
use crate::decision_layout::DecisionLayout;
use crate::evaluator::NodeWorkspace;
use crate::multiple_shooting::MultipleShooting;
use crate::node_function::NodeFunction;
use crate::shooting_workspace::ShootingWorkspace;
use crate::stage_functions::StageFunctions;
use crate::structure::Scatter;

/// Rows of a decision or constraint vector by step and node.
#[derive(Clone, Copy)]
struct Rows<'a> {
    layout: DecisionLayout,
    initial: &'a [f64],
    vector: &'a [f64],
}

impl<'a> Rows<'a> {
    fn state(self, node: usize) -> &'a [f64] {
        match node {
            0 => self.initial,
            _ => &self.vector[self.layout.state(node)],
        }
    }

    fn control(self, step: usize) -> &'a [f64] {
        &self.vector[self.layout.control(step)]
    }
}

impl MultipleShooting<'_> {
    /// Evaluates ∂F/∂(x, u) of all steps at `z` into `values` (if any) and fills the store.
    fn evaluate_steps(&mut self, z: &[f64], mut values: Option<&mut [f64]>) {
        self.start_from(z);
        let Self { functions, layout, initial, grid, workspace, .. } = self;
        let ShootingWorkspace { jacobian, evaluator, store, .. } = workspace;
        let rows = Rows { layout: *layout, initial, vector: z };
        let blocks = Block::cover(grid.steps());
        for (block, mut stored) in blocks.zip(store.blocks_mut()) {
            let computed = evaluator.step_jacobian(
                functions,
                block,
                grid.step_s(),
                |k| rows.state(k),
                |k| rows.control(k),
                &mut stored,
            );
            let Some(values) = values.as_deref_mut() else { continue };
            for (lane, step) in block.items() {
                let entry = |slot| jacobian.entry(step, slot);
                scatter(values, &jacobian.step, entry, |index| lanes(computed, index)[lane]);
            }
        }
        self.workspace.stored_at.clear();
        self.workspace.stored_at.extend_from_slice(z);
    }
}

/// Adds the computed values and the constants of one step or node to where they belong.
fn scatter(
    values: &mut [f64],
    map: &Scatter,
    entry: impl Fn(usize) -> Option<usize>,
    computed: impl Fn(usize) -> f64,
) {
    for (index, &slot) in map.varying.iter().enumerate() {
        if let Some(entry) = entry(slot) {
            values[entry] += computed(index);
        }
    }
    for &(slot, constant) in &map.constant {
        if let Some(entry) = entry(slot) {
            values[entry] += constant;
        }
    }
}

/// Evaluates a function of the last state alone; every lane holds the same point.
pub(crate) fn load_terminal(workspace: &mut righting_symbolic::Workspace, state: &[f64]) {
    for (lanes, &value) in
        workspace.input_mut(0).chunks_exact_mut(righting_symbolic::LANES).zip(state)
    {
        lanes.fill(value);
    }
}

/// The port of the weights of the stage constraints, after x, u and h.
const STAGE_WEIGHTS: usize = 3;

/// The port of the weight of the running cost, after x, u, t and h.
const RUNNING_WEIGHT: usize = 4;

/// Loads states, controls, beginnings and length of a block of steps.
fn load_running(
    workspace: &mut righting_symbolic::Workspace,
    functions: &StageFunctions,
    block: Block,
    rows: Rows<'_>,
    step_s: f64,
) {
    load_rows(workspace, functions, block, rows);
    for (lane, step) in block.items() {
        workspace.input_mut(2)[lane] = step as f64 * step_s;
    }
    workspace.input_mut(3).fill(step_s);
}

/// Loads states, controls and step length of a block of steps.
fn load_stage(
    workspace: &mut righting_symbolic::Workspace,
    functions: &StageFunctions,
    block: Block,
    rows: Rows<'_>,
    step_s: f64,
) {
    load_rows(workspace, functions, block, rows);
    workspace.input_mut(2).fill(step_s);
}

/// Loads states and controls of a block of steps.
fn load_rows(
    workspace: &mut righting_symbolic::Workspace,
    functions: &StageFunctions,
    block: Block,
    rows: Rows<'_>,
) {
    block.load(workspace.input_mut(0), functions.states, |k| rows.state(k));
    block.load(workspace.input_mut(1), functions.controls, |k| rows.control(k));
}

impl Problem for MultipleShooting<'_> {
    fn dimensions(&self) -> righting_nlp::Dimensions {
        righting_nlp::Dimensions {
            variables: self.layout.variables(),
            constraints: self.layout.constraints(),
        }
    }

    fn bounds(&self, bounds: &mut Bounds) {
        let functions = self.functions;
        for (index, &state) in self.layout.free().zip(&functions.free) {
            bounds.x_lower[index] = functions.state_bounds.lower[state];
            bounds.x_upper[index] = functions.state_bounds.upper[state];
        }
        for k in 0..self.steps() {
            let (control, state) = (self.layout.control(k), self.layout.state(k + 1));
            let (defect, path) = (self.layout.defect(k), self.layout.path(k + 1));
            let (stage, stage_bounds) = (self.layout.stage(k), functions.stage_bounds.of_step(k));
            bounds.x_lower[control.clone()].copy_from_slice(&functions.control_bounds.lower);
            bounds.x_upper[control].copy_from_slice(&functions.control_bounds.upper);
            bounds.x_lower[state.clone()].copy_from_slice(&functions.state_bounds.lower);
            bounds.x_upper[state].copy_from_slice(&functions.state_bounds.upper);
            bounds.g_lower[defect.clone()].fill(0.0);
            bounds.g_upper[defect].fill(0.0);
            bounds.g_lower[stage.clone()].copy_from_slice(&stage_bounds.lower);
            bounds.g_upper[stage].copy_from_slice(&stage_bounds.upper);
            bounds.g_lower[path.clone()].copy_from_slice(&functions.path_bounds.lower);
            bounds.g_upper[path].copy_from_slice(&functions.path_bounds.upper);
        }
        let terminal = self.layout.terminal();
        bounds.g_lower[terminal.clone()].copy_from_slice(&functions.terminal_bounds.lower);
        bounds.g_upper[terminal].copy_from_slice(&functions.terminal_bounds.upper);
    }

    fn jacobian_structure(&self) -> TripletStructure {
        self.workspace.jacobian.triplets(self.functions, &self.layout)
    }

    fn hessian_structure(&self) -> TripletStructure {
        self.workspace.hessian.triplets(self.functions, &self.layout)
    }

    fn objective(&mut self, z: &[f64], _new_x: bool) -> Result<f64, EvaluationError> {
        let steps = self.steps();
        self.start_from(z);
        let rows = Rows { layout: self.layout, initial: &self.initial, vector: z };
        let function = &self.functions.running.value;
        let workspace = &mut self.workspace.evaluator.running.value;
        let mut running = 0.0;
        for block in Block::cover(steps) {
            load_running(workspace, self.functions, block, rows, self.grid.step_s());
            function.evaluate_block(workspace);
            let costs = lanes(workspace.output(0), 0);
            running += block.items().map(|(lane, _)| costs[lane]).sum::<f64>();
        }
        let workspace = &mut self.workspace.evaluator.terminal_cost.value;
        load_terminal(workspace, rows.state(steps));
        self.functions.terminal_cost.value.evaluate_block(workspace);
        Ok(self.grid.running_weight() * running + workspace.output(0)[0])
    }

    fn gradient(
        &mut self,
        z: &[f64],
        _new_x: bool,
        gradient: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let (steps, states) = (self.steps(), self.functions.states);
        let layout = self.layout;
        self.start_from(z);
        let rows = Rows { layout, initial: &self.initial, vector: z };
        gradient.fill(0.0);
        let running = &self.functions.running;
        let workspace = &mut self.workspace.evaluator.running.first;
        for block in Block::cover(steps) {
            load_running(workspace, self.functions, block, rows, self.grid.step_s());
            running.first.evaluate_block(workspace);
            let computed = workspace.output(1);
            for (lane, step) in block.items() {
                for (_, column, value) in running.jacobian.at_lane(computed, lane) {
                    let variable = match column < states {
                        true => self.functions.state_variable(&layout, step, column),
                        false => Some(layout.control(step).start + column - states),
                    };
                    if let Some(variable) = variable {
                        gradient[variable] += self.grid.running_weight() * value;
                    }
                }
            }
        }
        let terminal = &self.functions.terminal_cost;
        let workspace = &mut self.workspace.evaluator.terminal_cost.first;
        load_terminal(workspace, rows.state(steps));
        terminal.first.evaluate_block(workspace);
        for (_, column, value) in terminal.jacobian.at_lane(workspace.output(1), 0) {
            gradient[layout.state(steps).start + column] += value;
        }
        Ok(())
    }

    fn constraints(
        &mut self,
        z: &[f64],
        _new_x: bool,
        g: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let (steps, functions, layout) = (self.steps(), self.functions, self.layout);
        self.start_from(z);
        let rows = Rows { layout, initial: &self.initial, vector: z };
        let path = &mut self.workspace.evaluator.path.value;
        for block in Block::cover(steps) {
            block.load(path.input_mut(0), functions.states, |k| rows.state(k + 1));
            functions.path.value.evaluate_block(path);
            for (lane, step) in block.items() {
                for (index, row) in layout.path(step + 1).enumerate() {
                    g[row] = lanes(path.output(0), index)[lane];
                }
            }
        }
        for block in Block::cover(steps) {
            let h = self.grid.step_s();
            let reached = self.workspace.evaluator.step_values(
                functions,
                block,
                h,
                functions.substeps(),
                |k| rows.state(k),
                |k| rows.control(k),
            );
            for (lane, step) in block.items() {
                for (index, row) in layout.defect(step).enumerate() {
                    g[row] = rows.state(step + 1)[index] - lanes(reached, index)[lane];
                }
            }
        }
        if !functions.stage_bounds.is_empty() {
            let stage = &mut self.workspace.evaluator.stage.value;
            for block in Block::cover(steps) {
                load_stage(stage, functions, block, rows, self.grid.step_s());
                functions.stage.value.evaluate_block(stage);
                for (lane, step) in block.items() {
                    for (index, row) in layout.stage(step).enumerate() {
                        g[row] = lanes(stage.output(0), index)[lane];
                    }
                }
            }
        }
        let terminal = &mut self.workspace.evaluator.terminal.value;
        load_terminal(terminal, rows.state(steps));
        functions.terminal.value.evaluate_block(terminal);
        for (index, row) in layout.terminal().enumerate() {
            g[row] = lanes(terminal.output(0), index)[0];
        }
        Ok(())
    }

    fn jacobian(
        &mut self,
        z: &[f64],
        _new_x: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        values.fill(0.0);
        self.evaluate_steps(z, Some(values));
        let Self { functions, layout, initial, grid, workspace, .. } = self;
        let ShootingWorkspace { jacobian, evaluator, .. } = workspace;
        let steps = layout.dimensions().steps;
        let rows = Rows { layout: *layout, initial, vector: z };
        for block in Block::cover(steps) {
            block.load(evaluator.path.first.input_mut(0), functions.states, |k| rows.state(k + 1));
            functions.path.first.evaluate_block(&mut evaluator.path.first);
            let computed = evaluator.path.first.output(1);
            for (lane, step) in block.items() {
                let entry = |slot| jacobian.entry(step, slot);
                scatter(values, &jacobian.path, entry, |index| lanes(computed, index)[lane]);
                for slot in jacobian.next_state.clone() {
                    values[entry(slot).expect("the identity is in every step")] = 1.0;
                }
            }
        }
        if !functions.stage_bounds.is_empty() {
            let stage = &mut evaluator.stage.first;
            for block in Block::cover(steps) {
                load_stage(stage, functions, block, rows, grid.step_s());
                functions.stage.first.evaluate_block(stage);
                let computed = stage.output(1);
                for (lane, step) in block.items() {
                    let entry = |slot| jacobian.entry(step, slot);
                    scatter(values, &jacobian.stage, entry, |index| lanes(computed, index)[lane]);
                }
            }
        }
        load_terminal(&mut evaluator.terminal.first, rows.state(steps));
        functions.terminal.first.evaluate_block(&mut evaluator.terminal.first);
        let computed = evaluator.terminal.first.output(1);
        let entry = |slot| Some(jacobian.terminal_start() + slot);
        scatter(values, &jacobian.terminal, entry, |index| lanes(computed, index)[0]);
        Ok(())
    }

    fn hessian(
        &mut self,
        z: &[f64],
        _new_x: bool,
        objective_factor: f64,
        multipliers: &[f64],
        _new_multipliers: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        if self.workspace.stored_at != z {
            self.evaluate_steps(z, None);
        }
        values.fill(0.0);
        self.start_from(z);
        let Self { functions, layout, initial, grid, workspace, .. } = self;
        let ShootingWorkspace { hessian, evaluator, store, .. } = workspace;
        let steps = grid.steps();
        let rows = Rows { layout: *layout, initial, vector: z };
        let running_factor = objective_factor * grid.running_weight();
        let blocks = Block::cover(steps);
        for (block, stored) in blocks.zip(store.blocks_mut()) {
            let computed = evaluator.step_hessian(
                functions,
                block,
                grid.step_s(),
                |k| rows.control(k),
                |k| &multipliers[layout.defect(k)],
                &stored,
            );
            for (lane, node) in block.items() {
                let entry = |slot| hessian.entry(node, slot);
                scatter(values, &hessian.step, entry, |index| lanes(computed, index)[lane]);
            }

            let workspace = &mut evaluator.running.second;
            load_running(workspace, functions, block, rows, grid.step_s());
            workspace.input_mut(RUNNING_WEIGHT).fill(running_factor);
            functions.running.second.evaluate_block(workspace);
            let computed = workspace.output(0);
            for (lane, node) in block.items() {
                let entry = |slot| hessian.entry(node, slot);
                scatter(values, &hessian.running, entry, |index| lanes(computed, index)[lane]);
            }

            let workspace = &mut evaluator.path.second;
            block.load(workspace.input_mut(0), functions.states, |k| rows.state(k + 1));
            block.load(workspace.input_mut(1), functions.path_bounds.len(), |k| {
                &multipliers[layout.path(k + 1)]
            });
            functions.path.second.evaluate_block(workspace);
            let computed = workspace.output(0);
            for (lane, step) in block.items() {
                let entry = |slot| hessian.entry(step + 1, slot);
                scatter(values, &hessian.path, entry, |index| lanes(computed, index)[lane]);
            }
        }
        if !functions.stage_bounds.is_empty() {
            let stage = &mut evaluator.stage.second;
            for block in Block::cover(steps) {
                load_stage(stage, functions, block, rows, grid.step_s());
                block.load(stage.input_mut(STAGE_WEIGHTS), functions.stage_bounds.len(), |k| {
                    &multipliers[layout.stage(k)]
                });
                functions.stage.second.evaluate_block(stage);
                let computed = stage.output(0);
                for (lane, step) in block.items() {
                    let entry = |slot| hessian.entry(step, slot);
                    scatter(values, &hessian.stage, entry, |index| lanes(computed, index)[lane]);
                }
            }
        }
        let mut add_terminal = |function: &NodeFunction,
                                workspace: &mut NodeWorkspace,
                                map: &Scatter,
                                weights: &[f64]| {
            let workspace = &mut workspace.second;
            load_terminal(workspace, rows.state(steps));
            for (lanes, &weight) in
                workspace.input_mut(1).chunks_exact_mut(righting_symbolic::LANES).zip(weights)
            {
                lanes.fill(weight);
            }
            function.second.evaluate_block(workspace);
            let computed = workspace.output(0);
            let entry = |slot| hessian.entry(steps, slot);
            scatter(values, map, entry, |index| lanes(computed, index)[0]);
        };
        add_terminal(
            &functions.terminal_cost,
            &mut evaluator.terminal_cost,
            &hessian.terminal_cost,
            &[objective_factor],
        );
        add_terminal(
            &functions.terminal,
            &mut evaluator.terminal,
            &hessian.terminal,
            &multipliers[layout.terminal()],
        );
        Ok(())
    }
}
