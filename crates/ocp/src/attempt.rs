use std::time::Duration;

use righting_nlp::Status;

use crate::settings::Optimizer;

/// One attempt to solve a program on one grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Attempt {
    /// Number of steps of the grid.
    pub steps: usize,
    /// Who made the iterations.
    pub optimizer: Optimizer,
    /// What factorised the linear systems.
    pub linear_solver: UsedLinearSolver,
    /// How it ended.
    pub end: AttemptEnd,
    /// Number of iterations; the start is not one.
    pub iterations: usize,
    /// Wall time.
    pub time: Duration,
}

/// How an attempt ended.
#[derive(Debug, Clone, PartialEq)]
pub enum AttemptEnd {
    /// With this status.
    Status(Status),
    /// Without an answer, for this reason; another attempt from the same start follows.
    GivenUp(String),
}

/// What factorised the linear systems of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UsedLinearSolver {
    /// MUMPS.
    Mumps,
    /// The stage solver.
    Stage,
    /// The stage solver did not succeed and MUMPS solved the problem again from its start.
    MumpsAfterStage,
}
