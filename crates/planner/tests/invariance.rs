//! The same maneuver in other units, and in other body axes, is the same plan.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use righting_ocp::Control;
use righting_planner::Planner;
use righting_results::Trajectory;
use righting_scenario::Scenario;
use righting_scenario::file::{self, SystemReference};
use righting_test_support::units::Units;
use righting_test_support::{shipped, varied};

/// How far joint angles may differ, rad, and rates and accelerations in units of the maneuver's own time.
const SAME: f64 = 1e-6;
/// The same in turned axes, where the numbers round otherwise: the objective is so flat that the optimizer's
/// tolerance leaves this much (3e-5 was seen).
const SAME_WHEN_TURNED: f64 = 1e-4;

/// A slew of the 4-joint arm and a detumble of the 2-joint arm, without weights of the end.
fn maneuvers() -> [Scenario; 2] {
    ["slew_4dof", "detumble_2dof"].map(|name| {
        varied(&shipped(name), |file| {
            file.horizon.steps = 120.0;
            file.weights = file::Weights::default();
            file.end = None;
        })
    })
}

fn planned(scenario: &Scenario) -> Trajectory {
    let planned = Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap();
    let failures: Vec<_> = planned.solution.verification.failures().collect();
    assert!(planned.solution.verification.passed, "{failures:?}");
    planned.trajectory
}

/// Both in a unit of time of their own.
fn assert_same_joint_motion(a: &Trajectory, b: &Trajectory, same: f64) {
    let (a_s, b_s) = (a.end().time_s, b.end().time_s);
    for (x, y) in a.nodes().iter().zip(b.nodes()) {
        for (x, y) in x.joint_angles_rad.iter().zip(&y.joint_angles_rad) {
            assert!((x - y).abs() < same, "{x} {y}");
        }
        for (x, y) in x.joint_rates_rad_s.iter().zip(&y.joint_rates_rad_s) {
            assert!((x * a_s - y * b_s).abs() < 10.0 * same, "{} {}", x * a_s, y * b_s);
        }
    }
}

fn system(file: &mut file::Scenario) -> &mut file::System {
    match &mut file.system {
        SystemReference::Inline(system) => system,
        SystemReference::File(_) => unreachable!("a resolved system is inline"),
    }
}

#[test]
fn masses_lengths_and_times_in_any_unit_give_the_same_plan() {
    for scenario in maneuvers() {
        let plan = planned(&scenario);
        for (mass, length, time) in
            [(1e6, 1.0, 1.0), (1e-6, 1e3, 1.0), (1.0, 1e-3, 1e2), (1.0, 1.0, 1e-2)]
        {
            let scaled = varied(&scenario, |file| *file = Units { length, mass, time }.of(file));
            assert_same_joint_motion(&plan, &planned(&scaled), SAME);
        }
    }
}

#[test]
fn a_plan_does_not_depend_on_the_choice_of_body_axes() {
    for scenario in maneuvers() {
        let plan = planned(&scenario);
        for wxyz in [[0.5, 0.5, 0.5, 0.5], [0.3, -0.7, 0.2, 0.6]] {
            let [w, x, y, z] = wxyz;
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            let turned = |v: [f64; 3]| -> [f64; 3] { (turn * Vector3::from(v)).into() };
            let other = varied(&scenario, |file| {
                file.maneuver.axis = file.maneuver.axis.map(turned);
                file.initial.angular_rate_deg_s = file.initial.angular_rate_deg_s.map(turned);
                let mount = &mut system(file).mount.as_mut().unwrap();
                mount.position_m = turned(mount.position_m);
                let [x, y, z, w]: [f64; 4] = turn.coords.into();
                mount.rotation = Some([w, x, y, z]);
            });
            assert_same_joint_motion(&plan, &planned(&other), SAME_WHEN_TURNED);
        }
    }
}

/// On finer grids the maneuver is the same one.
#[test]
fn a_finer_grid_gives_the_same_maneuver() {
    let [scenario, _] = maneuvers();
    let cost = |steps: f64| {
        let scenario = varied(&scenario, |file| file.horizon.steps = steps);
        let planned = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
        assert!(planned.solution.verification.passed);
        planned.solution.objective
    };
    let [coarse, middle, fine] = [60.0, 600.0, 6000.0].map(cost);
    assert!((coarse / fine - 1.0).abs() < 0.02, "{coarse} {fine}");
    assert!((middle / fine - 1.0).abs() < 2e-4, "{middle} {fine}");
}
