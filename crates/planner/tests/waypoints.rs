//! Slews with waypoints in one plan, judged from the table alone.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_results::Node;
use righting_scenario::file::{self, SystemReference, Waypoint};
use righting_scenario::{Maneuver, Scenario};
use righting_test_support::{scenarios, shipped, varied};

const AXIS: [f64; 3] = [0.74, 0.02, 0.68];

fn plan(scenario: &Scenario) -> Planned {
    let planned = Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap();
    let verification = &planned.solution.verification;
    let failures: Vec<String> = verification.failures().map(ToString::to_string).collect();
    assert!(verification.passed, "{:?}: {failures:?}", planned.solution.status);
    planned
}

fn to_angle(angle_deg: f64) -> Waypoint {
    Waypoint { axis: Some(AXIS), angle_deg: Some(angle_deg), ..Waypoint::default() }
}

/// A slew of the 4-joint arm by way of these.
fn by_way_of(waypoints: &[Waypoint], angle_deg: f64, duration_s: f64) -> Scenario {
    varied(&shipped("slew_4dof"), |file| {
        file.maneuver.angle_deg = Some(angle_deg);
        file.maneuver.waypoints = waypoints.to_vec();
        file.horizon.duration_s = file::Duration::Given(duration_s);
        file.horizon.steps = (4.0 * duration_s).round();
    })
}

/// The angle between a node's attitude and that turned about the axis by so much from none, deg.
fn miss_deg(node: &Node, angle_deg: f64) -> f64 {
    let [w, x, y, z] = node.attitude;
    let found = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let axis = Vector3::from(AXIS).normalize();
    let asked = UnitQuaternion::from_scaled_axis(axis * angle_deg.to_radians());
    found.angle_to(&asked).to_degrees()
}

fn fastest_deg_s(node: &Node) -> f64 {
    let joints = node.joint_rates_rad_s.iter().map(|rate| rate.abs()).fold(0.0, f64::max);
    joints.max(Vector3::from(node.angular_rate_rad_s).norm()).to_degrees()
}

#[test]
fn the_shipped_slew_turns_holds_and_turns_back() {
    let scenario = Scenario::read(&scenarios().join("real/slew_4dof_and_back.json")).unwrap();
    let planned = plan(&scenario);
    let nodes = planned.trajectory.nodes();
    let step_s = scenario.horizon().step_s();
    let [record] = planned.solution.waypoints.as_slice() else { panic!("one waypoint") };
    assert!((record.arrival_s - 30.0).abs() < 1e-9 && (record.departure_s - 40.0).abs() < 1e-9);
    assert!(record.attitude_error < 1e-4 && record.joint_rate_deg_s < 1e-2, "{record:?}");
    for (k, node) in nodes.iter().enumerate() {
        let time_s = k as f64 * step_s;
        if (30.0..=40.0).contains(&time_s) {
            assert!(miss_deg(node, 20.0) < 0.01, "{time_s}: {}", miss_deg(node, 20.0));
            assert!(fastest_deg_s(node) < 0.01, "{time_s}: {}", fastest_deg_s(node));
        }
    }
    assert!(miss_deg(planned.trajectory.end(), 0.0) < 0.01);
    assert!(fastest_deg_s(&nodes[150]) > 0.1 && fastest_deg_s(&nodes[550]) > 0.1);
    let check = planned.solution.verification.check("joint rate at a waypoint").unwrap();
    assert_eq!(check.subject.as_deref(), Some("waypoint 1"));
}

/// Two targets before a third, the first passed without a stop: as much effort as without it or more, and less
/// than with a stop there.
#[test]
fn a_waypoint_is_passed_or_stopped_at() {
    let passed = Waypoint { rest: Some(false), ..to_angle(10.0) };
    let stopped = Waypoint { rest: Some(true), ..to_angle(10.0) };
    let [direct, passing, stopping] =
        [&[][..], &[passed], &[stopped]].map(|waypoints| plan(&by_way_of(waypoints, 20.0, 40.0)));
    let at_middle = |planned: &Planned| planned.trajectory.nodes()[80].clone();
    assert!(miss_deg(&at_middle(&passing), 10.0) < 0.01);
    assert!(miss_deg(&at_middle(&stopping), 10.0) < 0.01);
    assert!(fastest_deg_s(&at_middle(&passing)) > 0.1);
    assert!(fastest_deg_s(&at_middle(&stopping)) < 0.01);
    let efforts = [&direct, &passing, &stopping].map(|planned| planned.solution.objective);
    assert!(efforts[0] <= efforts[1] * 1.001 && efforts[1] < efforts[2], "{efforts:?}");
}

/// A slew that ends in its last waypoint, with times of its own and a posture to end in.
#[test]
fn times_of_legs_are_those_of_the_file() {
    let first = Waypoint { duration_s: Some(15.0), dwell_s: Some(5.0), ..to_angle(10.0) };
    let scenario = varied(&by_way_of(&[first, to_angle(-10.0)], 0.0, 50.0), |file| {
        file.maneuver.axis = None;
        file.maneuver.angle_deg = None;
        file.end = Some(file::End {
            hard: None,
            joint_angles_deg: Some(vec![Some(10.0), None, None, None]),
            ..file::End::default()
        });
    });
    let Maneuver::Slew(slew) = scenario.maneuver() else { panic!("a slew") };
    assert!((slew.angle_rad.to_degrees() + 10.0).abs() < 1e-9);
    let planned = plan(&scenario);
    let nodes = planned.trajectory.nodes();
    assert!(nodes[60..=80].iter().all(|node| miss_deg(node, 10.0) < 0.01));
    assert!(miss_deg(&nodes[59], 10.0) > 0.0 && fastest_deg_s(&nodes[100]) > 0.1);
    assert!(miss_deg(&nodes[200], -10.0) < 0.02, "{}", miss_deg(&nodes[200], -10.0));
    assert!((nodes[200].joint_angles_rad[0].to_degrees() - 10.0).abs() < 1e-3);
}

/// With limited jerks, the arm rests without acceleration; the full form and a cone go with it too.
#[test]
fn waypoints_go_with_jerks_cones_and_the_full_form() {
    let hold = Waypoint { dwell_s: Some(5.0), ..to_angle(10.0) };
    let scenario = varied(&by_way_of(&[hold], 0.0, 45.0), |file| {
        let SystemReference::Inline(system) = &mut file.system else { unreachable!("resolved") };
        system.links[1].jerk_max_deg_s3 = Some(2.0);
        file.solver.formulation = Some(file::Formulation::Full);
        file.pointing = vec![file::Pointing {
            name: "antenna".to_owned(),
            boresight_body: [0.0, 0.0, 1.0],
            direction_inertial: Some([0.0, 0.0, 1.0]),
            direction_table: None,
            keep_out_deg: None,
            keep_in_deg: Some(15.0),
        }];
    });
    let planned = plan(&scenario);
    for k in 80..100 {
        let accelerations = planned.trajectory.joint_accelerations_at(k);
        assert!(accelerations.iter().all(|u| u.abs() < 1e-4), "{k}: {accelerations:?}");
    }
}

/// Wheels turn the base while the joints rest: a stop at a single node is one of the base too. Surroundings go with it.
#[test]
fn the_base_stops_at_waypoints_with_wheels_too() {
    let file = scenarios().join("wheels/slew_4dof_and_back_wheels.json");
    let shipped = Scenario::read(&file).unwrap();
    plan(&shipped);
    let scenario = varied(&shipped, |file| {
        file.maneuver.waypoints[0].dwell_s = Some(0.0);
        file.maneuver.waypoints[0].duration_s = None;
        let gravity_gradient = Some(file::GravityGradient {
            altitude_km: 400.0,
            orbit_attitude: None,
            elements: None,
        });
        file.environment = Some(file::Environment { gravity_gradient, ..Default::default() });
    });
    let planned = plan(&scenario);
    let [record] = planned.solution.waypoints.as_slice() else { panic!("one waypoint") };
    assert_eq!(record.arrival_s, record.departure_s);
    let fastest = planned.trajectory.nodes().iter().map(fastest_deg_s).fold(0.0, f64::max);
    assert!(record.angular_rate_deg_s < 0.02 * fastest, "{record:?} {fastest}");
}

/// The plan of one grid starts the next.
#[test]
fn a_plan_with_waypoints_starts_from_an_earlier_one() {
    let scenario = by_way_of(&[to_angle(10.0)], 0.0, 40.0);
    let first = plan(&scenario);
    let finer = varied(&scenario, |file| file.horizon.steps = 240.0);
    let mut planner = Planner::new().warm_start(&first.trajectory);
    let planned = planner.plan(&finer, &mut |_| Control::Continue).unwrap();
    assert!(planned.solution.verification.passed);
    assert!((planned.solution.objective / first.solution.objective - 1.0).abs() < 0.02);
}
