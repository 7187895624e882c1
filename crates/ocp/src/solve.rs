use std::time::Duration;

use righting_interior::InteriorError;
use righting_ipopt::{Control, Iteration, Multipliers, Options, SolveError, Status};
use righting_nlp::{AugmentedSystem, Declarations, LinearSolver};

use crate::attempt::{Attempt, AttemptEnd, UsedLinearSolver};
use crate::component_bounds::ComponentBounds;
use crate::error::OcpError;
use crate::kkt::{NodeDims, StageDims, StageKkt};
use crate::multiple_shooting::MultipleShooting;
use crate::ocp_solution::OcpSolution;
use crate::ocp_start::OcpStart;
use crate::primal_dual_point::PrimalDualPoint;
use crate::settings::{LinearSolverChoice, Optimizer, Settings};

impl MultipleShooting<'_> {
    /// Solves the program from `start`. `on_iteration` sees every iteration and may stop the solve.
    ///
    /// Not converging is a status of the solution, not an error.
    ///
    /// # Errors
    /// [`OcpError::Dimension`] or [`OcpError::NotFinite`] when the start does not fit,
    /// [`OcpError::Solve`] when Ipopt refuses the problem, an option or, without
    /// [`LinearSolverChoice::Auto`], the linear solver.
    pub fn solve(
        &mut self,
        start: &OcpStart,
        settings: &Settings,
        mut on_iteration: impl FnMut(&Iteration) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        let start = self.ipopt_start(start)?;
        let mut solution = match settings.linear_solver {
            LinearSolverChoice::Mumps => {
                self.solve_with_mumps(&start, &settings.ipopt, &mut on_iteration)?
            }
            LinearSolverChoice::Auto | LinearSolverChoice::Stage => {
                let mut stages = self.stage_solver();
                let solution =
                    self.solve_in_stages(&start, settings, &mut stages, &mut on_iteration);
                self.workspace.stages = Some(stages);
                solution?
            }
        };
        if settings.judges {
            self.judge(&mut solution, &settings.ipopt)?;
        }
        Ok(solution)
    }

    /// Recognises the structure of the linear systems, which the next solve by stages then finds known.
    ///
    /// # Errors
    /// [`OcpError::Solve`] when the stage solver refuses it.
    pub fn prepare(&mut self) -> Result<(), OcpError> {
        let declared = Declarations::of(self).map_err(SolveError::Invalid)?;
        let matrix = AugmentedSystem::new(&declared);
        let mut stages = self.stage_solver();
        stages
            .analyse(matrix.order(), matrix.rows(), matrix.columns())
            .map_err(SolveError::LinearSolver)?;
        self.workspace.stages = Some(stages);
        Ok(())
    }

    /// The stage solver of the last solve, or a new one.
    fn stage_solver(&mut self) -> StageKkt {
        let dims = self.stage_dims();
        match self.workspace.stages.take() {
            Some(known) => known.resized(&dims),
            None => StageKkt::new(&dims).stop_at_excess(),
        }
    }

    /// Solves with `stage`, and where that does not succeed with MUMPS if the settings allow.
    fn solve_in_stages(
        &mut self,
        start: &righting_ipopt::Start,
        settings: &Settings,
        stage: &mut impl righting_ipopt::LinearSolver,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        let options = &settings.ipopt;
        let retry = settings.linear_solver == LinearSolverChoice::Auto;
        let mut given_up = Vec::new();
        let by_interior = match settings.optimizer {
            Optimizer::Interior => {
                self.solve_by_interior(start, settings, stage, on_iteration, &mut given_up)
            }
            Optimizer::Ipopt => None,
        };
        let mut solution = match by_interior {
            Some(solution) => solution,
            None => match self.solve_by_ipopt(start, options, stage, on_iteration) {
                Err(error @ (SolveError::LinearSolver(_) | SolveError::NoLinearSolverSlot(_)))
                    if retry =>
                {
                    given_up.push(self.given_up(Optimizer::Ipopt, &error, 0, Duration::ZERO));
                    self.solve_with_mumps(start, options, on_iteration)?
                }
                outcome => outcome?,
            },
        };
        let may_help = solution.linear_solver == UsedLinearSolver::Stage
            && match solution.status {
                Status::IterationLimit => settings.retry_at_iteration_limit,
                status => may_be_the_linear_solver(status),
            };
        if retry && may_help {
            given_up.append(&mut solution.attempts);
            let again = self.solve_with_mumps(start, options, on_iteration)?;
            solution = OcpSolution { linear_solver: UsedLinearSolver::MumpsAfterStage, ..again };
        }
        solution.attempts.splice(..0, given_up);
        Ok(solution)
    }

    /// The solution of [`righting_interior`]; none where it gives up, whatever the reason: Ipopt finds
    /// out whether it is the problem's.
    fn solve_by_interior(
        &mut self,
        start: &righting_ipopt::Start,
        settings: &Settings,
        stage: &mut impl righting_ipopt::LinearSolver,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
        given_up: &mut Vec<Attempt>,
    ) -> Option<OcpSolution> {
        let mut history = Vec::new();
        let options = Options { fast_step_computation: true, ..settings.ipopt.clone() };
        let record = recording(&mut history, on_iteration);
        let solved = match settings.examines_curvature {
            true => righting_interior::solve(self, &options, start, stage, record),
            false => righting_interior::solve_first_order(self, &options, start, stage, record),
        };
        match solved {
            Ok(solution) => {
                let used = (Optimizer::Interior, UsedLinearSolver::Stage);
                Some(self.solution(solution, history, used))
            }
            Err(InteriorError { reason, iterations, time }) => {
                given_up.push(self.given_up(Optimizer::Interior, &reason, iterations, time));
                None
            }
        }
    }

    fn given_up(
        &self,
        optimizer: Optimizer,
        reason: &dyn std::error::Error,
        iterations: usize,
        time: Duration,
    ) -> Attempt {
        Attempt {
            steps: self.grid().steps(),
            optimizer,
            linear_solver: UsedLinearSolver::Stage,
            end: AttemptEnd::GivenUp(reason.to_string()),
            iterations,
            time,
        }
    }

    fn solve_by_ipopt(
        &mut self,
        start: &righting_ipopt::Start,
        options: &Options,
        stage: &mut impl righting_ipopt::LinearSolver,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
    ) -> Result<OcpSolution, SolveError> {
        let mut history = Vec::new();
        let record = recording(&mut history, on_iteration);
        let solution = righting_ipopt::solve_with(self, options, start, stage, record)?;
        let used = (Optimizer::Ipopt, UsedLinearSolver::Stage);
        Ok(self.solution(solution, history, used))
    }

    fn solve_with_mumps(
        &mut self,
        start: &righting_ipopt::Start,
        options: &Options,
        on_iteration: &mut impl FnMut(&Iteration) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        let mut history = Vec::new();
        // MUMPS is what is left when the stage solver's steps would not do: its own are checked.
        let options = Options { fast_step_computation: false, ..options.clone() };
        let record = recording(&mut history, on_iteration);
        let solution = righting_ipopt::solve(self, &options, start, record)?;
        let used = (Optimizer::Ipopt, UsedLinearSolver::Mumps);
        Ok(self.solution(solution, history, used))
    }

    fn solution(
        &self,
        solution: righting_ipopt::NlpSolution,
        history: Vec<Iteration>,
        (optimizer, linear_solver): (Optimizer, UsedLinearSolver),
    ) -> OcpSolution {
        let point = PrimalDualPoint {
            layout: self.layout(),
            z: solution.x,
            constraints: solution.multipliers.constraints,
            lower: solution.multipliers.lower,
            upper: solution.multipliers.upper,
        };
        let (states, controls) = self.trajectory(&point);
        let attempt = Attempt {
            steps: self.grid().steps(),
            optimizer,
            linear_solver,
            end: AttemptEnd::Status(solution.status),
            iterations: history.last().map_or(0, |last| last.iteration),
            time: solution.timing.total,
        };
        OcpSolution {
            status: solution.status,
            residuals: None,
            objective: solution.objective,
            constraint_violation: solution.constraint_violation,
            history,
            optimizer,
            linear_solver,
            attempts: vec![attempt],
            reduced_hessian: solution.reduced_hessian,
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
        let equalities = |bounds: &ComponentBounds| -> usize {
            bounds.lower.iter().zip(&bounds.upper).filter(|(lower, upper)| lower == upper).count()
        };
        let path = equalities(&functions.path_bounds);
        let terminal = equalities(&functions.terminal_bounds);
        let [first_stage, stage] =
            [0, 1].map(|step| equalities(functions.stage_bounds.of_step(step)));
        let inner = NodeDims {
            states: dimensions.states,
            controls: dimensions.controls,
            equalities: path + stage,
            inequalities: dimensions.path - path + dimensions.stage - stage,
        };
        let mut nodes = vec![inner; dimensions.steps + 1];
        nodes[0] = NodeDims {
            states: dimensions.free,
            controls: dimensions.controls,
            equalities: first_stage,
            inequalities: dimensions.stage - first_stage,
        };
        nodes[dimensions.steps] = NodeDims {
            states: dimensions.states,
            controls: 0,
            equalities: path + terminal,
            inequalities: dimensions.path - path + dimensions.terminal - terminal,
        };
        StageDims::new(nodes)
    }

    fn ipopt_start(&self, start: &OcpStart) -> Result<righting_ipopt::Start, OcpError> {
        match start {
            OcpStart::Guess(guess) => Ok(righting_ipopt::Start::at(self.decision_vector(guess)?)),
            OcpStart::Warm(point) if point.layout == self.layout() => Ok(righting_ipopt::Start {
                x: point.z.clone(),
                multipliers: Some(Multipliers {
                    constraints: point.constraints.clone(),
                    lower: point.lower.clone(),
                    upper: point.upper.clone(),
                }),
            }),
            OcpStart::Warm(point) => Err(OcpError::Dimension {
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

/// Whether a solve that ended so might succeed with another factorisation. A point of least infeasibility is
/// the problem's: of 15 that were solved again by MUMPS 13 ended in one again and two got nowhere.
fn may_be_the_linear_solver(status: Status) -> bool {
    !status.is_success()
        && !matches!(
            status,
            Status::UserStop
                | Status::Infeasible
                | Status::IterationLimit
                | Status::CpuTimeLimit
                | Status::WallTimeLimit
                | Status::TooFewDegreesOfFreedom
        )
}

#[cfg(test)]
mod tests;
