//! Whole maneuvers with the stage solver and with MUMPS.

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::file::{Formulation, Guess, LinearSolverChoice, NamedGuess};
use righting_test_support::{shipped, varied};

fn planned(
    name: &str,
    steps: usize,
    formulation: Formulation,
    linear_solver: LinearSolverChoice,
) -> Planned {
    let scenario = varied(&shipped(name), |file| {
        file.horizon.steps = steps as f64;
        file.solver.formulation = Some(formulation);
        file.solver.guess = Some(Guess::Named(NamedGuess::Constant));
        file.solver.linear_solver = Some(linear_solver);
    });
    Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap()
}

fn assert_same_optimum(name: &str, steps: usize, formulation: Formulation) {
    let [mumps, stage] = [LinearSolverChoice::Mumps, LinearSolverChoice::Stage]
        .map(|linear_solver| planned(name, steps, formulation, linear_solver));
    let case = format!("{name}, {formulation:?}, {steps} steps");
    assert!(mumps.solution.versions.linear_solver.starts_with("mumps "));
    assert_eq!(stage.solution.versions.linear_solver, "stage");
    assert!(stage.solution.status.is_acceptable(), "{case}: {:?}", stage.solution.status);
    assert_eq!(stage.solution.status, mumps.solution.status, "{case}");
    let apart = (stage.solution.objective / mumps.solution.objective - 1.0).abs();
    assert!(
        apart <= 1e-8,
        "{case}: {:e} and {:e}",
        stage.solution.objective,
        mumps.solution.objective
    );
}

#[test]
fn slews_have_the_same_optimum_in_the_reduced_form() {
    assert_same_optimum("slew_2dof", 200, Formulation::Reduced);
    assert_same_optimum("slew_4dof", 120, Formulation::Reduced);
}

#[test]
fn slews_have_the_same_optimum_in_the_full_form() {
    assert_same_optimum("slew_2dof", 100, Formulation::Full);
    assert_same_optimum("slew_4dof", 60, Formulation::Full);
}

#[test]
fn detumbles_have_the_same_optimum_in_the_reduced_form() {
    assert_same_optimum("detumble_2dof", 200, Formulation::Reduced);
    assert_same_optimum("detumble_4dof", 120, Formulation::Reduced);
}

#[test]
fn detumbles_have_the_same_optimum_in_the_full_form() {
    assert_same_optimum("detumble_2dof", 100, Formulation::Full);
    assert_same_optimum("detumble_4dof", 60, Formulation::Full);
}
