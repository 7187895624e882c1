//! Constraints on what happens within a step.

use num_dual::DualNum;
use righting_ocp::*;

/// Position and velocity of a cart that is pushed, and the distance it has covered.
fn cart(x: &[Expr], u: &[Expr]) -> Vec<Expr> {
    vec![x[1], u[0], x[1] * x[1]]
}

/// Out to a wall and back to the start, at the cost of the push; the cart may not enter the wall, which
/// stands at 1.
fn wall() -> ControlProblem {
    let at_start = ComponentBounds::new(vec![0.0, 0.0], vec![0.0, 0.0]);
    ControlProblem::new(3, 1, cart)
        .running_cost(|x, u, _| u[0].powi(2) * 0.01 - x[0])
        .state_bounds(ComponentBounds::new(
            vec![f64::NEG_INFINITY; 3],
            vec![1.0, f64::INFINITY, f64::INFINITY],
        ))
        .terminal_constraints(at_start, |x| vec![x[0], x[1]])
}

/// The position half a step ahead at the speed of now: with those of the two nodes, the control points
/// of the motion within a step (a Bézier curve, which lies in their hull).
fn kept_out_of_wall(problem: ControlProblem) -> ControlProblem {
    let bounds = ComponentBounds::new(vec![f64::NEG_INFINITY], vec![1.0]);
    problem.stage_constraints(bounds, |x, _, h| vec![x[0] + x[1] * h * 0.5])
}

fn functions(problem: &ControlProblem) -> StageFunctions {
    StageFunctions::compile(problem).unwrap()
}

fn solve(functions: &StageFunctions, start: &[f64], steps: usize, by: &Settings) -> OcpSolution {
    let grid = Grid::new(4.0, steps).unwrap();
    let mut program = MultipleShooting::new(functions, grid, start).unwrap();
    let guess = OcpStart::Guess(InitialGuess::constant(start, 1, steps));
    program.solve(&guess, by, |_| Control::Continue).unwrap()
}

/// The farthest place between the nodes too, and the time per step.
fn farthest(solution: &OcpSolution) -> f64 {
    let h = 4.0 / solution.controls.len() as f64;
    let steps = solution.states.rows().zip(solution.controls.rows());
    let within = |(x, u): (&[f64], &[f64])| {
        let turn = (-x[1] / u[0]).clamp(0.0, h);
        x[0] + turn * (x[1] + 0.5 * turn * u[0])
    };
    steps.map(within).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn a_bound_on_the_middle_control_point_holds_between_the_nodes() {
    for steps in [5, 9, 40] {
        let unaware = solve(&functions(&wall()), &[0.0; 3], steps, &Settings::default());
        assert_eq!(unaware.status, Status::Solved);
        let aware = functions(&kept_out_of_wall(wall()));
        let kept = solve(&aware, &[0.0; 3], steps, &Settings::default());
        assert_eq!(kept.status, Status::Solved);
        assert!(farthest(&kept) <= 1.0 + 1e-7, "{steps}: {}", farthest(&kept));
        assert!(farthest(&kept) > 0.99, "{steps}: it is worth to go to the wall");
        if steps == 5 {
            assert!(farthest(&unaware) > 1.01, "{}", farthest(&unaware));
            assert!(kept.objective > unaware.objective);
        }
    }
}

#[test]
fn every_solver_finds_the_same_optimum() {
    // An equality too, and one that needs Δt.
    let bounds = ComponentBounds::new(vec![f64::NEG_INFINITY, 0.0], vec![1.0, 0.0]);
    let problem = ControlProblem::new(2, 2, |x, u| vec![x[1], u[0] + 0.3 * u[1]])
        .running_cost(|x, u, _| u[0].powi(2) * 0.1 + u[1].powi(2) * 0.01 - x[0])
        .terminal_constraints(ComponentBounds::new(vec![0.0; 2], vec![0.0; 2]), |x| x.to_vec())
        .path_constraints(ComponentBounds::new(vec![-3.0], vec![3.0]), |x| vec![x[1] + 0.1 * x[0]])
        .stage_constraints(bounds, |x, u, h| {
            vec![x[0] + x[1] * h * 0.5, u[0] - u[1] * 0.5 - h * x[0] * 0.1]
        });
    let functions = functions(&problem);
    let grid = Grid::new(4.0, 12).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.0, 0.2]).unwrap();
    let guess = OcpStart::Guess(InitialGuess::constant(&[0.0, 0.2], 2, 12));
    let mut solved = |optimizer, linear_solver| {
        let by = Settings { optimizer, linear_solver, ..Settings::default() };
        program.solve(&guess, &by, |_| Control::Continue).unwrap()
    };
    let expected = solved(Optimizer::Ipopt, LinearSolverChoice::Mumps);
    assert_eq!(expected.status, Status::Solved);
    let h = grid.step_s();
    for (x, u) in expected.states.rows().zip(expected.controls.rows()) {
        assert!((u[0] - u[1] * 0.5 - h * x[0] * 0.1).abs() < 1e-7);
    }
    for optimizer in [Optimizer::Ipopt, Optimizer::Interior] {
        let found = solved(optimizer, LinearSolverChoice::Stage);
        assert_eq!((found.status, found.optimizer), (Status::Solved, optimizer));
        assert_eq!(found.linear_solver, UsedLinearSolver::Stage);
        assert_eq!(found.iterations(), expected.iterations());
        let pairs = found.states.rows().flatten().zip(expected.states.rows().flatten());
        assert!(pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-6);
    }
    let point = solved(Optimizer::Ipopt, LinearSolverChoice::Stage).point;
    assert_eq!(program.curvature(&point).unwrap(), Curvature::Positive);
}

/// Beyond the wall half a step ahead already, whatever the push: no reason not to solve.
#[test]
fn what_no_control_enters_is_not_asked_of_the_first_step() {
    let start = [0.9, 0.4, 0.0];
    let functions = functions(&kept_out_of_wall(wall()));
    for linear_solver in [LinearSolverChoice::Stage, LinearSolverChoice::Mumps] {
        let by = Settings { linear_solver, ..Settings::default() };
        let solution = solve(&functions, &start, 6, &by);
        assert_eq!(solution.status, Status::Solved);
        let first = start[0] + start[1] * 2.0 / 6.0;
        assert!(first > 1.0);
    }
}

#[test]
fn another_grid_starts_with_the_multipliers_of_the_stage_constraints() {
    let functions = functions(&kept_out_of_wall(wall()));
    let first = solve(&functions, &[0.0; 3], 25, &Settings::default());
    let settings = Settings::default();
    let grid = Grid::new(4.0, 25).unwrap();
    let refined = |steps| {
        let grid = grid.with_steps(steps).unwrap();
        let (functions, initial, between) = (&functions, &[0.0; 3], &[]);
        let refinement = MeshRefinement {
            functions,
            last_functions: functions,
            initial,
            grid,
            between,
            settings: &settings,
        };
        let warm = refinement.refine(first.point.clone(), |_| Control::Continue).unwrap();
        assert_eq!(warm.status, Status::Solved);
        assert_eq!(warm.attempts.len(), 1, "{:?}", warm.attempts);
        assert!(farthest(&warm) <= 1.0 + 1e-7);
        warm
    };
    // On the same grid the point is the optimum, if all its multipliers came along.
    let same = refined(25);
    assert!(same.iterations() <= 2, "{}", same.iterations());
    assert!((same.objective - first.objective).abs() < 1e-6);
    refined(80);
}

#[test]
fn a_state_that_only_a_stage_constraint_sees_is_not_passive() {
    let states = |problem: &ControlProblem| {
        let functions = functions(problem);
        let program =
            MultipleShooting::new(&functions, Grid::new(1.0, 2).unwrap(), &[0.0; 3]).unwrap();
        program.layout().dimensions().states
    };
    assert_eq!(states(&wall()), 2);
    let bounds = ComponentBounds::new(vec![-1.0], vec![1.0]);
    assert_eq!(states(&wall().stage_constraints(bounds, |x, u, _| vec![x[2] * u[0]])), 3);
}

#[test]
fn bounds_of_another_length_are_refused() {
    let problem = wall().stage_constraints(ComponentBounds::unbounded(2), |x, _, _| vec![x[0]]);
    let Err(refusal) = StageFunctions::compile(&problem) else { panic!("accepted") };
    let said = refusal.to_string();
    assert_eq!(said, "stage constraints: 1 components where 2 are expected");
}
