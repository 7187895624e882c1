use righting_nlp::{Iteration, OptimalityResiduals, ReducedHessian, Status, Timing};

use crate::attempt::{Attempt, UsedLinearSolver};
use crate::primal_dual_point::PrimalDualPoint;
use crate::samples::Samples;
use crate::settings::Optimizer;

/// What a solve ended with, converged or not.
#[derive(Debug, Clone)]
pub struct OcpSolution {
    /// How the optimizer ended; where the residuals were [judged](crate::Settings::judges), what they say.
    pub status: Status,
    /// The residuals of optimality, computed apart from the optimizer, where the settings asked for them and
    /// the problem is defined at the point.
    pub residuals: Option<OptimalityResiduals>,
    /// The objective at the point.
    pub objective: f64,
    /// Largest violation of a constraint or bound.
    pub constraint_violation: f64,
    /// One entry per iteration, the start included.
    pub history: Vec<Iteration>,
    /// Who made the iterations.
    pub optimizer: Optimizer,
    /// What factorised the linear systems.
    pub linear_solver: UsedLinearSolver,
    /// Every attempt that led here, in order: those given up, then the one that this is.
    pub attempts: Vec<Attempt>,
    /// What the optimizer found of the reduced Hessian here, if it looked;
    /// [`MultipleShooting::curvature`](crate::MultipleShooting::curvature) looks at any point.
    pub reduced_hessian: Option<ReducedHessian>,
    /// All states of the problem at the nodes 0…N.
    pub states: Samples,
    /// The controls of the steps 0…N−1.
    pub controls: Samples,
    /// The point with its multipliers, for a warm start.
    pub point: PrimalDualPoint,
    /// Where the time went.
    pub timing: Timing,
}

impl OcpSolution {
    /// Number of iterations; the start is not one.
    pub fn iterations(&self) -> usize {
        self.history.last().map_or(0, |last| last.iteration)
    }
}
