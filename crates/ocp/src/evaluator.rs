use std::num::NonZeroUsize;

use righting_symbolic::{LANES, Workspace};

use crate::block::Block;
use crate::node_function::NodeFunction;
use crate::rk4::{RungeKutta4, STAGES};
use crate::stage_functions::StageFunctions;
use crate::stage_store::StageStoreBlock;

/// Ports of [`StepFunctions`](crate::step_functions::StepFunctions), in order.
const STEP_H: usize = 0;
const STEP_JACOBIANS: usize = 1;

/// The workspaces of a [`NodeFunction`].
#[derive(Clone)]
pub(crate) struct NodeWorkspace {
    pub(crate) value: Workspace,
    pub(crate) first: Workspace,
    pub(crate) second: Workspace,
}

impl NodeWorkspace {
    fn new(function: &NodeFunction) -> Self {
        Self {
            value: function.value.workspace(),
            first: function.first.workspace(),
            second: function.second.workspace(),
        }
    }
}

/// Evaluates blocks of steps. One thread owns it; the functions are shared.
#[derive(Clone)]
pub(crate) struct Evaluator {
    pub(crate) ode: NodeWorkspace,
    pub(crate) running: NodeWorkspace,
    pub(crate) path: NodeWorkspace,
    pub(crate) stage: NodeWorkspace,
    pub(crate) terminal_cost: NodeWorkspace,
    pub(crate) terminal: NodeWorkspace,
    step_first: Workspace,
    step_multipliers: Workspace,
    step_second: Workspace,
    states: Vec<f64>,
    method: RungeKutta4,
    /// Runge–Kutta steps in one integration step.
    substeps: NonZeroUsize,
}

impl Evaluator {
    pub(crate) fn new(functions: &StageFunctions) -> Self {
        Self {
            ode: NodeWorkspace::new(&functions.ode),
            running: NodeWorkspace::new(&functions.running),
            path: NodeWorkspace::new(&functions.path),
            stage: NodeWorkspace::new(&functions.stage),
            terminal_cost: NodeWorkspace::new(&functions.terminal_cost),
            terminal: NodeWorkspace::new(&functions.terminal),
            step_first: functions.step.first.workspace(),
            step_multipliers: functions.step.multipliers.workspace(),
            step_second: functions.step.second.workspace(),
            states: vec![0.0; functions.states * LANES],
            method: RungeKutta4::new(functions.states * LANES),
            substeps: functions.step.substeps,
        }
    }

    /// Index of the port after those of the stages' Jacobians.
    fn step_extra(&self) -> usize {
        STEP_JACOBIANS + self.substeps.get() * STAGES
    }

    /// F(x_k, u_k) of a block, in so many Runge–Kutta steps: one row of lanes per state.
    pub(crate) fn step_values<'a>(
        &mut self,
        functions: &StageFunctions,
        block: Block,
        h: f64,
        substeps: NonZeroUsize,
        state: impl Fn(usize) -> &'a [f64],
        control: impl Fn(usize) -> &'a [f64],
    ) -> &[f64] {
        let workspace = &mut self.ode.value;
        block.load(&mut self.states, functions.states, state);
        block.load(workspace.input_mut(1), functions.controls, control);
        for _ in 0..substeps.get() {
            let next = self.method.step(h / substeps.get() as f64, &self.states, |stage| {
                stage.write_point(workspace.input_mut(0));
                functions.ode.value.evaluate_block(workspace);
                stage.set_rates(workspace.output(0));
            });
            self.states.copy_from_slice(next);
        }
        &self.states
    }

    /// The varying entries of −∂F/∂(x, u) of a block, one row of lanes each.
    pub(crate) fn step_jacobian<'a>(
        &mut self,
        functions: &StageFunctions,
        block: Block,
        h: f64,
        state: impl Fn(usize) -> &'a [f64],
        control: impl Fn(usize) -> &'a [f64],
        store: &mut StageStoreBlock<'_>,
    ) -> &[f64] {
        let workspace = &mut self.ode.first;
        block.load(&mut self.states, functions.states, state);
        block.load(workspace.input_mut(1), functions.controls, control);
        let h = h / self.substeps.get() as f64;
        self.step_first.input_mut(STEP_H).fill(h);
        for substep in 0..self.substeps.get() {
            let first = substep * STAGES;
            let next = self.method.step(h, &self.states, |stage| {
                stage.write_point(workspace.input_mut(0));
                store.point_mut(first + stage.index()).copy_from_slice(workspace.input_mut(0));
                functions.ode.first.evaluate_block(workspace);
                stage.set_rates(workspace.output(0));
                store.jacobian_mut(first + stage.index()).copy_from_slice(workspace.output(1));
            });
            self.states.copy_from_slice(next);
        }
        load_jacobians(&mut self.step_first, store);
        functions.step.first.evaluate_block(&mut self.step_first);
        self.step_first.output(0)
    }

    /// What [`step_jacobian`](Self::step_jacobian) computed last, and F(x_k, u_k): one row of lanes per state.
    pub(crate) fn linearization(&self) -> (&[f64], &[f64]) {
        (self.step_first.output(0), &self.states)
    }

    /// The varying entries of ∇²(λᵀ(x⁺ − F)) of a block, one row of lanes each, at the point where
    /// [`Self::step_jacobian`] filled `store`.
    pub(crate) fn step_hessian<'a>(
        &mut self,
        functions: &StageFunctions,
        block: Block,
        h: f64,
        control: impl Fn(usize) -> &'a [f64],
        multiplier: impl Fn(usize) -> &'a [f64],
        store: &StageStoreBlock<'_>,
    ) -> &[f64] {
        let h = h / self.substeps.get() as f64;
        let extra = self.step_extra();
        let adjoint = &mut self.step_multipliers;
        adjoint.input_mut(STEP_H).fill(h);
        load_jacobians(adjoint, store);
        let lambda = adjoint.input_mut(extra);
        block.load(lambda, functions.states, multiplier);
        lambda.iter_mut().for_each(|lambda| *lambda = -*lambda);
        functions.step.multipliers.evaluate_block(adjoint);

        let workspace = &mut self.ode.second;
        let compose = &mut self.step_second;
        compose.input_mut(STEP_H).fill(h);
        load_jacobians(compose, store);
        block.load(workspace.input_mut(1), functions.controls, control);
        for stage in 0..store.stages() {
            workspace.input_mut(0).copy_from_slice(store.point(stage));
            workspace.input_mut(2).copy_from_slice(adjoint.output(stage));
            functions.ode.second.evaluate_block(workspace);
            compose.input_mut(extra + stage).copy_from_slice(workspace.output(0));
        }
        functions.step.second.evaluate_block(compose);
        compose.output(0)
    }
}

fn load_jacobians(workspace: &mut Workspace, store: &StageStoreBlock<'_>) {
    for stage in 0..store.stages() {
        workspace.input_mut(STEP_JACOBIANS + stage).copy_from_slice(store.jacobian(stage));
    }
}
