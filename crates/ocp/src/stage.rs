use righting_symbolic::{Backend, Expr, Function, SparseMatrix, hessian_lower, jacobian};

use crate::block::lanes;
use crate::error::OcpError;
use crate::passive::active_states;
use crate::problem::{ControlProblem, Interval};
use crate::rk4::STAGES;
use crate::step::StepFunctions;

/// A matrix output of a compiled function: its structure, the entries that are constant, and where
/// the values that the function computes belong.
#[derive(Debug, Clone)]
pub(crate) struct MatrixOutput {
    /// Row and column of each structural entry, sorted by row, then by column.
    pub(crate) entries: Vec<(usize, usize)>,
    /// The constant of each entry, `None` where the function computes it.
    pub(crate) constants: Vec<Option<f64>>,
}

impl MatrixOutput {
    pub(crate) fn of(matrix: &SparseMatrix) -> Self {
        Self {
            entries: matrix.sparsity().iter().collect(),
            constants: matrix.values.iter().map(|value| value.as_constant()).collect(),
        }
    }

    /// Row, column and value of every entry at one point: the constants, and what the function has
    /// computed in one lane of its output.
    pub(crate) fn at_lane<'a>(
        &'a self,
        computed: &'a [f64],
        lane: usize,
    ) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
        let mut varying = 0;
        self.entries.iter().zip(&self.constants).map(move |(&(row, column), constant)| {
            let value = constant.unwrap_or_else(|| {
                varying += 1;
                lanes(computed, varying - 1)[lane]
            });
            (row, column, value)
        })
    }

    /// How many values the function computes.
    pub(crate) fn varying(&self) -> usize {
        self.constants.iter().filter(|constant| constant.is_none()).count()
    }
}

/// The values of a matrix that are not constants.
pub(crate) fn varying(matrix: &SparseMatrix) -> Vec<Expr> {
    matrix.values.iter().copied().filter(|value| value.as_constant().is_none()).collect()
}

/// A function of one node (or step) with its gradient or Jacobian, and the Hessian of its weighted
/// sum.
#[derive(Debug, Clone)]
pub(crate) struct NodeFunction {
    /// Values and first derivatives: ports `value`, `jacobian`.
    pub(crate) first: Function,
    /// Values alone: port `value`.
    pub(crate) value: Function,
    /// Hessian of Σ weight · value: port `hessian`; the weights are the last input.
    pub(crate) second: Function,
    pub(crate) jacobian: MatrixOutput,
    pub(crate) hessian: MatrixOutput,
}

impl NodeFunction {
    fn compile(name: &str, inputs: &[(&str, &[Expr])], values: &[Expr]) -> Result<Self, OcpError> {
        let variables: Vec<Expr> =
            inputs.iter().flat_map(|(_, port)| port.iter().copied()).collect();
        let weights = Expr::symbols("weight", values.len());
        let weighted = values
            .iter()
            .zip(&weights)
            .fold(Expr::constant(0.0), |sum, (&value, &weight)| sum + weight * value);
        let first = jacobian(values, &variables);
        let second = hessian_lower(weighted, &variables);
        let port = |suffix: &str| {
            let builder = Function::builder(&format!("{name}_{suffix}"));
            inputs.iter().fold(builder, |builder, (name, port)| builder.input(name, port))
        };
        Ok(Self {
            value: port("value").output("value", values).build()?,
            first: port("first")
                .output("value", values)
                .output("jacobian", &varying(&first))
                .build()?,
            second: port("second")
                .input("weight", &weights)
                .output("hessian", &varying(&second))
                .build()?,
            jacobian: MatrixOutput::of(&first),
            hessian: MatrixOutput::of(&second),
        })
    }

    fn functions_mut(&mut self) -> [&mut Function; 3] {
        [&mut self.first, &mut self.value, &mut self.second]
    }
}

/// Everything about a [`ControlProblem`] that does not depend on the grid, the start or the bounds'
/// values: traced once, differentiated exactly, compiled for batches of stages.
#[derive(Debug, Clone)]
pub struct StageFunctions {
    pub(crate) states: usize,
    pub(crate) controls: usize,
    /// The states that cost, constraints or other such states depend on, in the problem's order.
    pub(crate) active: Vec<usize>,
    pub(crate) all_states: usize,
    /// ẋ of every state; only there when some are passive.
    pub(crate) full_ode: Option<Function>,
    pub(crate) ode: NodeFunction,
    pub(crate) step: StepFunctions,
    pub(crate) running: NodeFunction,
    pub(crate) terminal_cost: NodeFunction,
    pub(crate) path: NodeFunction,
    pub(crate) terminal: NodeFunction,
    pub(crate) state_bounds: Interval,
    pub(crate) control_bounds: Interval,
    pub(crate) path_bounds: Interval,
    pub(crate) terminal_bounds: Interval,
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
        let terminal = (problem.terminal)(&all);
        for (what, expected, found) in [
            ("dynamics", problem.states, rates.len()),
            ("path constraints", problem.path_bounds.len(), path.len()),
            ("terminal constraints", problem.terminal_bounds.len(), terminal.len()),
        ] {
            if expected != found {
                return Err(OcpError::Dimension { what, expected, found });
            }
        }
        let running = (problem.running_cost)(&all, &u);
        let terminal_cost = (problem.terminal_cost)(&all);

        let seen: Vec<Expr> = [running, terminal_cost]
            .into_iter()
            .chain(path.iter().copied())
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
        let ode = NodeFunction::compile("ode", &[("x", &x), ("u", &u)], &active_rates)?;
        let on_state = |name, values: &[Expr]| NodeFunction::compile(name, &[("x", &x)], values);
        Ok(Self {
            states: n,
            controls: m,
            all_states: problem.states,
            full_ode,
            step: StepFunctions::compile(n, m, &ode)?,
            running: NodeFunction::compile("running_cost", &[("x", &x), ("u", &u)], &[running])?,
            terminal_cost: on_state("terminal_cost", &[terminal_cost])?,
            path: on_state("path", &path)?,
            terminal: on_state("terminal", &terminal)?,
            state_bounds: Interval::new(
                active.iter().map(|&i| problem.state_bounds.lower[i]).collect(),
                active.iter().map(|&i| problem.state_bounds.upper[i]).collect(),
            ),
            control_bounds: problem.control_bounds.clone(),
            path_bounds: problem.path_bounds.clone(),
            terminal_bounds: problem.terminal_bounds.clone(),
            ode,
            active,
        })
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
        (
            STAGES * count(&self.ode.first) + count(&self.step.first),
            STAGES * count(&self.ode.second)
                + count(&self.step.multipliers)
                + count(&self.step.second),
        )
    }
}
