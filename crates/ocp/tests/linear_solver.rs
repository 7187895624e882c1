//! Who factorises, what becomes of a problem that the stage solver does not take, and that results
//! depend on neither lanes nor backends.

use num_dual::DualNum;
use righting_nlp::Problem;
use righting_ocp::kkt::{StageDims, StageKkt};
use righting_ocp::*;
use righting_symbolic::Expr;

const STEPS: usize = 37;

/// A cart and its pendulum: the cart's force, and a motor in the joint.
fn cart(x: &[Expr], u: &[Expr]) -> Vec<Expr> {
    let (sine, cosine) = (x[1].sin(), x[1].cos());
    let cart = (u[0] + sine * (x[3] * x[3] + cosine * 9.81) - cosine * u[1]) / (sine * sine + 2.0);
    vec![x[2], x[3], cart, u[1] - sine * 9.81 - cosine * cart]
}

/// From hanging at 0 to hanging at 1, at rest, without swinging too high.
fn problem(motor: f64) -> ControlProblem {
    let rest = vec![1.0, 0.0, 0.0, 0.0];
    ControlProblem::new(4, 2, cart)
        .running_cost(|_, u, _| u[0].powi(2) + u[1].powi(2))
        .control_bounds(ComponentBounds::symmetric(&[8.0, motor]))
        .path_constraints(ComponentBounds::new(vec![0.9], vec![f64::INFINITY]), |x| {
            vec![x[1].cos()]
        })
        .terminal_constraints(ComponentBounds::new(rest.clone(), rest), |x| x.to_vec())
}

fn start() -> OcpStart {
    OcpStart::Guess(InitialGuess::constant(&[0.0; 4], 2, STEPS))
}

fn solve(
    problem: &ControlProblem,
    linear_solver: LinearSolverChoice,
) -> Result<OcpSolution, OcpError> {
    let functions = StageFunctions::compile(problem)?;
    let mut program = MultipleShooting::new(&functions, Grid::new(2.0, STEPS)?, &[0.0; 4])?;
    let settings = Settings { linear_solver, ..Settings::default() };
    program.solve(&start(), &settings, |_| Control::Continue)
}

/// All states, then all controls.
fn motion(solution: &OcpSolution) -> Vec<f64> {
    solution.states.rows().chain(solution.controls.rows()).flatten().copied().collect()
}

fn assert_close(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a:e} and {b:e}");
}

#[test]
fn both_solvers_find_the_same_optimum_and_say_who_they_are() {
    let [mumps, stage, auto] =
        [LinearSolverChoice::Mumps, LinearSolverChoice::Stage, LinearSolverChoice::Auto]
            .map(|linear_solver| solve(&problem(3.0), linear_solver).unwrap());
    assert_eq!(mumps.linear_solver, UsedLinearSolver::Mumps);
    assert_eq!(stage.linear_solver, UsedLinearSolver::Stage);
    assert_eq!(auto.linear_solver, UsedLinearSolver::Stage);
    assert!(stage.timing.linear_solver.is_some() && mumps.timing.linear_solver.is_none());
    for solution in [&stage, &auto] {
        assert_eq!(solution.status, Status::Solved);
        assert_eq!(solution.status, mumps.status);
        assert_close(solution.objective, mumps.objective, 1e-8);
    }
    assert_eq!(motion(&stage), motion(&auto));
}

/// Ipopt takes a variable between equal bounds out of the system: the stages no longer look alike.
#[test]
fn a_fixed_control_is_no_stage_structure_and_mumps_solves_it() {
    let fixed = problem(0.0);
    let refused = solve(&fixed, LinearSolverChoice::Stage).unwrap_err();
    assert!(matches!(refused, OcpError::Solve(_)), "{refused}");
    let solution = solve(&fixed, LinearSolverChoice::Auto).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_eq!(solution.linear_solver, UsedLinearSolver::Mumps);
    assert!(solution.controls.rows().all(|row| row[1] == 0.0));
    let expected = solve(&fixed, LinearSolverChoice::Mumps).unwrap();
    assert_eq!(motion(&solution), motion(&expected));

    // A motor of next to no strength is a control like any other, with nearly the same optimum.
    let weak = solve(&problem(1e-6), LinearSolverChoice::Auto).unwrap();
    assert_eq!(weak.linear_solver, UsedLinearSolver::Stage);
    assert_close(weak.objective, solution.objective, 1e-4);
}

#[test]
fn no_solver_finds_what_does_not_exist_and_one_is_enough_to_say_so() {
    // 8 N for 2 s never move the 3 kg by 30 m.
    let far = vec![30.0, 0.0, 0.0, 0.0];
    let impossible =
        problem(3.0).terminal_constraints(ComponentBounds::new(far.clone(), far), |x| x.to_vec());
    let solution = solve(&impossible, LinearSolverChoice::Auto).unwrap();
    assert_eq!(solution.linear_solver, UsedLinearSolver::Stage);
    assert_eq!(solution.status, Status::Infeasible);
    assert_eq!(solution.status, solve(&impossible, LinearSolverChoice::Mumps).unwrap().status);
}

/// A solve that was stopped is not begun again; one that ran out of iterations is, unless it is one
/// start of many.
#[test]
fn what_ends_on_request_stays_ended() {
    let functions = StageFunctions::compile(&problem(3.0)).unwrap();
    let grid = Grid::new(2.0, STEPS).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.0; 4]).unwrap();
    let stopped = program
        .solve(&start(), &Settings::default(), |iteration| match iteration.iteration {
            2 => Control::Stop,
            _ => Control::Continue,
        })
        .unwrap();
    assert_eq!((stopped.status, stopped.iterations()), (Status::UserStop, 2));
    assert_eq!(stopped.linear_solver, UsedLinearSolver::Stage);
    let two = Options { max_iterations: 2, ..Options::default() };
    for (retry_at_iteration_limit, used) in
        [(false, UsedLinearSolver::Stage), (true, UsedLinearSolver::MumpsAfterStage)]
    {
        let settings =
            Settings { ipopt: two.clone(), retry_at_iteration_limit, ..Settings::default() };
        let cut = program.solve(&start(), &settings, |_| Control::Continue).unwrap();
        assert_eq!((cut.status, cut.iterations()), (Status::IterationLimit, 2));
        assert_eq!(cut.linear_solver, used);
    }
}

/// Every function of the program at one point, and a whole solve.
fn evaluated(functions: &StageFunctions) -> Vec<Vec<f64>> {
    let grid = Grid::new(2.0, STEPS).unwrap();
    let mut program = MultipleShooting::new(functions, grid, &[0.0; 4]).unwrap();
    let (variables, constraints) = (program.layout().variables(), program.layout().constraints());
    let x: Vec<f64> = (0..variables).map(|i| (i as f64 * 0.7).sin()).collect();
    let multipliers: Vec<f64> = (0..constraints).map(|i| (i as f64 * 1.3).cos()).collect();
    let mut gradient = vec![0.0; variables];
    let mut values = vec![0.0; constraints];
    let mut jacobian = vec![0.0; program.jacobian_structure().len()];
    let mut hessian = vec![0.0; program.hessian_structure().len()];
    let objective = program.objective(&x, true).unwrap();
    program.gradient(&x, false, &mut gradient).unwrap();
    program.constraints(&x, false, &mut values).unwrap();
    program.jacobian(&x, false, &mut jacobian).unwrap();
    program.hessian(&x, false, 0.7, &multipliers, true, &mut hessian).unwrap();
    let solution = program.solve(&start(), &Settings::default(), |_| Control::Continue).unwrap();
    assert_eq!(solution.status, Status::Solved);
    vec![vec![objective], gradient, values, jacobian, hessian, motion(&solution)]
}

#[test]
fn every_backend_gives_the_same_bits() {
    let functions = StageFunctions::compile(&problem(3.0)).unwrap();
    let expected = evaluated(&functions);
    let backends = Backend::available();
    assert!(backends.len() > 1);
    for backend in backends {
        let functions = functions.with_backend(backend).unwrap();
        assert!(evaluated(&functions) == expected, "{backend:?}");
    }
}

#[test]
fn the_width_of_the_factorisation_changes_rounding_only() {
    let functions = StageFunctions::compile(&problem(3.0)).unwrap();
    let grid = Grid::new(2.0, STEPS).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.0; 4]).unwrap();
    let wide = program.solve(&start(), &Settings::default(), |_| Control::Continue).unwrap();

    let mut nodes = StageDims::uniform(4, 2, 1, STEPS).nodes().to_vec();
    nodes[STEPS].equalities = 4;
    let mut narrow = StageKkt::scalar(&StageDims::new(nodes));
    let start = righting_nlp::Start::at(vec![0.0; program.layout().variables()]);
    let options = Options::default();
    let narrow = righting_ipopt::solve_with(&mut program, &options, &start, &mut narrow, |_| {
        Control::Continue
    })
    .unwrap();
    assert_eq!(narrow.status, wide.status);
    assert_eq!(narrow.iterations, wide.iterations());
    let layout = program.layout();
    for step in 0..STEPS {
        let part = |range: std::ops::Range<usize>| narrow.x[range].to_vec();
        let narrow = [part(layout.control(step)), part(layout.state(step + 1))].concat();
        let wide = [wide.controls.row(step), wide.states.row(step + 1)].concat();
        for (narrow, wide) in narrow.iter().zip(&wide) {
            assert!((narrow - wide).abs() < 1e-10, "{narrow} and {wide}");
        }
    }
}
