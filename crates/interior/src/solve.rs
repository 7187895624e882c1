use std::time::Instant;

use righting_nlp::{
    Control, Hessian, Iteration, LinearSolver, MuStrategy, NlpSolution, Options, Problem, Start,
    Status, Timing,
};

use crate::algorithm::Algorithm;
use crate::error::{FailureReason, InteriorError};
use crate::initialization::first_iterate;
use crate::linear_system::LinearSystem;
use crate::program::Program;
use crate::search_direction::NewtonSystem;
use crate::state::State;

/// Solves `problem` from `start` as Ipopt would with these options, `fast_step_computation` among
/// them. `on_iteration` sees every iterate, the start included, and may end the solve. Where it
/// converges, the solution says whether it is a strict local minimum.
///
/// # Errors
/// [`InteriorError`] wherever Ipopt has to take over, from the start.
pub fn solve<P, L>(
    problem: &mut P,
    options: &Options,
    start: &Start,
    linear_solver: &mut L,
    on_iteration: impl FnMut(&Iteration) -> Control,
) -> Result<NlpSolution, InteriorError>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    timed(problem, options, start, linear_solver, on_iteration, true)
}

/// The same without the look at the reduced Hessian, which takes a factorisation: its definiteness stays unknown.
///
/// # Errors
/// As [`solve`].
pub fn solve_first_order<P, L>(
    problem: &mut P,
    options: &Options,
    start: &Start,
    linear_solver: &mut L,
    on_iteration: impl FnMut(&Iteration) -> Control,
) -> Result<NlpSolution, InteriorError>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    timed(problem, options, start, linear_solver, on_iteration, false)
}

fn timed<P, L>(
    problem: &mut P,
    options: &Options,
    start: &Start,
    linear_solver: &mut L,
    mut on_iteration: impl FnMut(&Iteration) -> Control,
    examines_curvature: bool,
) -> Result<NlpSolution, InteriorError>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    let clock = Instant::now();
    let mut iterations = 0;
    let record = |iteration: &Iteration| {
        iterations = iteration.iteration;
        on_iteration(iteration)
    };
    run(problem, options, start, linear_solver, record, clock, examines_curvature)
        .map_err(|reason| InteriorError { reason, iterations, time: clock.elapsed() })
}

fn run<P, L>(
    problem: &mut P,
    options: &Options,
    start: &Start,
    linear_solver: &mut L,
    on_iteration: impl FnMut(&Iteration) -> Control,
    clock: Instant,
    examines_curvature: bool,
) -> Result<NlpSolution, FailureReason>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    check(problem, options)?;
    let mut program = Program::new(problem, options, start)?;
    let iterate = first_iterate(&mut program, options, start)?;
    let linear = LinearSystem::new(linear_solver, &program.declared)?;
    let mut algorithm =
        Algorithm::new(program, NewtonSystem::new(linear, options), options, iterate)?;
    if start.multipliers.is_none() {
        algorithm.estimate_multipliers();
    }
    let (status, last_iteration) = algorithm.run(on_iteration)?;
    let reduced_hessian = match status.is_success() && examines_curvature {
        true => Some(algorithm.reduced_hessian()?),
        false => None,
    };
    let solution = to_solution(algorithm.state, status, last_iteration, clock);
    Ok(NlpSolution { reduced_hessian, ..solution })
}

/// Refuses options that are none, or that ask for what the method does not have.
fn check<P: Problem + ?Sized>(problem: &P, options: &Options) -> Result<(), FailureReason> {
    options.validate()?;
    let default = Options::default();
    let unsupported = [
        (options.mu_strategy != MuStrategy::Monotone, "an adaptive barrier parameter"),
        (options.hessian != Hessian::Exact, "an approximate Hessian"),
        (options.mu_target != 0.0, "a barrier parameter to converge to"),
        (options.obj_scaling_factor != 1.0, "a factor of the objective"),
        (problem.scaling().is_some(), "scaling by the problem"),
        (options.expect_infeasible, "expecting infeasibility"),
        (options.start_with_resto, "a restoration phase"),
        (!options.fast_step_computation, "iterative refinement"),
        (options.max_cpu_time < default.max_cpu_time, "a time limit"),
        (options.print_level > 0, "printing"),
        (!options.honor_original_bounds, "a solution within relaxed bounds"),
        (
            options.acceptable_obj_change_tol != default.acceptable_obj_change_tol,
            "a tolerance of the objective's change",
        ),
        (!options.extra.is_empty(), "an option that has no field"),
    ];
    if let Some((_, what)) = unsupported.iter().find(|(is_asked, _)| *is_asked) {
        return Err(FailureReason::Unsupported(what));
    }
    Ok(())
}

/// The iterate in the caller's terms.
fn to_solution<P, L>(
    state: State<'_, P, L>,
    status: Status,
    last: Iteration,
    clock: Instant,
) -> NlpSolution
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    let State { mut program, newton, iterate, .. } = state;
    let mut x = iterate.point.w;
    x.truncate(program.variables());
    program.put_within_bounds(&mut x);
    let g = program.unscaled_constraints(&x);
    let constraint_violation = program.declared.violation(&x, &g);
    NlpSolution {
        status,
        x,
        objective: last.objective,
        g,
        multipliers: program.unscaled_multipliers(&iterate.y, &iterate.z),
        iterations: last.iteration,
        reduced_hessian: None,
        constraint_violation,
        last_iteration: Some(last),
        timing: Timing {
            total: clock.elapsed(),
            evaluation: program.timing,
            linear_solver: Some(newton.linear.timing),
        },
    }
}
