use std::time::{Duration, Instant};

/// Where the wall time of a solve went.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Timing {
    /// The whole solve, without waiting for the optimizer to be free.
    pub total: Duration,
    /// Inside the [`Problem`](crate::Problem) and the iteration callback.
    pub evaluation: EvaluationTiming,
    /// Inside the [`LinearSolver`](crate::LinearSolver); `None` with the optimizer's own, whose time is part of
    /// [`Timing::inside_optimizer`].
    pub linear_solver: Option<LinearSolverTiming>,
}

impl Timing {
    /// What is left: the optimizer's own work, its own linear solver included if none was given.
    pub fn inside_optimizer(&self) -> Duration {
        let linear = self.linear_solver.map_or(Duration::ZERO, |timing| timing.total());
        self.total.saturating_sub(self.evaluation.total()).saturating_sub(linear)
    }
}

/// Calls of the [`Problem`](crate::Problem), by method.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct EvaluationTiming {
    /// [`Problem::objective`](crate::Problem::objective).
    pub objective: Tally,
    /// [`Problem::gradient`](crate::Problem::gradient).
    pub gradient: Tally,
    /// [`Problem::constraints`](crate::Problem::constraints).
    pub constraints: Tally,
    /// [`Problem::jacobian`](crate::Problem::jacobian).
    pub jacobian: Tally,
    /// [`Problem::hessian`](crate::Problem::hessian).
    pub hessian: Tally,
    /// The iteration callback.
    pub iteration: Tally,
}

impl EvaluationTiming {
    /// All of them.
    pub fn total(&self) -> Duration {
        self.objective.time
            + self.gradient.time
            + self.constraints.time
            + self.jacobian.time
            + self.hessian.time
            + self.iteration.time
    }
}

/// Calls of the [`LinearSolver`](crate::LinearSolver), by method.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LinearSolverTiming {
    /// [`LinearSolver::analyse`](crate::LinearSolver::analyse).
    pub analyse: Tally,
    /// [`LinearSolver::factor`](crate::LinearSolver::factor).
    pub factor: Tally,
    /// [`LinearSolver::solve`](crate::LinearSolver::solve).
    pub solve: Tally,
}

impl LinearSolverTiming {
    /// All of them.
    pub fn total(&self) -> Duration {
        self.analyse.time + self.factor.time + self.solve.time
    }
}

/// How often something was called and how long that took in all.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Tally {
    /// Number of calls.
    pub calls: usize,
    /// Wall time of all calls.
    pub time: Duration,
}

impl Tally {
    /// Counts a call that began at `start` and ends now.
    pub fn add_since(&mut self, start: Instant) {
        self.calls += 1;
        self.time += start.elapsed();
    }
}
