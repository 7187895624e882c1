//! Exact derivatives of transcribed problems against finite differences.

use std::num::NonZeroUsize;

use num_dual::DualNum;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use righting_nlp::Problem;
use righting_ocp::*;
use righting_scalar::Scalar;
use righting_symbolic::Expr;

/// Numbers from −1 to 1.
fn vector(random: &mut ChaCha8Rng, len: usize) -> Vec<f64> {
    (0..len).map(|_| random.random_range(-1.0..1.0)).collect()
}

/// A dynamics with every kind of coupling: states with states, controls, and both in products; a
/// passive state; constant and varying Jacobian entries.
fn tangled(x: &[Expr], u: &[Expr]) -> Vec<Expr> {
    vec![
        x[1] + x[3].sin() * u[0],
        u[0] * 2.0 - x[0] * x[2],
        (x[1] * u[1]).cos() + x[2] * x[2] * 0.3,
        u[1],
        x[0] * x[1],
    ]
}

fn problem() -> ControlProblem {
    ControlProblem::new(5, 2, tangled)
        .running_cost(|x, u, step| {
            u[0] * u[0] * x[1].exp() * step.length + u[1] * u[1] + x[3] * x[3] * step.start
        })
        .terminal_cost(|x| (x[0] - 1.0).powi(2) * x[2] + x[1] * 3.0)
        .path_constraints(ComponentBounds::new(vec![-1.0, 0.0], vec![f64::INFINITY, 2.0]), |x| {
            vec![x[0] * x[1] + x[2].minimum(x[3]), x[3].powi(3)]
        })
        .terminal_constraints(ComponentBounds::new(vec![0.0], vec![0.0]), |x| {
            vec![x[0] * x[2] - x[3]]
        })
}

/// Stage constraints with every kind of entry: of a state, a control and Δt in products, of states
/// alone, of controls alone.
fn staged(problem: ControlProblem) -> ControlProblem {
    let bounds = ComponentBounds::new(vec![-1.0, 0.0, -2.0], vec![1.0, 0.0, f64::INFINITY]);
    problem.stage_constraints(bounds, |x, u, h| {
        vec![x[0] * u[1] + h * x[2].sin() * u[0], x[1] * x[3] + h * x[1], u[0] * u[1] * h]
    })
}

fn functions(problem: &ControlProblem, substeps: usize) -> StageFunctions {
    let functions = StageFunctions::compile(problem).unwrap();
    functions.with_substeps(NonZeroUsize::new(substeps).unwrap()).unwrap()
}

fn check(problem: &ControlProblem, steps: usize, substeps: usize) {
    let functions = functions(problem, substeps);
    let grid = Grid::new(1.7, steps).unwrap().with_steps(steps).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.3, -0.2, 0.5, 0.1, 9.0]).unwrap();
    let (variables, constraints) = (program.layout().variables(), program.layout().constraints());
    assert_eq!(variables, steps * (4 + 2), "the fifth state is passive");
    let mut random = ChaCha8Rng::seed_from_u64(7 + steps as u64);
    for _ in 0..3 {
        let (mut x, multipliers) =
            (vector(&mut random, variables), vector(&mut random, constraints));
        for node in 1..=steps {
            let state = &mut x[program.layout().state(node)];
            // The minimum of the two has no derivative where they meet.
            if (state[2] - state[3]).abs() < 0.01 {
                state[3] += 0.1;
            }
        }
        for column in 0..variables.min(40) {
            let mut unit = vec![0.0; variables];
            unit[column] = 1.0;
            let errors =
                DerivativeErrors::along(&mut program, &x, &unit, &multipliers, 1e-3).unwrap();
            assert!(errors.worst() < 1e-9, "variable {column}: {errors:?}");
        }
        let direction = vector(&mut random, variables);
        let errors =
            DerivativeErrors::along(&mut program, &x, &direction, &multipliers, 1e-3).unwrap();
        assert!(errors.worst() < 1e-9, "{errors:?}");
    }
}

#[test]
fn derivatives_agree_with_finite_differences_for_any_number_of_steps() {
    for steps in [1, 2, 5, 16, 17, 40] {
        check(&problem(), steps, 1);
    }
}

#[test]
fn so_do_those_of_stage_constraints_with_and_without_others() {
    let plain = || {
        ControlProblem::new(5, 2, tangled)
            .running_cost(|x, u, _| u[0] * u[0] * x[1].exp() + x[3])
            .terminal_cost(|x| x[2] * x[0])
    };
    for (steps, substeps) in [(1, 1), (2, 3), (5, 1), (17, 2)] {
        check(&staged(problem()), steps, substeps);
        check(&staged(plain()), steps, substeps);
    }
}

#[test]
fn derivatives_agree_with_finite_differences_for_any_number_of_substeps() {
    for (steps, substeps) in [(1, 2), (5, 3), (17, 4)] {
        check(&problem(), steps, substeps);
    }
}

/// A step of m Runge–Kutta steps ends where m steps of a finer grid with its control end.
#[test]
fn substeps_are_the_steps_of_a_finer_grid_with_the_same_controls() {
    let initial = [0.3, -0.2, 0.5, 0.1, 9.0];
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let (coarse, fine) = (functions(&problem(), 3), functions(&problem(), 1));
    let one_step = |functions: &StageFunctions, grid: Grid, from: &[f64], u: &[f64]| {
        let mut program = MultipleShooting::new(functions, grid, from).unwrap();
        let guess = InitialGuess {
            states: Samples::repeated(&[0.0; 5], 2),
            controls: Samples::repeated(u, 1),
        };
        let z = program.decision_vector(&guess).unwrap();
        let mut g = vec![0.0; program.layout().constraints()];
        program.constraints(&z, true, &mut g).unwrap();
        program.layout().defect(0).map(|row| -g[row]).collect::<Vec<f64>>()
    };
    let u = vector(&mut random, 2);
    let reached = one_step(&coarse, Grid::new(0.3, 1).unwrap(), &initial, &u);
    let mut state = initial.to_vec();
    for _ in 0..3 {
        let next = one_step(&fine, Grid::new(0.1, 1).unwrap(), &state, &u);
        state[..4].copy_from_slice(&next);
    }
    for (reached, expected) in reached.iter().zip(&state) {
        assert!((reached - expected).abs() < 1e-14, "{reached} {expected}");
    }
}

#[test]
fn the_hessian_does_not_rely_on_the_jacobian_having_been_asked_for_here() {
    let functions = StageFunctions::compile(&staged(problem())).unwrap();
    let grid = Grid::new(1.0, 3).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.3, -0.2, 0.5, 0.1, 9.0]).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let (here, there) = (vector(&mut random, 18), vector(&mut random, 18));
    let multipliers = vector(&mut random, program.layout().constraints());
    let entries = program.hessian_structure().len();
    let mut jacobian = vec![0.0; program.jacobian_structure().len()];
    let mut hessian_after = |program: &mut MultipleShooting, first: &[f64]| {
        let mut values = vec![0.0; entries];
        program.jacobian(first, true, &mut jacobian).unwrap();
        program.hessian(&here, true, 1.0, &multipliers, true, &mut values).unwrap();
        values
    };
    assert_eq!(hessian_after(&mut program, &here), hessian_after(&mut program, &there));
}
