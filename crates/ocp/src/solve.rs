use righting_ipopt::{Control, Iteration, Multipliers, Options, SolveError, Status};

use crate::error::OcpError;
use crate::kkt::{NodeDims, StageDims, StageKkt};
use crate::nlp::MultipleShooting;
use crate::point::Point;
use crate::problem::Interval;
use crate::rk4::{NODE, STAGES, WEIGHT};
use crate::samples::Samples;
use crate::solution::Solution;
use crate::start::Start;

/// What factorises Ipopt's linear systems.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LinearSolver {
    /// The stage solver, and MUMPS where it does not succeed.
    #[default]
    Auto,
    /// MUMPS, the general sparse solver that comes with Ipopt.
    Mumps,
    /// The stage solver alone.
    Stage,
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

/// How to solve.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Ipopt's options. Steps of the stage solver are taken as they are
    /// ([`Options::fast_step_computation`]), whatever stands there.
    pub ipopt: Options,
    /// What factorises its linear systems.
    pub linear_solver: LinearSolver,
    /// Whether [`LinearSolver::Auto`] tries MUMPS too when the stage solver has used up its
    /// iterations. Default true; false for one start of many.
    pub retry_at_iteration_limit: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            ipopt: Options::default(),
            linear_solver: LinearSolver::Auto,
            retry_at_iteration_limit: true,
        }
    }
}

impl MultipleShooting<'_> {
    /// Solves the program from `start`. `on_iteration` sees every iteration and may stop the solve.
    ///
    /// Not converging is a status of the solution, not an error.
    ///
    /// # Errors
    /// [`OcpError::Dimension`] or [`OcpError::NotFinite`] when the start does not fit,
    /// [`OcpError::Solve`] when Ipopt refuses the problem, an option or, without
    /// [`LinearSolver::Auto`], the linear solver.
    pub fn solve(
        &mut self,
        start: &Start,
        settings: &Settings,
        mut on_iteration: impl FnMut(&Iteration) -> Control,
    ) -> Result<Solution, OcpError> {
        let start = self.ipopt_start(start)?;
        if settings.linear_solver == LinearSolver::Mumps {
            return self.solve_with_mumps(&start, &settings.ipopt, &mut on_iteration);
        }
        let mut stage = StageKkt::new(&self.stage_dims()).stop_at_excess();
        self.solve_in_stages(&start, settings, &mut stage, &mut on_iteration)
    }

    /// Solves with `stage`, and where that does not succeed with MUMPS if the settings allow.
    fn solve_in_stages(
        &mut self,
        start: &righting_ipopt::Start,
        settings: &Settings,
        stage: &mut impl righting_ipopt::LinearSolver,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
    ) -> Result<Solution, OcpError> {
        let mut history = Vec::new();
        // Blocks of dense factors leave residuals near rounding: over the shipped maneuvers Ipopt's
        // check of every step changes no iteration and takes a quarter of the time. Where it would
        // have mattered, MUMPS solves again with it.
        let options = Options { fast_step_computation: true, ..settings.ipopt.clone() };
        let outcome = righting_ipopt::solve_with(self, &options, start, stage, |iteration| {
            history.push(*iteration);
            on_iteration(iteration)
        });
        let retry = settings.linear_solver == LinearSolver::Auto;
        let stage_solution = match outcome {
            Ok(solution) => self.solution(solution, history, UsedLinearSolver::Stage),
            Err(SolveError::LinearSolver(_) | SolveError::NoLinearSolverSlot) if retry => {
                return self.solve_with_mumps(start, &settings.ipopt, on_iteration);
            }
            Err(error) => return Err(error.into()),
        };
        let may_help = match stage_solution.status {
            Status::IterationLimit => settings.retry_at_iteration_limit,
            status => may_be_the_linear_solver(status),
        };
        if !(retry && may_help) {
            return Ok(stage_solution);
        }
        let again = self.solve_with_mumps(start, &settings.ipopt, on_iteration)?;
        Ok(Solution { linear_solver: UsedLinearSolver::MumpsAfterStage, ..again })
    }

    fn solve_with_mumps(
        &mut self,
        start: &righting_ipopt::Start,
        options: &Options,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
    ) -> Result<Solution, OcpError> {
        let mut history = Vec::new();
        let solution = righting_ipopt::solve(self, options, start, |iteration| {
            history.push(*iteration);
            on_iteration(iteration)
        })?;
        Ok(self.solution(solution, history, UsedLinearSolver::Mumps))
    }

    fn solution(
        &self,
        solution: righting_ipopt::Solution,
        history: Vec<Iteration>,
        linear_solver: UsedLinearSolver,
    ) -> Solution {
        let point = Point {
            layout: self.layout(),
            z: solution.x,
            constraints: solution.multipliers.constraints,
            lower: solution.multipliers.lower,
            upper: solution.multipliers.upper,
        };
        let (states, controls) = self.trajectory(&point);
        Solution {
            status: solution.status,
            objective: solution.objective,
            constraint_violation: solution.constraint_violation,
            history,
            linear_solver,
            states,
            controls,
            point,
            timing: solution.timing,
        }
    }

    /// What the stage solver needs to know: a constraint held between equal bounds is an equality
    /// to Ipopt and has no slack.
    pub(crate) fn stage_dims(&self) -> StageDims {
        let (functions, dimensions) = (self.functions(), self.layout().dimensions());
        let equalities = |bounds: &Interval| {
            bounds.lower.iter().zip(&bounds.upper).filter(|(lower, upper)| lower == upper).count()
        };
        let path = equalities(&functions.path_bounds);
        let terminal = equalities(&functions.terminal_bounds);
        let inner = NodeDims {
            states: dimensions.states,
            controls: dimensions.controls,
            equalities: path,
            inequalities: dimensions.path - path,
        };
        let mut nodes = vec![inner; dimensions.steps + 1];
        nodes[0] = NodeDims { controls: dimensions.controls, ..NodeDims::default() };
        nodes[dimensions.steps] = NodeDims {
            controls: 0,
            equalities: path + terminal,
            inequalities: inner.inequalities + dimensions.terminal - terminal,
            ..inner
        };
        StageDims::new(nodes)
    }

    fn ipopt_start(&self, start: &Start) -> Result<righting_ipopt::Start, OcpError> {
        match start {
            Start::Guess(guess) => Ok(righting_ipopt::Start::at(self.decision_vector(guess)?)),
            Start::Warm(point) if point.layout == self.layout() => Ok(righting_ipopt::Start {
                x: point.z.clone(),
                multipliers: Some(Multipliers {
                    constraints: point.constraints.clone(),
                    lower: point.lower.clone(),
                    upper: point.upper.clone(),
                }),
            }),
            Start::Warm(point) => Err(OcpError::Dimension {
                what: "warm start",
                expected: self.layout().variables(),
                found: point.z.len(),
            }),
        }
    }

    /// All states at the nodes 0…N and the controls of the steps 0…N−1 of a point on this grid. The
    /// passive states are integrated along the trajectory with the same steps.
    pub fn trajectory(&self, point: &Point) -> (Samples, Samples) {
        let z = &point.z;
        let (functions, layout, steps) = (self.functions(), self.layout(), self.grid().steps());
        let mut states = Samples::new(functions.all_states);
        let mut controls = Samples::new(functions.controls);
        let mut state = self.full_initial_state().to_vec();
        states.push(&state);
        let mut integrator = functions.full_ode.as_ref().map(FullStep::new);
        for step in 0..steps {
            let control = &z[layout.control(step)];
            if let Some(integrator) = &mut integrator {
                integrator.advance(&mut state, control, self.grid().step_s());
            }
            for (&target, &value) in functions.active.iter().zip(&z[layout.state(step + 1)]) {
                state[target] = value;
            }
            states.push(&state);
            controls.push(control);
        }
        (states, controls)
    }
}

/// Whether a solve that ended so might succeed with another factorisation.
fn may_be_the_linear_solver(status: Status) -> bool {
    !status.is_success()
        && !matches!(
            status,
            Status::UserStop
                | Status::IterationLimit
                | Status::CpuTimeLimit
                | Status::WallTimeLimit
                | Status::TooFewDegreesOfFreedom
        )
}

/// One integration step of all states.
struct FullStep<'f> {
    ode: &'f righting_symbolic::Function,
    workspace: righting_symbolic::Workspace,
    point: Vec<f64>,
    rates: Vec<f64>,
    next: Vec<f64>,
}

impl<'f> FullStep<'f> {
    fn new(ode: &'f righting_symbolic::Function) -> Self {
        let states = ode.input_ports()[0].len();
        let zeros = vec![0.0; states];
        Self {
            ode,
            workspace: ode.workspace(),
            point: zeros.clone(),
            rates: zeros.clone(),
            next: zeros,
        }
    }

    fn advance(&mut self, state: &mut [f64], control: &[f64], h: f64) {
        self.next.copy_from_slice(state);
        for stage in 0..STAGES {
            for ((point, &start), &rate) in self.point.iter_mut().zip(&*state).zip(&self.rates) {
                *point = if stage == 0 { start } else { start + NODE[stage] * h * rate };
            }
            let inputs = [self.point.as_slice(), control];
            self.ode.evaluate(&mut self.workspace, &inputs, &mut [&mut self.rates]);
            for (next, &rate) in self.next.iter_mut().zip(&self.rates) {
                *next += WEIGHT[stage] * h * rate;
            }
        }
        state.copy_from_slice(&self.next);
    }
}

#[cfg(test)]
mod tests;
