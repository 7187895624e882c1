use righting_nlp::{Iteration, Status, Timing};

use crate::point::Point;
use crate::samples::Samples;
use crate::solve::{Attempt, Optimizer, UsedLinearSolver};

/// What a solve ended with, converged or not.
#[derive(Debug, Clone)]
pub struct Solution {
    /// How the optimizer ended.
    pub status: Status,
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
    /// Whether the solve itself found that the Lagrangian curves upwards here, as
    /// [`MultipleShooting::curvature`](crate::MultipleShooting::curvature) does for any point.
    pub curves_upwards: bool,
    /// All states of the problem at the nodes 0…N.
    pub states: Samples,
    /// The controls of the steps 0…N−1.
    pub controls: Samples,
    /// The point with its multipliers, for a warm start.
    pub point: Point,
    /// Where the time went.
    pub timing: Timing,
}

impl Solution {
    /// Number of iterations; the start is not one.
    pub fn iterations(&self) -> usize {
        self.history.last().map_or(0, |last| last.iteration)
    }
}
