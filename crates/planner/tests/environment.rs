//! Maneuvers on which something acts from outside.

use nalgebra::Vector3;
use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::Scenario;
use righting_scenario::file::{Environment, Formulation, GravityGradient};
use righting_test_support::{shipped, varied};

fn plan(scenario: &Scenario) -> Planned {
    Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap()
}

fn in_environment(name: &str, environment: &Environment, formulation: Formulation) -> Scenario {
    varied(&shipped(name), |file| {
        file.environment = Some(environment.clone());
        file.solver.formulation = Some(formulation);
    })
}

#[track_caller]
fn assert_verified(planned: &Planned) {
    let verification = &planned.solution.verification;
    let failures: Vec<String> = verification.failures().map(ToString::to_string).collect();
    assert!(verification.passed, "{:?} {failures:?}", planned.solution.status);
}

fn end_momentum(scenario: &Scenario, planned: &Planned) -> Vector3<f64> {
    scenario.system().model.inertial_angular_momentum(&planned.trajectory.end().state())
}

/// A couple that stays where it is leaves τ T, whatever the plan does.
#[test]
fn a_constant_couple_leaves_its_momentum() {
    let torque = [2e-4, -1e-4, 3e-4];
    let environment = Environment { torque_inertial_n_m: Some(torque), ..Environment::default() };
    let scenario = in_environment("slew_4dof", &environment, Formulation::Reduced);
    let planned = plan(&scenario);
    assert_verified(&planned);
    let expected = Vector3::from(torque) * scenario.horizon().duration_s;
    let found = end_momentum(&scenario, &planned);
    assert!((found - expected).norm() < 1e-6 * expected.norm(), "{found} {expected}");
}

/// Both forms state one problem: three states of momentum here, the base's rate there.
#[test]
fn both_forms_have_the_same_optimum() {
    let gradient = GravityGradient { altitude_km: 400.0, orbit_attitude: None, elements: None };
    let environment = Environment {
        gravity_gradient: Some(gradient),
        torque_body_n_m: Some([1e-4, 0.0, -2e-4]),
        ..Environment::default()
    };
    let [reduced, full] = [Formulation::Reduced, Formulation::Full].map(|formulation| {
        let planned = plan(&in_environment("slew_2dof", &environment, formulation));
        assert_verified(&planned);
        planned.solution.objective
    });
    assert!((full / reduced - 1.0).abs() < 1e-4, "{full} {reduced}");
}

/// Drift that a spacecraft comes with stays, and the slew goes where it shall.
#[test]
fn residual_momentum_stays() {
    let scenario = varied(&shipped("slew_4dof"), |file| {
        file.environment = Some(Environment::default());
        file.initial.angular_rate_deg_s = Some([0.01, -0.02, 0.015]);
    });
    let planned = plan(&scenario);
    assert_verified(&planned);
    let kept = scenario.initial().angular_momentum_n_m_s;
    let found = end_momentum(&scenario, &planned);
    assert!((found - kept).norm() < 1e-6 * kept.norm(), "{found} {kept}");
    let without =
        varied(&shipped("slew_4dof"), |file| file.environment = Some(Environment::default()));
    let usual = plan(&without).solution.objective;
    let expected = plan(&shipped("slew_4dof")).solution.objective;
    assert!((usual / expected - 1.0).abs() < 1e-6, "{usual} {expected}");
}

/// A gravity gradient some millionths of the arm's torques changes nothing of what a detumble costs.
#[test]
fn a_slight_disturbance_leaves_a_detumble_as_good_as_without() {
    let gradient = GravityGradient { altitude_km: 400.0, orbit_attitude: None, elements: None };
    let environment = Environment { gravity_gradient: Some(gradient), ..Environment::default() };
    let [disturbed, undisturbed] = [
        in_environment("detumble_4dof", &environment, Formulation::Reduced),
        shipped("detumble_4dof"),
    ]
    .map(|scenario| {
        let planned = plan(&scenario);
        assert_verified(&planned);
        planned.solution.objective
    });
    assert!((disturbed / undisturbed - 1.0).abs() < 0.02, "{disturbed} {undisturbed}");
}
