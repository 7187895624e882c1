use crate::block::Block;
use crate::evaluator::Evaluator;
use crate::kkt::StageKkt;
use crate::stage_functions::StageFunctions;
use crate::stage_store::StageStore;
use crate::structure::{HessianStructure, JacobianStructure};

/// What a [`MultipleShooting`](crate::MultipleShooting) works in. A caller that solves programs of the same functions
/// time and again hands it from one to the next, so that it is made once.
#[derive(Clone)]
pub struct ShootingWorkspace {
    pub(crate) jacobian: JacobianStructure,
    pub(crate) hessian: HessianStructure,
    pub(crate) evaluator: Evaluator,
    pub(crate) store: StageStore,
    /// The decision vector at which `store` was filled.
    pub(crate) stored_at: Vec<f64>,
    /// What solved the last system by stages.
    pub(crate) stages: Option<StageKkt>,
}

impl ShootingWorkspace {
    /// For programs of these functions.
    pub fn new(functions: &StageFunctions) -> Self {
        Self {
            jacobian: JacobianStructure::new(functions, 1),
            hessian: HessianStructure::new(functions, 1),
            evaluator: Evaluator::new(functions),
            store: StageStore::new(functions, 0),
            stored_at: Vec::new(),
            stages: None,
        }
    }

    /// The same for so many steps.
    pub(crate) fn for_steps(mut self, steps: usize) -> Self {
        self.store.resize(Block::count_for(steps));
        // The same point means something else where the program does.
        self.stored_at.clear();
        Self {
            jacobian: self.jacobian.of_steps(steps),
            hessian: self.hessian.of_steps(steps),
            ..self
        }
    }
}
