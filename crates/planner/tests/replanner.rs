//! A maneuver planned anew on its way: from where it was planned to be, and from elsewhere.

use std::num::NonZeroU32;
use std::time::Duration;

use righting_multibody::Quaternion;
use righting_ocp::Control;
use righting_planner::{Measured, Planned, Planner, Replan, Replanner};
use righting_results::{Node, Trajectory};
use righting_scenario::{Maneuver, Scenario};
use righting_test_support::{shipped, varied};
use righting_verifier::DormandPrince;
use righting_verifier::model::{Model, Motion, Outside, State};

fn plan(scenario: &Scenario) -> Planned {
    Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap()
}

fn replanned(
    replanner: &mut Replanner,
    step: usize,
    node: &Node,
    attitude: Quaternion<f64>,
) -> Replan {
    let measured = Measured {
        attitude,
        joint_angles_rad: &node.joint_angles_rad,
        joint_rates_rad_s: &node.joint_rates_rad_s,
    };
    replanner.replan(step, &measured, None).unwrap().expect("a replan that converges")
}

/// The state after the steps of a replan, by the verifier's model.
fn flown(
    scenario: &Scenario,
    start: &Node,
    attitude: Quaternion<f64>,
    replan: &Replan,
) -> Vec<f64> {
    let model = Model::new(scenario.resolved_system());
    let mut motion = Motion::new(&model);
    let mut x = State::of_node(&Node { attitude: attitude.to_array(), ..start.clone() }).to_vec();
    // The rates that go with no momentum depend on the posture alone.
    let mut integrator = DormandPrince::new(x.len());
    for control in &replan.accelerations_rad_s2 {
        let step_s = scenario.horizon().step_s();
        assert!(integrator.advance(&mut x, step_s, |_, x, rate| {
            model.state_derivative(x, control, &Outside::default(), &mut motion, rate);
        }));
    }
    x
}

fn attitude(x: &[f64]) -> Quaternion<f64> {
    Quaternion::from_array(State::from_slice(x).attitude_wxyz()).normalized()
}

fn turned(attitude: [f64; 4], by_deg: f64) -> Quaternion<f64> {
    let half = 0.5 * by_deg.to_radians();
    let turn = Quaternion::from_array([half.cos(), 0.0, half.sin(), 0.0]);
    Quaternion::from_array(attitude).product(&turn).normalized()
}

/// Where everything is as planned, the rest of the plan is the plan.
#[test]
fn on_its_way_a_plan_stays_what_it_is() {
    for name in ["slew_2dof", "slew_4dof"] {
        let scenario = shipped(name);
        let plan: Trajectory = plan(&scenario).trajectory;
        let mut replanner = Replanner::new(&scenario, &plan).unwrap();
        let most = plan
            .intervals()
            .iter()
            .flat_map(|interval| &interval.joint_accelerations_rad_s2)
            .fold(0.0_f64, |most, u| most.max(u.abs()));
        for step in [20, 200, 400] {
            let node = &plan.nodes()[step];
            let attitude = Quaternion::from_array(node.attitude);
            let replan = replanned(&mut replanner, step, node, attitude);
            assert_eq!(replan.accelerations_rad_s2.len(), 600 - step);
            let planned = &plan.intervals()[step..];
            let rows = replan.accelerations_rad_s2.iter().zip(planned);
            let off = rows
                .flat_map(|(row, planned)| row.iter().zip(&planned.joint_accelerations_rad_s2))
                .fold(0.0_f64, |off, (new, old)| off.max((new - old).abs()));
            assert!(off < 2e-3 * most, "{name} from step {step}: {off} of {most} rad/s²");
        }
    }
}

/// A detumble's optimum is flat: the rest of it leaves the rate that was planned, by another model.
#[test]
fn the_rest_of_a_detumble_takes_out_as_much() {
    let scenario = shipped("detumble_4dof");
    let plan = plan(&scenario).trajectory;
    let mut replanner = Replanner::new(&scenario, &plan).unwrap();
    let norm = |rate: [f64; 3]| rate.iter().map(|w| w * w).sum::<f64>().sqrt();
    let planned = norm(plan.end().angular_rate_rad_s);
    for step in [20, 200, 400] {
        let node = &plan.nodes()[step];
        let here = Quaternion::from_array(node.attitude);
        let replan = replanned(&mut replanner, step, node, here);
        let end = flown(&scenario, node, here, &replan);
        let left = State::from_slice(&end).angular_rate.norm();
        assert!((left / planned - 1.0).abs() < 1e-4, "from step {step}: {left}, {planned} rad/s");
    }
}

/// Half a degree off, the rest of a slew still ends in its target, by another model.
#[test]
fn a_slew_that_is_off_comes_back_to_its_target() {
    for name in ["slew_2dof", "slew_4dof", "slew_canadarm2_table"] {
        let scenario = shipped(name);
        let Maneuver::Slew(slew) = scenario.maneuver() else { unreachable!("a slew") };
        let plan = plan(&scenario).trajectory;
        let mut replanner = Replanner::new(&scenario, &plan).unwrap();
        for step in [20, 300] {
            let node = &plan.nodes()[step];
            let off = turned(node.attitude, 0.5);
            let replan = replanned(&mut replanner, step, node, off);
            let end = flown(&scenario, node, off, &replan);
            let miss_deg = attitude(&end).angle_to(&slew.target).to_degrees();
            println!("{name} from step {step}: {miss_deg:.5}° in {} iterations", replan.iterations);
            assert!(miss_deg < 0.02, "{name} from step {step}: {miss_deg}°");
        }
    }
}

/// Two iterations from half a degree off end near the target, within a hundredth of the optimum.
#[test]
fn in_real_time_a_slew_comes_back_too() {
    for name in ["slew_4dof", "slew_canadarm2"] {
        let scenario = shipped(name);
        let Maneuver::Slew(slew) = scenario.maneuver() else { unreachable!("a slew") };
        let plan = plan(&scenario).trajectory;
        let converging = Replanner::new(&scenario, &plan).unwrap();
        let real_time = converging.clone().in_real_time(NonZeroU32::new(2).unwrap());
        let node = &plan.nodes()[20];
        let off = turned(node.attitude, 0.5);
        let optimum = replanned(&mut converging.clone(), 20, node, off);
        let replan = replanned(&mut real_time.clone(), 20, node, off);
        assert!(optimum.converged && replan.iterations <= 2);
        let above = replan.objective / optimum.objective - 1.0;
        assert!(above.abs() < 0.01, "{name}: {above} above");
        // What was told is what follows from the controls, by another model.
        let end = flown(&scenario, node, off, &replan);
        let miss_deg = attitude(&end).angle_to(&slew.target).to_degrees();
        println!("{name}: {miss_deg:.5}°, {above:.1e} above the optimum");
        assert!(miss_deg < 0.02, "{name}: {miss_deg}°");
    }
}

/// Without time for one iteration the last plan stands, and the next replan is none the worse.
#[test]
fn a_deadline_that_is_over_leaves_the_last_plan() {
    let scenario = shipped("slew_2dof");
    let plan = plan(&scenario).trajectory;
    let mut replanner = Replanner::new(&scenario, &plan).unwrap();
    let node = &plan.nodes()[20];
    let attitude = turned(node.attitude, 0.5);
    let measured = Measured {
        attitude,
        joint_angles_rad: &node.joint_angles_rad,
        joint_rates_rad_s: &node.joint_rates_rad_s,
    };
    let mut undisturbed = replanner.clone();
    // Nor does it matter that one of them is prepared.
    undisturbed.prepare(20).unwrap();
    assert_eq!(replanner.replan(20, &measured, Some(Duration::ZERO)).unwrap(), None);
    let after = replanned(&mut replanner, 20, node, attitude);
    let expected = replanned(&mut undisturbed, 20, node, attitude);
    assert_eq!(after.accelerations_rad_s2, expected.accelerations_rad_s2);
}

#[test]
fn what_is_no_measurement_is_refused_and_changes_nothing() {
    let scenario = shipped("slew_2dof");
    let plan = plan(&scenario).trajectory;
    let mut replanner = Replanner::new(&scenario, &plan).unwrap();
    let node = &plan.nodes()[100];
    let lost = Measured {
        attitude: Quaternion::from_array([f64::NAN; 4]),
        joint_angles_rad: &node.joint_angles_rad,
        joint_rates_rad_s: &node.joint_rates_rad_s,
    };
    assert!(replanner.replan(100, &lost, None).is_err());
    let attitude = Quaternion::from_array(node.attitude);
    replanned(&mut replanner, 100, node, attitude);
}

#[test]
fn a_plan_of_another_grid_is_refused() {
    let scenario = shipped("slew_2dof");
    let plan = plan(&scenario).trajectory;
    let finer = varied(&scenario, |file| file.horizon.steps = 300.0);
    let refused = Replanner::new(&finer, &plan).err().unwrap().to_string();
    assert_eq!(refused, "steps of the plan: found 600, expected 300");
}
