use righting_interior::Solved;
use righting_ipopt::{Control, Iteration, Multipliers, Options, SolveError, Status};

use crate::error::OcpError;
use crate::kkt::{NodeDims, StageDims, StageKkt};
use crate::nlp::MultipleShooting;
use crate::point::Point;
use crate::problem::Interval;
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

/// Who makes the iterations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Optimizer {
    /// [`righting_interior`], and Ipopt from the start where that gives up; with
    /// [`LinearSolver::Mumps`] Ipopt alone.
    #[default]
    Auto,
    /// Ipopt alone.
    Ipopt,
}

/// Who made the iterations of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UsedOptimizer {
    /// [`righting_interior`].
    Interior,
    /// Ipopt.
    Ipopt,
}

/// How to solve.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Ipopt's options, of either optimizer. Steps of the stage solver are taken as they are
    /// ([`Options::fast_step_computation`]), whatever stands there.
    pub ipopt: Options,
    /// Who makes the iterations.
    pub optimizer: Optimizer,
    /// What factorises the linear systems.
    pub linear_solver: LinearSolver,
    /// Whether [`LinearSolver::Auto`] tries MUMPS too when the stage solver has used up its
    /// iterations. Default true; false for one start of many.
    pub retry_at_iteration_limit: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            ipopt: Options::default(),
            optimizer: Optimizer::Auto,
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
        // Blocks of dense factors leave residuals near rounding: over the shipped maneuvers Ipopt's
        // check of every step changes no iteration and takes a quarter of the time. Where it would
        // have mattered, MUMPS solves again with it.
        let options = Options { fast_step_computation: true, ..settings.ipopt.clone() };
        let retry = settings.linear_solver == LinearSolver::Auto;
        let own = match settings.optimizer {
            Optimizer::Auto => self.solve_by_own(start, &options, stage, on_iteration),
            Optimizer::Ipopt => None,
        };
        let stage_solution = match own {
            Some(solution) => solution,
            None => match self.solve_by_ipopt(start, &options, stage, on_iteration) {
                Err(SolveError::LinearSolver(_) | SolveError::NoLinearSolverSlot) if retry => {
                    return self.solve_with_mumps(start, &settings.ipopt, on_iteration);
                }
                outcome => outcome?,
            },
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

    /// The solution of [`righting_interior`]; none where it gives up.
    fn solve_by_own(
        &mut self,
        start: &righting_ipopt::Start,
        options: &Options,
        stage: &mut impl righting_ipopt::LinearSolver,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
    ) -> Option<Solution> {
        let mut history = Vec::new();
        let record = recording(&mut history, on_iteration);
        // Whatever the reason for giving up, Ipopt finds out whether it is the problem's.
        let Solved { solution, curves_upwards } =
            righting_interior::solve(self, options, start, stage, record).ok()?;
        let used = (UsedOptimizer::Interior, UsedLinearSolver::Stage);
        Some(Solution { curves_upwards, ..self.solution(solution, history, used) })
    }

    fn solve_by_ipopt(
        &mut self,
        start: &righting_ipopt::Start,
        options: &Options,
        stage: &mut impl righting_ipopt::LinearSolver,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
    ) -> Result<Solution, SolveError> {
        let mut history = Vec::new();
        let record = recording(&mut history, on_iteration);
        let solution = righting_ipopt::solve_with(self, options, start, stage, record)?;
        let used = (UsedOptimizer::Ipopt, UsedLinearSolver::Stage);
        Ok(self.solution(solution, history, used))
    }

    fn solve_with_mumps(
        &mut self,
        start: &righting_ipopt::Start,
        options: &Options,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
    ) -> Result<Solution, OcpError> {
        let mut history = Vec::new();
        let record = recording(&mut history, on_iteration);
        let solution = righting_ipopt::solve(self, options, start, record)?;
        let used = (UsedOptimizer::Ipopt, UsedLinearSolver::Mumps);
        Ok(self.solution(solution, history, used))
    }

    fn solution(
        &self,
        solution: righting_ipopt::NlpSolution,
        history: Vec<Iteration>,
        (optimizer, linear_solver): (UsedOptimizer, UsedLinearSolver),
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
            optimizer,
            linear_solver,
            curves_upwards: false,
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
}

/// Passes iterations on and keeps them.
fn recording<'a>(
    history: &'a mut Vec<Iteration>,
    on_iteration: &'a mut impl FnMut(&Iteration) -> Control,
) -> impl FnMut(&Iteration) -> Control + 'a {
    |iteration| {
        history.push(*iteration);
        on_iteration(iteration)
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

#[cfg(test)]
mod tests;
