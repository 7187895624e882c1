//! Whole solves with the stage factorisation take the same steps as with MUMPS.

use num_dual::DualNum;
use righting_ocp::*;
use righting_symbolic::Expr;

fn both(
    problem: &ControlProblem,
    grid: Grid,
    initial: &[f64],
    guess: &InitialGuess,
) -> [OcpSolution; 2] {
    let functions = StageFunctions::compile(problem).unwrap();
    [LinearSolverChoice::Stage, LinearSolverChoice::Mumps].map(|linear_solver| {
        let mut program = MultipleShooting::new(&functions, grid, initial).unwrap();
        let settings = Settings { linear_solver, ..Settings::default() };
        let start = OcpStart::Guess(guess.clone());
        program.solve(&start, &settings, |_| Control::Continue).unwrap()
    })
}

#[track_caller]
fn assert_same([stage, mumps]: &[OcpSolution; 2]) {
    assert_eq!(stage.linear_solver, UsedLinearSolver::Stage);
    assert_eq!(mumps.linear_solver, UsedLinearSolver::Mumps);
    assert_eq!((stage.status, mumps.status), (Status::Solved, Status::Solved));
    let scale = mumps.objective.abs().max(1.0);
    assert!((stage.objective - mumps.objective).abs() < 1e-8 * scale);
    assert!(stage.history.len() <= mumps.history.len() + 2, "more iterations than with MUMPS");
    for (ours, theirs) in stage.states.rows().zip(mumps.states.rows()) {
        for (a, b) in ours.iter().zip(theirs) {
            assert!((a - b).abs() < 1e-6 * (1.0 + b.abs()));
        }
    }
}

/// State: cart position (m), rod angle from hanging (rad), and their rates. Control: force (N).
fn cart_pole(x: &[Expr], u: &[Expr]) -> Vec<Expr> {
    let (sin, cos) = x[1].sin_cos();
    let inertia = sin * sin * 0.3 + 1.0;
    let swing = x[3] * x[3] * 0.15 * sin;
    let cart = (swing + u[0] + cos * sin * (0.3 * 9.81)) / inertia;
    let rod = -(swing * cos + u[0] * cos + sin * (1.3 * 9.81)) / (inertia * 0.5);
    vec![x[2], x[3], cart, rod]
}

/// The terminal equalities have no pivots of their own, the dynamics are unstable and the bounds
/// are active.
#[test]
fn a_swing_up_with_a_fixed_end() {
    let goal = [1.0, std::f64::consts::PI, 0.0, 0.0];
    let end = ComponentBounds::new(goal.to_vec(), goal.to_vec());
    let unbounded = f64::INFINITY;
    let problem = ControlProblem::new(4, 1, cart_pole)
        .running_cost(|_, u, _| u[0] * u[0] * 0.02)
        .terminal_constraints(end, |x| x.to_vec())
        .state_bounds(ComponentBounds::symmetric(&[2.0, unbounded, unbounded, unbounded]))
        .control_bounds(ComponentBounds::symmetric(&[20.0]));
    for steps in [40, 200] {
        let mut guess = InitialGuess::constant(&[0.0; 4], 1, steps);
        for node in 0..=steps {
            let progress = node as f64 / steps as f64;
            let row = guess.states.row_mut(node);
            row.iter_mut().zip(&goal).for_each(|(state, goal)| *state = progress * goal);
        }
        let grid = Grid::new(2.0, steps).unwrap();
        assert_same(&both(&problem, grid, &[0.0; 4], &guess));
    }
}

/// A point mass around a disk: a nonconvex path inequality and one equality on the path, which
/// keeps its height on a slope.
#[test]
fn a_detour_with_path_constraints() {
    let infinity = f64::INFINITY;
    let path = ComponentBounds::new(vec![1.0, 0.0], vec![infinity, 0.0]);
    let problem = ControlProblem::new(6, 3, |x, u| vec![x[3], x[4], x[5], u[0], u[1], u[2]])
        .running_cost(|_, u, _| u[0] * u[0] + u[1] * u[1] + u[2] * u[2])
        .terminal_cost(|x| {
            ((x[0] - 2.0).powi(2) + (x[1] - 0.1).powi(2) + x[3].powi(2) + x[4].powi(2)) * 1e3
        })
        .path_constraints(path, |x| vec![x[0] * x[0] + x[1] * x[1], x[2] - x[0] * 0.1])
        .control_bounds(ComponentBounds::symmetric(&[6.0, 6.0, 6.0]));
    let initial = [-2.0, 0.0, -0.2, 0.0, 0.0, 0.0];
    let steps = 60;
    let mut guess = InitialGuess::constant(&initial, 3, steps);
    for node in 0..=steps {
        let angle = std::f64::consts::PI * (1.0 - node as f64 / steps as f64);
        let row = guess.states.row_mut(node);
        (row[0], row[1]) = (2.0 * angle.cos(), 2.0 * angle.sin());
        row[2] = 0.1 * row[0];
    }
    assert_same(&both(&problem, Grid::new(3.0, steps).unwrap(), &initial, &guess));
}
