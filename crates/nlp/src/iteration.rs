/// One iteration, as the optimizer reports it. Norms are maximum norms of the scaled problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Counts from zero, the start; the restoration phase counts on.
    pub iteration: usize,
    /// Whether the restoration phase is at work, which minimises the constraint violation.
    pub restoration: bool,
    /// The objective, unscaled.
    pub objective: f64,
    /// Constraint violation.
    pub primal_infeasibility: f64,
    /// Norm of the gradient of the Lagrangian.
    pub dual_infeasibility: f64,
    /// Barrier parameter μ.
    pub mu: f64,
    /// Norm of the primal step, before it was shortened.
    pub step_norm: f64,
    /// What was added to the diagonal of the Hessian to make it convex enough; zero for nothing.
    pub regularization: f64,
    /// The fraction of the step taken in the primal variables.
    pub alpha_primal: f64,
    /// The fraction of the step taken in the bound multipliers.
    pub alpha_dual: f64,
    /// How many step lengths the line search tried.
    pub line_search_trials: usize,
}

/// Whether a solve goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// Go on.
    Continue,
    /// End with [`Status::UserStop`](crate::Status::UserStop), at the current point.
    Stop,
}
