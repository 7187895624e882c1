//! Plans reach the attitude and the posture that they are asked to end in.

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::file::{End, Guess, NamedGuess};
use righting_scenario::{Maneuver, Scenario, file};
use righting_test_support::{shipped, varied};

fn plan(scenario: &Scenario) -> Planned {
    Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap()
}

#[track_caller]
fn assert_verified(planned: &Planned) {
    let failures: Vec<String> =
        planned.solution.verification.failures().map(ToString::to_string).collect();
    let Planned { solution, .. } = planned;
    assert!(
        solution.verification.passed,
        "{:?} {failures:?} {:?}",
        solution.status, solution.notes
    );
}

fn ending_at(name: &str, angles_deg: &[Option<f64>]) -> Scenario {
    varied(&shipped(name), |file| {
        file.horizon.steps = 120.0;
        file.end =
            Some(End { hard: None, joint_angles_deg: Some(angles_deg.to_vec()), ..End::default() });
    })
}

/// Every given joint ends where it is asked to.
#[track_caller]
fn assert_ends_at(planned: &Planned, angles_deg: &[Option<f64>]) {
    assert_verified(planned);
    let end = &planned.trajectory.end().joint_angles_rad;
    for (joint, (found, asked)) in end.iter().zip(angles_deg).enumerate() {
        if let Some(asked) = asked {
            assert!((found - asked.to_radians()).abs() < 1e-6, "joint {joint}: {found}");
        }
    }
    assert!(planned.solution.verification.check("joint angle at the end").is_some());
}

#[test]
fn an_absolute_target_is_the_same_maneuver_as_an_axis_and_an_angle() {
    let turned = varied(&shipped("slew_2dof"), |file| {
        file.horizon.steps = 120.0;
        file.initial.attitude = Some([0.5, 0.5, -0.5, 0.5]);
    });
    let Maneuver::Slew(slew) = turned.maneuver() else { panic!("a slew") };
    let objective = plan(&turned).solution.objective;
    for sign in [1.0, -1.0] {
        let absolute = varied(&turned, |file| {
            file.maneuver.axis = None;
            file.maneuver.angle_deg = None;
            file.maneuver.target_attitude = Some(slew.target.to_array().map(|entry| sign * entry));
        });
        let planned = plan(&absolute);
        assert_verified(&planned);
        let change = planned.solution.objective / objective - 1.0;
        assert!(change.abs() < 1e-6, "{change}");
    }
}

#[test]
fn slews_end_in_the_posture_asked() {
    for (name, angles_deg) in [
        ("slew_2dof", vec![Some(0.0), Some(0.0)]),
        ("slew_4dof", vec![Some(0.0); 4]),
        ("slew_4dof", vec![None, Some(30.0), None, Some(-20.0)]),
        ("slew_4dof", vec![Some(170.0), None, Some(50.0), None]),
        ("slew_canadarm2", [0.0, 0.0, 97.5, 0.0, 90.0, 0.0, 0.0].map(Some).to_vec()),
    ] {
        assert_ends_at(&plan(&ending_at(name, &angles_deg)), &angles_deg);
    }
}

#[test]
fn traded_ends_and_the_paper_s_guess_keep_the_posture_too() {
    let angles_deg = [Some(20.0), Some(-10.0), None, None];
    for change in
        [(|file| file.weights.attitude = Some(1000.0)) as fn(&mut file::Scenario), |file| {
            file.solver.guess = Some(Guess::Named(NamedGuess::Constant))
        }]
    {
        let scenario = varied(&ending_at("slew_4dof", &angles_deg), |file| {
            file.end.as_mut().unwrap().hard = Some(false);
            change(file);
        });
        assert_ends_at(&plan(&scenario), &angles_deg);
    }
}

#[test]
fn detumbles_end_in_the_posture_asked() {
    for (name, angles_deg) in [
        ("detumble_2dof", vec![None, Some(80.0)]),
        ("detumble_4dof", vec![None, Some(60.0), Some(20.0), None]),
    ] {
        assert_ends_at(&plan(&ending_at(name, &angles_deg)), &angles_deg);
    }
}
