use num_dual::DualNum;
use righting_nlp::{Control, Options, ReducedHessian};

use super::*;
use crate::component_bounds::ComponentBounds;
use crate::control_problem::ControlProblem;
use crate::grid::Grid;
use crate::initial_guess::InitialGuess;
use crate::ocp_start::OcpStart;
use crate::settings::{Optimizer, Settings};
use crate::stage_functions::StageFunctions;

const STEPS: usize = 10;

/// x' = u over one second. With all controls equal to u the cost Σ u² − c x(1)² is (N − c) u²,
/// and along every other direction it curves up more.
fn pulled_away(pull: f64) -> ControlProblem {
    ControlProblem::new(1, 1, |_, u| vec![u[0]])
        .running_cost(|_, u, _| u[0].powi(2))
        .terminal_cost(move |x| x[0].powi(2) * -pull)
}

/// The curvature where a solve from these controls ends.
fn curvature_from(problem: &ControlProblem, control: f64) -> (Curvature, f64, usize) {
    let functions = StageFunctions::compile(problem).unwrap();
    let grid = Grid::new(1.0, STEPS).unwrap();
    let mut program = MultipleShooting::new(&functions, grid, &[0.0]).unwrap();
    let mut guess = InitialGuess::constant(&[0.0], 1, STEPS);
    for step in 0..STEPS {
        guess.controls.row_mut(step)[0] = control;
        guess.states.row_mut(step + 1)[0] = control * (step + 1) as f64 / STEPS as f64;
    }
    let settings = Settings {
        ipopt: Options { tolerance: 1e-9, ..Options::default() },
        ..Settings::default()
    };
    let start = OcpStart::Guess(guess);
    let solution = program.solve(&start, &settings, |_| Control::Continue).unwrap();
    assert!(solution.status.is_success(), "{:?}", solution.status);
    let curvature = program.curvature(&solution.point).unwrap();
    // Ipopt does not look.
    assert_eq!(solution.reduced_hessian, None);
    let by_interior = Settings { optimizer: Optimizer::Interior, ..settings };
    let solution = program.solve(&start, &by_interior, |_| Control::Continue).unwrap();
    let expected = match (solution.optimizer, &curvature) {
        // Where the interior solver gave up.
        (Optimizer::Ipopt, _) => None,
        (Optimizer::Interior, Curvature::Positive) => Some(ReducedHessian::PositiveDefinite),
        (Optimizer::Interior, _) => Some(ReducedHessian::NotPositiveDefinite),
    };
    assert_eq!(solution.reduced_hessian, expected);
    (curvature, solution.states.row(STEPS)[0], solution.iterations())
}

#[test]
fn a_minimum_has_positive_curvature_and_a_saddle_has_not() {
    let least = STEPS as f64;
    let (curvature, _, iterations) = curvature_from(&pulled_away(0.99 * least), 0.0);
    assert_eq!((curvature, iterations), (Curvature::Positive, 0));
    // Ipopt stops at once here too.
    let (curvature, _, iterations) = curvature_from(&pulled_away(1.01 * least), 0.0);
    assert_eq!(iterations, 0);
    let Curvature::Negative { direction: controls } = curvature else { panic!("{curvature:?}") };
    assert_eq!(controls.len(), STEPS);
    let (sum, squares) =
        controls.rows().fold((0.0, 0.0), |(sum, squares), u| (sum + u[0], squares + u[0].powi(2)));
    assert!(squares < 1.01 * least * (sum / least).powi(2), "{controls:?}");
}

#[test]
fn a_minimum_that_only_bounds_hold_is_one() {
    let pulled = || pulled_away(2.0 * STEPS as f64);
    let bounded_control = pulled().control_bounds(ComponentBounds::symmetric(&[0.7]));
    let (curvature, end, iterations) = curvature_from(&bounded_control, 0.1);
    assert!((end - 0.7).abs() < 1e-6 && iterations > 0, "{end}");
    assert_eq!(curvature, Curvature::Positive);

    let bounded_state = pulled().state_bounds(ComponentBounds::symmetric(&[0.7]));
    let (curvature, end, _) = curvature_from(&bounded_state, 0.1);
    assert!((end - 0.7).abs() < 1e-6, "{end}");
    assert_eq!(curvature, Curvature::Positive);

    let path =
        pulled().path_constraints(ComponentBounds::symmetric(&[0.49]), |x| vec![x[0].powi(3)]);
    let (curvature, end, _) = curvature_from(&path, 0.1);
    assert!((end.powi(3) - 0.49).abs() < 1e-6, "{end}");
    assert_eq!(curvature, Curvature::Positive);
}

#[test]
fn a_saddle_between_bounds_is_none_the_less_one() {
    let pulled = pulled_away(2.0 * STEPS as f64);
    let bounded = pulled.control_bounds(ComponentBounds::symmetric(&[0.7]));
    let (curvature, end, _) = curvature_from(&bounded, 0.0);
    assert_eq!(end, 0.0);
    assert!(matches!(curvature, Curvature::Negative { .. }), "{curvature:?}");
}

#[test]
fn a_point_of_another_grid_is_refused() {
    let functions = StageFunctions::compile(&pulled_away(1.0)).unwrap();
    let program =
        |steps| MultipleShooting::new(&functions, Grid::new(1.0, steps).unwrap(), &[0.0]).unwrap();
    let start = OcpStart::Guess(InitialGuess::constant(&[0.0], 1, 4));
    let solution = program(4).solve(&start, &Settings::default(), |_| Control::Continue).unwrap();
    let refused = program(5).curvature(&solution.point);
    assert!(matches!(refused, Err(OcpError::Dimension { what: "point", .. })));
}
