//! Masses that are estimated from a flight, against those that the plant has.

use nalgebra::Vector3;
use righting_flight::Plant;
use righting_multibody::{MassFactors, Quaternion};
use righting_ocp::Control;
use righting_planner::{MassEstimate, Measured, Planner};
use righting_scenario::file::SystemReference;
use righting_test_support::shipped;
use righting_verifier::model::State;

/// A plant of the verifier's whose masses differ from the scenario's.
#[test]
fn a_flight_shows_how_the_arm_turns_the_base() {
    let scenario = shipped("slew_4dof");
    let planned = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
    let plan = &planned.trajectory;
    let factors = [0.92, 1.06, 0.95, 1.08, 0.93];
    let heavier = scenario
        .varied(|file| {
            let SystemReference::Inline(system) = &mut file.system else { unreachable!() };
            system.base.inertia_kg_m2 =
                Some([[11.5, 0.0, 0.0], [0.0, 11.5, 0.0], [0.0, 0.0, 11.5]]);
            system.base.keep_out_radius_m =
                system.base.cube_side_m.take().map(|side| side * 0.75_f64.sqrt());
            system.base.mass_kg *= factors[0];
            for (link, factor) in system.links.iter_mut().zip(&factors[1..]) {
                link.mass_kg *= factor;
            }
        })
        .unwrap();
    let mut plant = Plant::new(heavier.resolved_system(), None, &State::of_node(plan.start()));
    let mut estimate = MassEstimate::new(&scenario, plan, 0.0);
    for (step, interval) in plan.intervals().iter().enumerate() {
        let step_s = plan.nodes()[step + 1].time_s - plan.nodes()[step].time_s;
        plant.advance(&interval.joint_accelerations_rad_s2, step_s);
        if (step + 1) % 10 == 0 {
            let state = plant.state();
            let measured = Measured {
                attitude: Quaternion::from_array(state.attitude_wxyz()),
                joint_angles_rad: state.joint_angles,
                joint_rates_rad_s: state.joint_rates,
            };
            estimate.observe(plan.nodes()[step + 1].time_s, &measured).unwrap();
            assert!(estimate.attitude().angle_to(&measured.attitude) < 1e-4);
        }
    }

    // How the base turns with the joints along the plan, by the three models.
    let estimated = estimate.scenario().unwrap();
    let rate = |scenario: &righting_scenario::Scenario, k: usize| {
        let node = &plan.nodes()[k];
        let (q, rates) = (&node.joint_angles_rad, &node.joint_rates_rad_s);
        scenario.system().model.reduced_angular_rate(q, rates, &Vector3::zeros())
    };
    let off = |scenario| -> f64 {
        (0..600).map(|k| (rate(scenario, k) - rate(&heavier, k)).norm()).sum()
    };
    assert!(off(&scenario) > 0.05, "{}: the models hardly differ", off(&scenario));
    assert!(off(&estimated) < 0.02 * off(&scenario), "{} of {}", off(&estimated), off(&scenario));
}

/// Measurements of a plant as planned teach nothing, and what is not finite is passed over.
#[test]
fn a_plant_as_planned_leaves_the_masses_alone() {
    let scenario = shipped("slew_2dof");
    let planned = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
    let mut estimate = MassEstimate::new(&scenario, &planned.trajectory, 1e-5);
    for node in planned.trajectory.nodes().iter().skip(1).step_by(20) {
        let mut measured = Measured {
            attitude: Quaternion::from_array(node.attitude),
            joint_angles_rad: &node.joint_angles_rad,
            joint_rates_rad_s: &node.joint_rates_rad_s,
        };
        estimate.observe(node.time_s, &measured).unwrap();
        measured.attitude = Quaternion::from_array([f64::NAN; 4]);
        estimate.observe(node.time_s + 0.01, &measured).unwrap();
    }
    for MassFactors { mass, inertia } in estimate.factors() {
        assert!((mass - 1.0).abs() < 5e-3 && (inertia - 1.0).abs() < 5e-3, "{mass}, {inertia}");
    }
}
