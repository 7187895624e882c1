//! Whole maneuvers with the stage solver and with MUMPS.

use righting_ocp::{Control, UsedLinearSolver};
use righting_planner::{Plan, plan};
use righting_scenario::file::{Formulation, Guess, LinearSolver, NamedGuess};
use righting_test_support::{shipped, varied};

fn planned(
    name: &str,
    steps: usize,
    formulation: Formulation,
    linear_solver: LinearSolver,
) -> Plan {
    let scenario = varied(&shipped(name), |file| {
        file.horizon.steps = steps as f64;
        file.solver.formulation = Some(formulation);
        file.solver.guess = Some(Guess::Named(NamedGuess::Constant));
        file.solver.linear_solver = Some(linear_solver);
    });
    plan(&scenario, &mut |_| Control::Continue).unwrap()
}

fn assert_same_optimum(name: &str, steps: usize, formulation: Formulation) {
    let [mumps, stage] = [LinearSolver::Mumps, LinearSolver::Stage]
        .map(|linear_solver| planned(name, steps, formulation, linear_solver));
    let case = format!("{name}, {formulation:?}, {steps} steps");
    assert_eq!(mumps.linear_solver, UsedLinearSolver::Mumps);
    assert_eq!(stage.linear_solver, UsedLinearSolver::Stage);
    assert!(stage.status.is_acceptable(), "{case}: {:?}", stage.status);
    assert_eq!(stage.status, mumps.status, "{case}");
    let apart = (stage.objective / mumps.objective - 1.0).abs();
    assert!(apart <= 1e-8, "{case}: {:e} and {:e}", stage.objective, mumps.objective);
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
