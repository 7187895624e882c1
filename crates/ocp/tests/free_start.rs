//! Initial states that are free: parameters of the whole problem, such as its duration.

use righting_ocp::*;

/// The fastest way of a double integrator with |u| ≤ 1 from rest at 0 to rest at 1, on σ = t/T from 0 to 1:
/// x′ = T v, v′ = T u, T′ = 0 with T free. Full thrust to the middle and full brakes after it take T = 2.
fn fastest(is_bounded: bool) -> ControlProblem {
    let shortest = if is_bounded { 3.0 } else { 0.1 };
    let unbounded = f64::INFINITY;
    ControlProblem::new(3, 1, |x, u| vec![x[2] * x[1], x[2] * u[0], Expr::constant(0.0)])
        .free_initial_states(&[2])
        .running_cost(|x, u, _| x[2] * u[0].powi(2) * 1e-9)
        .terminal_cost(|x| x[2])
        .state_bounds(ComponentBounds::new(
            vec![-unbounded, -unbounded, shortest],
            vec![unbounded, unbounded, 10.0],
        ))
        .control_bounds(ComponentBounds::symmetric(&[1.0]))
        .stage_constraints(ComponentBounds::new(vec![-9.0], vec![9.0]), |x, u, _| {
            vec![x[2] * u[0] + x[1]]
        })
        .terminal_constraints(ComponentBounds::new(vec![1.0, 0.0], vec![1.0, 0.0]), |x| {
            x[..2].to_vec()
        })
}

fn solved(problem: &ControlProblem, steps: usize, settings: &Settings) -> OcpSolution {
    let functions = StageFunctions::compile(problem).unwrap();
    let grid = Grid::new(1.0, steps).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.0, 0.0, 5.0]).unwrap();
    let start = OcpStart::Guess(InitialGuess::constant(&[0.0, 0.0, 5.0], 1, steps));
    program.solve(&start, settings, |_| Control::Continue).unwrap()
}

#[test]
fn the_fastest_way_takes_the_time_of_bang_bang_control() {
    for linear_solver in [LinearSolverChoice::Stage, LinearSolverChoice::Mumps] {
        for optimizer in [Optimizer::Ipopt, Optimizer::Interior] {
            let settings = Settings { linear_solver, optimizer, ..Settings::default() };
            let solution = solved(&fastest(false), 20, &settings);
            assert_eq!(solution.status, Status::Solved, "{linear_solver:?} {optimizer:?}");
            let duration = solution.states.row(0)[2];
            assert!((duration - 2.0).abs() < 1e-5, "{linear_solver:?} {optimizer:?}: {duration}");
            assert_eq!(solution.states.row(20)[2], duration);
            for step in 0..20 {
                let u = if step < 10 { 1.0 } else { -1.0 };
                assert!((solution.controls.row(step)[0] - u).abs() < 1e-3);
            }
        }
    }
}

#[test]
fn a_free_start_keeps_the_bounds_of_its_state() {
    let solution = solved(&fastest(true), 20, &Settings::default());
    assert_eq!(solution.status, Status::Solved);
    assert!((solution.states.row(0)[2] - 3.0).abs() < 1e-6);
}

#[test]
fn a_free_start_is_carried_to_finer_grids() {
    let problem = fastest(false);
    let coarse = solved(&problem, 10, &Settings::default());
    let functions = StageFunctions::compile(&problem).unwrap();
    let refined = MeshRefinement {
        functions: &functions,
        last_functions: &functions,
        initial: &[0.0, 0.0, 5.0],
        grid: Grid::new(1.0, 80).unwrap(),
        between: &[],
        settings: &Settings::default(),
    }
    .refine(coarse.point, |_| Control::Continue)
    .unwrap();
    assert_eq!(refined.status, Status::Solved);
    assert_eq!(refined.controls.len(), 80);
    assert!((refined.states.row(0)[2] - 2.0).abs() < 1e-5);
}

#[test]
fn derivatives_by_a_free_start_agree_with_finite_differences() {
    let functions = StageFunctions::compile(&fastest(false)).unwrap();
    let grid = Grid::new(1.0, 5).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.0, 0.0, 5.0]).unwrap();
    let layout = program.layout();
    let wave = |len: usize, pace: f64| (0..len).map(|i| (pace * (i + 1) as f64).sin()).collect();
    let z: Vec<f64> = wave(layout.variables(), 1.3);
    let direction: Vec<f64> = wave(layout.variables(), 0.7);
    let multipliers: Vec<f64> = wave(layout.constraints(), 0.9);
    let errors = DerivativeErrors::along(&mut program, &z, &direction, &multipliers, 1e-5).unwrap();
    assert!(errors.gradient < 1e-8, "{errors:?}");
    assert!(errors.jacobian < 1e-8, "{errors:?}");
    assert!(errors.hessian < 1e-7, "{errors:?}");
}
