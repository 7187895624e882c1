use righting_symbolic::LANES;

use crate::rk4::STAGES;
use crate::stage_functions::StageFunctions;

/// What the Hessian of a step reuses from its Jacobian: the stage points y_1, y_2, … and the varying
/// entries of J_1, J_2, …, lanes side by side.
#[derive(Clone)]
pub(crate) struct StageStore {
    points: Vec<f64>,
    jacobians: Vec<f64>,
    stages: usize,
    point_width: usize,
    jacobian_width: usize,
}

impl StageStore {
    pub(crate) fn new(functions: &StageFunctions, blocks: usize) -> Self {
        let point_width = functions.states * LANES;
        let jacobian_width = functions.ode.jacobian.varying() * LANES;
        let stages = functions.step.substeps.get() * STAGES;
        Self {
            stages,
            points: vec![0.0; blocks * stages * point_width],
            jacobians: vec![0.0; blocks * stages * jacobian_width],
            point_width,
            jacobian_width,
        }
    }

    /// Makes room for so many blocks.
    pub(crate) fn resize(&mut self, blocks: usize) {
        self.points.resize(blocks * self.stages * self.point_width, 0.0);
        self.jacobians.resize(blocks * self.stages * self.jacobian_width, 0.0);
    }

    /// Points and Jacobians of the stages of each block.
    pub(crate) fn blocks_mut(&mut self) -> impl Iterator<Item = StageStoreBlock<'_>> {
        let Self { stages, point_width, jacobian_width, .. } = *self;
        // A state-independent ẋ has no varying Jacobian: its chunks are empty, not missing.
        let mut jacobians = self.jacobians.as_mut_slice();
        self.points.chunks_exact_mut(stages * point_width).map(move |points| {
            let (head, tail) = std::mem::take(&mut jacobians).split_at_mut(stages * jacobian_width);
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
    /// Number of stages of one integration step.
    pub(crate) fn stages(&self) -> usize {
        self.points.len() / self.point_width
    }

    pub(crate) fn point(&self, stage: usize) -> &[f64] {
        &self.points[stage * self.point_width..][..self.point_width]
    }

    pub(crate) fn point_mut(&mut self, stage: usize) -> &mut [f64] {
        &mut self.points[stage * self.point_width..][..self.point_width]
    }

    pub(crate) fn jacobian(&self, stage: usize) -> &[f64] {
        &self.jacobians[stage * self.jacobian_width..][..self.jacobian_width]
    }

    pub(crate) fn jacobian_mut(&mut self, stage: usize) -> &mut [f64] {
        &mut self.jacobians[stage * self.jacobian_width..][..self.jacobian_width]
    }
}
