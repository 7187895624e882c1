use crate::{Iteration, Multipliers, ReducedHessian, Start, Status, Timing};

/// Where a solve ended, however it did.
#[derive(Debug, Clone, PartialEq)]
pub struct NlpSolution {
    /// How it ended.
    pub status: Status,
    /// The variables (n).
    pub x: Vec<f64>,
    /// f(x); NaN where it is not defined.
    pub objective: f64,
    /// g(x) (m); NaN where it is not defined.
    pub g: Vec<f64>,
    /// The multipliers; zero where the optimizer has none, after an error.
    pub multipliers: Multipliers,
    /// How many iterations were made.
    pub iterations: usize,
    /// By how much x and g(x) violate their bounds at most, unscaled. Bounds are relaxed a
    /// little before a solve, see [`Options::bound_relax_factor`](crate::Options::bound_relax_factor).
    pub constraint_violation: f64,
    /// How the Lagrangian curves here along the constraints, if the optimizer looked.
    pub reduced_hessian: Option<ReducedHessian>,
    /// The last iteration, if there was any.
    pub last_iteration: Option<Iteration>,
    /// Where the time went.
    pub timing: Timing,
}

impl NlpSolution {
    /// A warm start from here.
    pub fn to_start(&self) -> Start {
        Start { x: self.x.clone(), multipliers: Some(self.multipliers.clone()) }
    }
}
