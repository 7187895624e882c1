//! Gaps closed for all steps side by side, against an integration step by step.

use num_dual::DualNum;
use righting_ocp::*;

const STEPS: usize = 70;

#[test]
fn states_become_those_that_the_controls_lead_to() {
    let problem = ControlProblem::new(2, 1, |x, u| vec![x[1], u[0] - x[0].sin()])
        .running_cost(|_, u, _| u[0].powi(2))
        .terminal_cost(|x| x[0].powi(2))
        .state_bounds(ComponentBounds::symmetric(&[10.0, 0.5]));
    let functions = StageFunctions::compile(&problem).unwrap();
    let grid = Grid::new(7.0, STEPS).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.3, 0.0]).unwrap();
    let mut guess = InitialGuess::constant(&[0.3, 0.0], 1, STEPS);
    for step in 0..STEPS {
        guess.controls.row_mut(step)[0] = 0.4 * (0.2 * step as f64).cos();
    }
    let settings = Settings {
        optimizer: Optimizer::Interior,
        ipopt: Options { max_iterations: 0, ..Options::default() },
        ..Settings::default()
    };
    let solution =
        program.solve(&OcpStart::Guess(guess), &settings, |_| Control::Continue).unwrap();
    let mut point = solution.point;
    assert!(program.close_gaps(&mut point, 1e-12) < 1e-12);
    let (states, controls) = program.trajectory(&point);

    let (mut method, mut x) = (RungeKutta4::new(2), vec![0.3, 0.0]);
    let mut fastest = 0.0_f64;
    for step in 0..STEPS {
        let u = controls.row(step)[0];
        let next = method.step(grid.step_s(), &x, |stage| {
            let mut point = [0.0; 2];
            stage.write_point(&mut point);
            stage.set_rates(&[point[1], u - point[0].sin()]);
        });
        x = next.to_vec();
        fastest = fastest.max(x[1].abs());
        let found = states.row(step + 1);
        assert!((found[0] - x[0]).abs() < 1e-11 && (found[1] - x[1]).abs() < 1e-11, "{step}");
    }
    let outcome = program.outcome(&point);
    let effort: f64 = controls.rows().map(|u| u[0].powi(2)).sum();
    assert!((outcome.terminal_cost - x[0].powi(2)).abs() < 1e-10);
    assert!((outcome.objective - effort - outcome.terminal_cost).abs() < 1e-10);
    assert!((outcome.violation - (fastest - 0.5)).abs() < 1e-10, "{outcome:?}, {fastest}");
    assert!(outcome.violation > 0.0);
}
