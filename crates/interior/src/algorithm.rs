use righting_nlp::{Control, Iteration, LinearSolver, Options, Problem, ReducedHessian, Status};

use crate::barrier::reset_multipliers;
use crate::barrier_parameter::BarrierParameter;
use crate::convergence::ConvergenceCheck;
use crate::error::FailureReason;
use crate::iterate::Iterate;
use crate::line_search::{LineSearch, StepLengths};
use crate::norm::max_norm;
use crate::optimality_error::OptimalityError;
use crate::program::Program;
use crate::search_direction::{NewtonSystem, SearchDirection};
use crate::state::State;

/// Algorithm A (W&B section 2.5) without its restoration phase.
pub(crate) struct Algorithm<'a, P: ?Sized, L: ?Sized> {
    pub(crate) state: State<'a, P, L>,
    line_search: LineSearch,
    convergence: ConvergenceCheck,
}

impl<'a, P, L> Algorithm<'a, P, L>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    /// From an iterate whose derivatives are not evaluated yet (step A-1).
    pub(crate) fn new(
        program: Program<'a, P>,
        newton: NewtonSystem<'a, L>,
        options: &'a Options,
        iterate: Iterate,
    ) -> Result<Self, FailureReason> {
        let Iterate { point, y, z, .. } = &iterate;
        let direction = SearchDirection::zero(point.w.len(), y.len(), z.len());
        let line_search = LineSearch::new(point);
        let barrier = BarrierParameter::new(options.mu_init);
        let mut state = State { program, newton, options, barrier, iterate, direction };
        differentiate(&mut state)?;
        Ok(Self { state, line_search, convergence: ConvergenceCheck::default() })
    }

    /// Replaces the constraints' multipliers by their least-squares estimate where there is one.
    pub(crate) fn estimate_multipliers(&mut self) {
        let State { program, newton, options, iterate, .. } = &mut self.state;
        if let Some(y) = newton.least_squares_multipliers(iterate, options) {
            iterate.y = y;
            iterate.differentiate_lagrangian(program, newton.linear.matrix.jacobian());
        }
    }

    /// Iterates until a status is reached; the last iteration with it. `on_iteration` sees every
    /// iterate and may end the solve.
    pub(crate) fn run(
        &mut self,
        mut on_iteration: impl FnMut(&Iteration) -> Control,
    ) -> Result<(Status, Iteration), FailureReason> {
        let mut step_norm = 0.0;
        let mut regularization = 0.0;
        let mut lengths = StepLengths::NONE;
        let mut count = 0;
        loop {
            let state = &mut self.state;
            let objective_scale = state.program.scaling.objective;
            let errors = OptimalityError::of(&state.program, &state.iterate);
            let iteration = Iteration {
                iteration: count,
                restoration: false,
                objective: state.iterate.point.objective / objective_scale,
                primal_infeasibility: errors.primal,
                dual_infeasibility: errors.dual,
                mu: state.barrier.mu,
                step_norm,
                regularization,
                alpha_primal: lengths.primal,
                alpha_dual: lengths.dual,
                line_search_trials: lengths.trials,
            };
            if on_iteration(&iteration) == Control::Stop {
                return Ok((Status::UserStop, iteration));
            }
            // Step A-2.
            if let Some(status) = self.convergence.status(
                state.options,
                objective_scale,
                state.program.variables(),
                &errors,
                &state.iterate,
                count,
            ) {
                return Ok((status, iteration));
            }
            evaluate_hessian(state)?;
            // Step A-3.
            if state.barrier.update(state.options, objective_scale, &errors, &state.iterate) {
                self.line_search.reset();
            }
            // Step A-4.
            let State { program, newton, barrier, iterate, direction, .. } = state;
            regularization = newton.find_direction(program, iterate, barrier.mu, direction)?;
            step_norm = max_norm(&direction.w);
            // Steps.
            lengths = self.line_search.search(state)?;
            move_bounds(state);
            let State { iterate, barrier, .. } = state;
            reset_multipliers(&mut iterate.z, &iterate.point.distances, barrier.mu);
            differentiate(state)?;
            count += 1;
        }
    }

    /// The definiteness of the reduced Hessian at the iterate.
    pub(crate) fn reduced_hessian(&mut self) -> Result<ReducedHessian, FailureReason> {
        evaluate_hessian(&mut self.state)?;
        let State { program, newton, iterate, .. } = &mut self.state;
        Ok(newton.reduced_hessian(program, iterate))
    }
}

fn differentiate<P, L>(state: &mut State<'_, P, L>) -> Result<(), FailureReason>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    let State { program, newton, iterate, .. } = state;
    iterate.differentiate(program, newton.linear.matrix.jacobian_mut())
}

fn evaluate_hessian<P, L>(state: &mut State<'_, P, L>) -> Result<(), FailureReason>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    let State { program, newton, iterate, .. } = state;
    let x = &iterate.point.w[..program.variables()];
    program.hessian(x, &iterate.y, newton.linear.matrix.hessian_mut())
}

/// Moves the bounds that an iterate is on but for rounding (W&B section 3.5).
fn move_bounds<P: Problem + ?Sized, L: ?Sized>(state: &mut State<'_, P, L>) {
    let point = &state.iterate.point;
    if !point.moves_bounds {
        return;
    }
    for (bound, distance) in state.program.bounds.iter_mut().zip(&point.distances) {
        let value = point.w[bound.index()] - bound.sign() * distance;
        bound.value =
            if bound.sign() > 0.0 { bound.value.min(value) } else { bound.value.max(value) };
    }
}
