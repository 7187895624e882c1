use std::num::NonZeroUsize;

use righting_symbolic::{Backend, Expr, Function};

use crate::component_bounds::ComponentBounds;
use crate::control_problem::{ControlProblem, StepTime};
use crate::error::OcpError;
use crate::node_function::NodeFunction;
use crate::passive::active_states;
use crate::rk4::STAGES;
use crate::step_functions::StepFunctions;

/// Everything about a [`ControlProblem`] that does not depend on the grid, the start or the bounds'
/// values: traced once, differentiated exactly, compiled for batches of stages.
#[derive(Debug, Clone)]
pub struct StageFunctions {
    pub(crate) states: usize,
    pub(crate) controls: usize,
    /// The states that cost, constraints or other such states depend on, in the problem's order.
    pub(crate) active: Vec<usize>,
    pub(crate) all_states: usize,
    /// Those of the active states, counted among them, whose initial values are free, in order.
    pub(crate) free: Vec<usize>,
    /// ẋ of every state; only there when some are passive.
    pub(crate) full_ode: Option<Function>,
    pub(crate) ode: NodeFunction,
    pub(crate) step: StepFunctions,
    /// Of a step; the ports `x` and `u` are followed by its beginning `t` and its length `h`.
    pub(crate) running: NodeFunction,
    pub(crate) terminal_cost: NodeFunction,
    pub(crate) path: NodeFunction,
    /// Of a step; the ports `x` and `u` are followed by its length `h`.
    pub(crate) stage: NodeFunction,
    pub(crate) terminal: NodeFunction,
    pub(crate) state_bounds: ComponentBounds,
    pub(crate) control_bounds: ComponentBounds,
    pub(crate) path_bounds: ComponentBounds,
    pub(crate) stage_bounds: StageBounds,
    pub(crate) terminal_bounds: ComponentBounds,
}

impl StageFunctions {
    /// Traces, differentiates and compiles `problem`.
    ///
    /// States that neither a cost nor a constraint nor a finite bound sees, directly or through
    /// other states, are left out of the transcription and integrated afterwards, unless the problem
    /// [keeps them](ControlProblem::keep_passive_states).
    ///
    /// # Errors
    /// [`OcpError::Dimension`], [`OcpError::CrossedBounds`] or [`OcpError::NoStates`] when the
    /// problem contradicts itself; [`OcpError::Function`] when an expression holds a symbol that
    /// is neither state nor control.
    pub fn compile(problem: &ControlProblem) -> Result<Self, OcpError> {
        problem.check()?;
        righting_symbolic::trace(|| Self::trace(problem))
    }

    fn trace(problem: &ControlProblem) -> Result<Self, OcpError> {
        let all = Expr::symbols("x", problem.states);
        let u = Expr::symbols("u", problem.controls);
        let rates = (problem.dynamics)(&all, &u);
        let path = (problem.path)(&all);
        let h = Expr::symbol("h");
        let stage = (problem.stage)(&all, &u, h);
        let terminal = (problem.terminal)(&all);
        for (what, expected, found) in [
            ("dynamics", problem.states, rates.len()),
            ("path constraints", problem.path_bounds.len(), path.len()),
            ("stage constraints", problem.stage_bounds.len(), stage.len()),
            ("terminal constraints", problem.terminal_bounds.len(), terminal.len()),
        ] {
            if expected != found {
                return Err(OcpError::Dimension { what, expected, found });
            }
        }
        let start = Expr::symbol("t");
        let running = (problem.running_cost)(&all, &u, StepTime { start, length: h });
        let terminal_cost = (problem.terminal_cost)(&all);

        let seen: Vec<Expr> = [running, terminal_cost]
            .into_iter()
            .chain(path.iter().copied())
            .chain(stage.iter().copied())
            .chain(terminal.iter().copied())
            .collect();
        let active = match problem.keeps_passive_states {
            true => (0..problem.states).collect(),
            false => active_states(problem, &all, &rates, &seen),
        };
        let x: Vec<Expr> = active.iter().map(|&i| all[i]).collect();
        let active_rates: Vec<Expr> = active.iter().map(|&i| rates[i]).collect();
        let full_ode = match active.len() == problem.states {
            true => None,
            false => Some(
                Function::builder("full_ode")
                    .input("x", &all)
                    .input("u", &u)
                    .output("value", &rates)
                    .build()?,
            ),
        };

        let (n, m) = (x.len(), u.len());
        let is_free = |&place: &usize| problem.free_initial_states.contains(&active[place]);
        let free: Vec<usize> = (0..n).filter(is_free).collect();
        let ode = NodeFunction::compile("ode", &[("x", &x), ("u", &u)], &active_rates)?;
        let on_state = |name, values: &[Expr]| NodeFunction::compile(name, &[("x", &x)], values);
        let variables: [(&str, &[Expr]); 2] = [("x", &x), ("u", &u)];
        let stage = NodeFunction::with_parameters("stage", &variables, &[("h", &[h])], &stage)?;
        Ok(Self {
            states: n,
            controls: m,
            all_states: problem.states,
            full_ode,
            step: StepFunctions::compile(n, m, &ode, NonZeroUsize::MIN)?,
            running: NodeFunction::with_parameters(
                "running_cost",
                &variables,
                &[("t", &[start]), ("h", &[h])],
                &[running],
            )?,
            terminal_cost: on_state("terminal_cost", &[terminal_cost])?,
            path: on_state("path", &path)?,
            terminal: on_state("terminal", &terminal)?,
            state_bounds: ComponentBounds::new(
                active.iter().map(|&i| problem.state_bounds.lower[i]).collect(),
                active.iter().map(|&i| problem.state_bounds.upper[i]).collect(),
            ),
            control_bounds: problem.control_bounds.clone(),
            path_bounds: problem.path_bounds.clone(),
            stage_bounds: StageBounds::new(&problem.stage_bounds, &stage, |column| {
                column >= n || free.contains(&column)
            }),
            stage,
            terminal_bounds: problem.terminal_bounds.clone(),
            ode,
            active,
            free,
        })
    }

    /// The same functions with each step of the grid integrated by so many Runge–Kutta steps, with the same
    /// control, instead of one.
    ///
    /// # Errors
    /// [`OcpError::Function`] when the composed derivatives cannot be compiled.
    pub fn with_substeps(&self, substeps: NonZeroUsize) -> Result<Self, OcpError> {
        let step = righting_symbolic::trace(|| {
            StepFunctions::compile(self.states, self.controls, &self.ode, substeps)
        })?;
        Ok(Self { step, ..self.clone() })
    }

    /// Runge–Kutta steps in one step of the grid.
    pub fn substeps(&self) -> NonZeroUsize {
        self.step.substeps
    }

    /// The same functions evaluated in another way; `None` if this machine cannot. Values do not
    /// depend on it.
    pub fn with_backend(&self, backend: Backend) -> Option<Self> {
        let mut other = self.clone();
        let nodes = [
            &mut other.ode,
            &mut other.running,
            &mut other.terminal_cost,
            &mut other.path,
            &mut other.stage,
            &mut other.terminal,
        ];
        let functions = nodes.into_iter().flat_map(NodeFunction::functions_mut);
        for function in functions.chain(other.step.functions_mut()).chain(&mut other.full_ode) {
            *function = function.with_backend(backend)?;
        }
        Some(other)
    }

    /// Operations per step and solver iteration: `(Jacobian, Hessian)`.
    pub fn operations_per_step(&self) -> (usize, usize) {
        let count = Function::instruction_count;
        let stages = self.step.substeps.get() * STAGES;
        (
            stages * count(&self.ode.first) + count(&self.step.first),
            stages * count(&self.ode.second)
                + count(&self.step.multipliers)
                + count(&self.step.second),
        )
    }
}

/// The bounds of the stage constraints.
#[derive(Debug, Clone)]
pub(crate) struct StageBounds {
    /// In the first step: a component that no control and no free initial state enters has none.
    first: ComponentBounds,
    later: ComponentBounds,
}

impl StageBounds {
    fn new(
        bounds: &ComponentBounds,
        stage: &NodeFunction,
        is_variable: impl Fn(usize) -> bool,
    ) -> Self {
        let mut first = ComponentBounds::unbounded(bounds.len());
        for &(row, _) in stage.jacobian.entries.iter().filter(|&&(_, column)| is_variable(column)) {
            first.lower[row] = bounds.lower[row];
            first.upper[row] = bounds.upper[row];
        }
        Self { first, later: bounds.clone() }
    }

    pub(crate) fn of_step(&self, step: usize) -> &ComponentBounds {
        if step == 0 { &self.first } else { &self.later }
    }

    pub(crate) fn len(&self) -> usize {
        self.later.len()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.later.is_empty()
    }
}
