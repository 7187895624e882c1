use righting_symbolic::{LANES, Workspace};

use crate::block::Block;
use crate::rk4::{NODE, STAGES, WEIGHT};
use crate::stage::{NodeFunction, StageFunctions};

/// Ports of [`StepFunctions`](crate::step::StepFunctions), in order.
const STEP_H: usize = 0;
const STEP_JACOBIANS: usize = 1;
const STEP_EXTRA: usize = STEP_JACOBIANS + STAGES;

/// The workspaces of a [`NodeFunction`].
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

/// What the Hessian of a step reuses from its Jacobian: the stage points y_1…y_4 and the varying
/// entries of J_1…J_4, lanes side by side.
pub(crate) struct StageStore {
    points: Vec<f64>,
    jacobians: Vec<f64>,
    point_width: usize,
    jacobian_width: usize,
}

impl StageStore {
    pub(crate) fn new(functions: &StageFunctions, blocks: usize) -> Self {
        let point_width = functions.states * LANES;
        let jacobian_width = functions.ode.jacobian.varying() * LANES;
        Self {
            points: vec![0.0; blocks * STAGES * point_width],
            jacobians: vec![0.0; blocks * STAGES * jacobian_width],
            point_width,
            jacobian_width,
        }
    }

    /// Points and Jacobians of the stages of each block.
    pub(crate) fn blocks_mut(&mut self) -> impl Iterator<Item = StageStoreBlock<'_>> {
        let (point_width, jacobian_width) = (self.point_width, self.jacobian_width);
        // A state-independent ẋ has no varying Jacobian: its chunks are empty, not missing.
        let mut jacobians = self.jacobians.as_mut_slice();
        self.points.chunks_exact_mut(STAGES * point_width).map(move |points| {
            let (head, tail) = std::mem::take(&mut jacobians).split_at_mut(STAGES * jacobian_width);
            jacobians = tail;
            StageStoreBlock { points, jacobians: head, point_width, jacobian_width }
        })
    }
}

/// The part of a [`StageStore`] that belongs to one block.
pub(crate) struct StageStoreBlock<'a> {
    points: &'a mut [f64],
    jacobians: &'a mut [f64],
    point_width: usize,
    jacobian_width: usize,
}

impl StageStoreBlock<'_> {
    fn point(&self, stage: usize) -> &[f64] {
        &self.points[stage * self.point_width..][..self.point_width]
    }

    fn point_mut(&mut self, stage: usize) -> &mut [f64] {
        &mut self.points[stage * self.point_width..][..self.point_width]
    }

    fn jacobian(&self, stage: usize) -> &[f64] {
        &self.jacobians[stage * self.jacobian_width..][..self.jacobian_width]
    }

    fn jacobian_mut(&mut self, stage: usize) -> &mut [f64] {
        &mut self.jacobians[stage * self.jacobian_width..][..self.jacobian_width]
    }
}

/// Evaluates blocks of steps. One thread owns it; the functions are shared.
pub(crate) struct Worker {
    pub(crate) ode: NodeWorkspace,
    pub(crate) running: NodeWorkspace,
    pub(crate) path: NodeWorkspace,
    pub(crate) terminal_cost: NodeWorkspace,
    pub(crate) terminal: NodeWorkspace,
    step_first: Workspace,
    step_multipliers: Workspace,
    step_second: Workspace,
    states: Vec<f64>,
    rates: Vec<f64>,
    next: Vec<f64>,
}

impl Worker {
    pub(crate) fn new(functions: &StageFunctions) -> Self {
        Self {
            ode: NodeWorkspace::new(&functions.ode),
            running: NodeWorkspace::new(&functions.running),
            path: NodeWorkspace::new(&functions.path),
            terminal_cost: NodeWorkspace::new(&functions.terminal_cost),
            terminal: NodeWorkspace::new(&functions.terminal),
            step_first: functions.step.first.workspace(),
            step_multipliers: functions.step.multipliers.workspace(),
            step_second: functions.step.second.workspace(),
            states: vec![0.0; functions.states * LANES],
            rates: vec![0.0; functions.states * LANES],
            next: vec![0.0; functions.states * LANES],
        }
    }

    /// F(x_k, u_k) of a block: one row of lanes per state.
    pub(crate) fn step_values<'a>(
        &mut self,
        functions: &StageFunctions,
        block: Block,
        h: f64,
        state: impl Fn(usize) -> &'a [f64],
        control: impl Fn(usize) -> &'a [f64],
    ) -> &[f64] {
        let workspace = &mut self.ode.value;
        block.load(&mut self.states, functions.states, state);
        block.load(workspace.input_mut(1), functions.controls, control);
        self.next.copy_from_slice(&self.states);
        for (node, weight) in NODE.into_iter().zip(WEIGHT) {
            advance(workspace, &self.states, node * h, &self.rates);
            functions.ode.value.evaluate_block(workspace);
            self.rates.copy_from_slice(workspace.output(0));
            add_scaled(&mut self.next, weight * h, &self.rates);
        }
        &self.next
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
        self.step_first.input_mut(STEP_H).fill(h);
        for (stage, node) in NODE.into_iter().enumerate() {
            advance(workspace, &self.states, node * h, &self.rates);
            store.point_mut(stage).copy_from_slice(workspace.input_mut(0));
            functions.ode.first.evaluate_block(workspace);
            self.rates.copy_from_slice(workspace.output(0));
            store.jacobian_mut(stage).copy_from_slice(workspace.output(1));
        }
        load_jacobians(&mut self.step_first, store);
        functions.step.first.evaluate_block(&mut self.step_first);
        self.step_first.output(0)
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
        let adjoint = &mut self.step_multipliers;
        adjoint.input_mut(STEP_H).fill(h);
        load_jacobians(adjoint, store);
        let lambda = adjoint.input_mut(STEP_EXTRA);
        block.load(lambda, functions.states, multiplier);
        lambda.iter_mut().for_each(|lambda| *lambda = -*lambda);
        functions.step.multipliers.evaluate_block(adjoint);

        let workspace = &mut self.ode.second;
        let compose = &mut self.step_second;
        compose.input_mut(STEP_H).fill(h);
        load_jacobians(compose, store);
        block.load(workspace.input_mut(1), functions.controls, control);
        for stage in 0..STAGES {
            workspace.input_mut(0).copy_from_slice(store.point(stage));
            workspace.input_mut(2).copy_from_slice(adjoint.output(stage));
            functions.ode.second.evaluate_block(workspace);
            compose.input_mut(STEP_EXTRA + stage).copy_from_slice(workspace.output(0));
        }
        functions.step.second.evaluate_block(compose);
        compose.output(0)
    }
}

/// Sets the state port to `states + scale · rates`.
fn advance(workspace: &mut Workspace, states: &[f64], scale: f64, rates: &[f64]) {
    let point = workspace.input_mut(0);
    point.copy_from_slice(states);
    if scale != 0.0 {
        add_scaled(point, scale, rates);
    }
}

fn add_scaled(sum: &mut [f64], scale: f64, terms: &[f64]) {
    for (sum, &term) in sum.iter_mut().zip(terms) {
        *sum += scale * term;
    }
}

fn load_jacobians(workspace: &mut Workspace, store: &StageStoreBlock<'_>) {
    for stage in 0..STAGES {
        workspace.input_mut(STEP_JACOBIANS + stage).copy_from_slice(store.jacobian(stage));
    }
}
