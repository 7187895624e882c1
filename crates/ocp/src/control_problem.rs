use righting_symbolic::Expr;

use crate::component_bounds::ComponentBounds;
use crate::error::OcpError;

type StageMap = Box<dyn Fn(&[Expr], &[Expr]) -> Vec<Expr>>;
type StageConstraints = Box<dyn Fn(&[Expr], &[Expr], Expr) -> Vec<Expr>>;
type StageCost = Box<dyn Fn(&[Expr], &[Expr], StepTime) -> Expr>;
type NodeMap = Box<dyn Fn(&[Expr]) -> Vec<Expr>>;
type NodeCost = Box<dyn Fn(&[Expr]) -> Expr>;

/// When a step of the grid begins and how long it is. Costs and constraints may depend on it; no derivative is
/// taken by it.
#[derive(Clone, Copy, Debug)]
pub struct StepTime {
    /// t_k, from the beginning of the horizon.
    pub start: Expr,
    /// Δt.
    pub length: Expr,
}

/// An optimal control problem in continuous time, stated once for every grid:
///
/// ```text
/// min  Σ_{k<N} ℓ(x_k, u_k, t_k, Δt) + φ(x_N)
/// s.t. ẋ = f(x, u),  x(0) given but for its free entries,  u constant over each step
///      x_lower ≤ x_k ≤ x_upper,  c_lower ≤ c(x_k) ≤ c_upper     (k = 1…N)
///      u_lower ≤ u_k ≤ u_upper,  s_lower ≤ s(x_k, u_k, Δt) ≤ s_upper   (k = 0…N−1)
///      e_lower ≤ e(x_N) ≤ e_upper
/// ```
///
/// The callables receive symbolic states and controls; generic model code runs on them unchanged.
pub struct ControlProblem {
    pub(crate) states: usize,
    pub(crate) controls: usize,
    pub(crate) dynamics: StageMap,
    pub(crate) running_cost: StageCost,
    pub(crate) terminal_cost: NodeCost,
    pub(crate) path: NodeMap,
    pub(crate) path_bounds: ComponentBounds,
    pub(crate) stage: StageConstraints,
    pub(crate) stage_bounds: ComponentBounds,
    pub(crate) terminal: NodeMap,
    pub(crate) terminal_bounds: ComponentBounds,
    pub(crate) state_bounds: ComponentBounds,
    pub(crate) control_bounds: ComponentBounds,
    pub(crate) keeps_passive_states: bool,
    pub(crate) free_initial_states: Vec<usize>,
}

impl ControlProblem {
    /// A problem with `states` states and `controls` controls that follows `dynamics`, costs
    /// nothing and is not constrained yet. `dynamics(x, u)` returns ẋ, one expression per state.
    pub fn new(
        states: usize,
        controls: usize,
        dynamics: impl Fn(&[Expr], &[Expr]) -> Vec<Expr> + 'static,
    ) -> Self {
        Self {
            states,
            controls,
            dynamics: Box::new(dynamics),
            running_cost: Box::new(|_, _, _| Expr::constant(0.0)),
            terminal_cost: Box::new(|_| Expr::constant(0.0)),
            path: Box::new(|_| Vec::new()),
            path_bounds: ComponentBounds::unbounded(0),
            stage: Box::new(|_, _, _| Vec::new()),
            stage_bounds: ComponentBounds::unbounded(0),
            terminal: Box::new(|_| Vec::new()),
            terminal_bounds: ComponentBounds::unbounded(0),
            state_bounds: ComponentBounds::unbounded(states),
            control_bounds: ComponentBounds::unbounded(controls),
            keeps_passive_states: false,
            free_initial_states: Vec::new(),
        }
    }

    /// Sets the cost `ℓ(x_k, u_k, t_k, Δt)` of every step, in place of an earlier one. The sum carries no
    /// Δt: see [`Grid::running_weight`](crate::Grid::running_weight) for the same problem on another
    /// grid.
    pub fn running_cost(
        mut self,
        cost: impl Fn(&[Expr], &[Expr], StepTime) -> Expr + 'static,
    ) -> Self {
        self.running_cost = Box::new(cost);
        self
    }

    /// Sets the terminal cost `φ(x_N)`, in place of an earlier one.
    pub fn terminal_cost(mut self, cost: impl Fn(&[Expr]) -> Expr + 'static) -> Self {
        self.terminal_cost = Box::new(cost);
        self
    }

    /// Constrains `c(x_k)` at every node after the first, in place of earlier path constraints.
    pub fn path_constraints(
        mut self,
        bounds: ComponentBounds,
        constraints: impl Fn(&[Expr]) -> Vec<Expr> + 'static,
    ) -> Self {
        self.path = Box::new(constraints);
        self.path_bounds = bounds;
        self
    }

    /// Constrains `s(x_k, u_k, Δt)` at the beginning of every step, in place of earlier stage
    /// constraints: what happens within a step follows from the state it starts from, the control that
    /// is held over it and its length Δt, which the callable receives as an expression.
    ///
    /// A component that no control and no free initial state enters is not bounded in the first step.
    pub fn stage_constraints(
        mut self,
        bounds: ComponentBounds,
        constraints: impl Fn(&[Expr], &[Expr], Expr) -> Vec<Expr> + 'static,
    ) -> Self {
        self.stage = Box::new(constraints);
        self.stage_bounds = bounds;
        self
    }

    /// Constrains `e(x_N)`, in place of earlier terminal constraints.
    pub fn terminal_constraints(
        mut self,
        bounds: ComponentBounds,
        constraints: impl Fn(&[Expr]) -> Vec<Expr> + 'static,
    ) -> Self {
        self.terminal = Box::new(constraints);
        self.terminal_bounds = bounds;
        self
    }

    /// Sets the bounds of the states at every node after the first.
    pub fn state_bounds(mut self, bounds: ComponentBounds) -> Self {
        self.state_bounds = bounds;
        self
    }

    /// Sets the bounds of the controls of every step.
    pub fn control_bounds(mut self, bounds: ComponentBounds) -> Self {
        self.control_bounds = bounds;
        self
    }

    /// Transcribes every state, also the passive ones, which no cost, constraint or finite bound depends
    /// on. The optimum is the same. The way there is not: the line search weighs the defects of all
    /// states that are transcribed.
    pub fn keep_passive_states(mut self) -> Self {
        self.keeps_passive_states = true;
        self
    }

    /// Leaves these states' initial values, counted from zero, to the optimizer, within the bounds of the
    /// states. A parameter of the whole problem, such as a duration, is a state whose rate is zero.
    pub fn free_initial_states(mut self, states: &[usize]) -> Self {
        self.free_initial_states = states.to_vec();
        self
    }

    /// Adds `count` states z after those that there are, which follow `rates(x, z, u)` and cost `cost(x_N, z_N)` at the
    /// end beside what there is. Nothing else depends on them, and nothing bounds them.
    pub fn with_more_states(
        self,
        count: usize,
        rates: impl Fn(&[Expr], &[Expr], &[Expr]) -> Vec<Expr> + 'static,
        cost: impl Fn(&[Expr], &[Expr]) -> Expr + 'static,
    ) -> Self {
        let n = self.states;
        let Self { dynamics, running_cost, terminal_cost, path, stage, terminal, .. } = self;
        let mut state_bounds = self.state_bounds;
        state_bounds.lower.resize(n + count, f64::NEG_INFINITY);
        state_bounds.upper.resize(n + count, f64::INFINITY);
        Self {
            states: n + count,
            dynamics: Box::new(move |x, u| {
                let (x, more) = x.split_at(n);
                [dynamics(x, u), rates(x, more, u)].concat()
            }),
            running_cost: Box::new(move |x, u, step| running_cost(&x[..n], u, step)),
            terminal_cost: Box::new(move |x| {
                let (x, more) = x.split_at(n);
                terminal_cost(x) + cost(x, more)
            }),
            path: Box::new(move |x| path(&x[..n])),
            stage: Box::new(move |x, u, h| stage(&x[..n], u, h)),
            terminal: Box::new(move |x| terminal(&x[..n])),
            state_bounds,
            ..self
        }
    }

    pub(crate) fn check(&self) -> Result<(), OcpError> {
        if self.states == 0 {
            return Err(OcpError::NoStates);
        }
        if let Some(&state) = self.free_initial_states.iter().find(|&&state| state >= self.states) {
            let (what, expected) = ("states up to a free one", self.states);
            return Err(OcpError::Dimension { what, expected, found: state + 1 });
        }
        self.state_bounds.check("state bounds", self.states)?;
        self.control_bounds.check("control bounds", self.controls)?;
        self.path_bounds.check("path constraint bounds", self.path_bounds.len())?;
        self.stage_bounds.check("stage constraint bounds", self.stage_bounds.len())?;
        self.terminal_bounds.check("terminal constraint bounds", self.terminal_bounds.len())
    }
}

impl std::fmt::Debug for ControlProblem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ControlProblem")
            .field("states", &self.states)
            .field("controls", &self.controls)
            .field("path_constraints", &self.path_bounds.len())
            .field("stage_constraints", &self.stage_bounds.len())
            .field("terminal_constraints", &self.terminal_bounds.len())
            .finish_non_exhaustive()
    }
}
