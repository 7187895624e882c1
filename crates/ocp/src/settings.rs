use righting_nlp::Options;

/// How to solve.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Ipopt's options, of either optimizer. MUMPS and [`Optimizer::Interior`] have their own way with
    /// [`Options::fast_step_computation`]: MUMPS's steps are always refined, the interior solver's never.
    pub ipopt: Options,
    /// Who makes the iterations.
    pub optimizer: Optimizer,
    /// What factorises the linear systems.
    pub linear_solver: LinearSolverChoice,
    /// Whether [`LinearSolverChoice::Auto`] tries MUMPS too when the stage solver has used up its
    /// iterations. Default true; false for one start of many.
    pub retry_at_iteration_limit: bool,
    /// Whether the residuals of optimality are computed again after the solve, apart from the optimizer, and
    /// decide on its status. Default false: what is a start for another solve needs no proof.
    pub judges: bool,
    /// Whether [`Optimizer::Interior`] looks at the reduced Hessian of its solution. Default true; false saves a
    /// factorisation.
    pub examines_curvature: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            ipopt: Options::default(),
            optimizer: Optimizer::Ipopt,
            linear_solver: LinearSolverChoice::Auto,
            retry_at_iteration_limit: true,
            judges: false,
            examines_curvature: true,
        }
    }
}

/// Who makes the iterations, or made them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Optimizer {
    /// Ipopt.
    #[default]
    Ipopt,
    /// [`righting_interior`], and Ipopt from the same start where that gives up. It solves with the
    /// stage solver only: with [`LinearSolverChoice::Mumps`] Ipopt makes the iterations.
    Interior,
}

/// What factorises Ipopt's linear systems.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LinearSolverChoice {
    /// The stage solver, and MUMPS where it does not succeed, unless the problem is infeasible.
    #[default]
    Auto,
    /// MUMPS, the general sparse solver that comes with Ipopt.
    Mumps,
    /// The stage solver alone.
    Stage,
}
