//! Attitudes on the way are judged by the second integration, and rest there by its rates.

use righting_results::{Check, Trajectory, WaypointRecord};
use righting_scenario::Scenario;
use righting_scenario::file::Waypoint;
use righting_test_support::{motion, shipped, swing, varied};
use righting_verifier::verify;

const STEPS: usize = 100;

/// A swing of the 4-joint arm, a pause of twenty steps in its middle, and the same swing again.
fn paused() -> (Scenario, Trajectory) {
    let scenario = varied(&shipped("slew_4dof"), |file| file.horizon.steps = STEPS as f64);
    let half = varied(&scenario, |file| {
        file.horizon.steps = 40.0;
        file.horizon.duration_s = righting_scenario::file::Duration::Given(12.0);
    });
    let (swing, pause) = (swing(&half), vec![vec![0.0; 4]; 20]);
    let plan = motion(&scenario, &[swing.clone(), pause, swing].concat());
    (scenario, plan)
}

/// The scenario with the attitude of a node as a waypoint there, held for so many steps.
fn by_way_of(scenario: &Scenario, plan: &Trajectory, node: usize, steps: usize) -> Scenario {
    let step_s = scenario.horizon().step_s();
    varied(scenario, |file| {
        file.maneuver.waypoints = vec![Waypoint {
            target_attitude: Some(plan.nodes()[node].state().attitude.normalized().to_array()),
            duration_s: Some(node as f64 * step_s),
            dwell_s: Some(steps as f64 * step_s),
            ..Waypoint::default()
        }];
    })
}

fn checks(scenario: &Scenario, plan: &Trajectory) -> [Check; 3] {
    let verification = verify(scenario, plan);
    let names = ["attitude error", "angular rate", "joint rate"];
    names.map(|name| verification.check(&format!("{name} at a waypoint")).unwrap().clone())
}

#[test]
fn a_pause_at_a_waypoint_is_held_and_at_rest() {
    let (scenario, plan) = paused();
    let asked = by_way_of(&scenario, &plan, 40, 20);
    for check in checks(&asked, &plan) {
        assert!(check.passed, "{check}");
        assert_eq!(check.subject.as_deref(), Some("waypoint 1"));
    }
    let [record] = WaypointRecord::reached(&asked, &plan)[..] else { panic!("one waypoint") };
    assert!((record.arrival_s - 12.0).abs() < 1e-9 && (record.departure_s - 18.0).abs() < 1e-9);
    assert!(record.attitude_error < 1e-9 && record.joint_rate_deg_s < 1e-9, "{record:?}");
}

/// Within a step whose acceleration goes from a to −a a joint goes from rest to rest: only between the nodes does
/// it move.
#[test]
fn a_joint_that_moves_between_the_nodes_of_a_dwell_is_caught() {
    let (scenario, plan) = paused();
    let asked = by_way_of(&scenario, &plan, 40, 20);
    let step_s = asked.horizon().step_s();
    let mut intervals = plan.intervals().to_vec();
    for interval in &mut intervals {
        interval.joint_jerks_rad_s3 = vec![0.0; 4];
    }
    let most = 0.05;
    for (interval, acceleration) in intervals[48..50].iter_mut().zip([most, -most]) {
        interval.joint_accelerations_rad_s2[1] = acceleration;
        interval.joint_jerks_rad_s3[1] = -2.0 * acceleration / step_s;
    }
    let [_, _, joints] =
        checks(&asked, &Trajectory::new(plan.nodes().to_vec(), intervals).unwrap());
    // The rate is a (t − t²/T), looked at after 0.4 T.
    let expected_deg_s = (most * 0.24 * step_s).to_degrees();
    assert!((joints.value - expected_deg_s).abs() < 1e-6 * expected_deg_s, "{joints}");
    assert!(!joints.passed, "{joints}");
}

#[test]
fn a_waypoint_that_is_missed_or_left_too_early_is_caught() {
    let (scenario, plan) = paused();
    // Held longer than the arm rests: the attitude is lost, and nothing is at rest at the end.
    let [attitude, base, joints] = checks(&by_way_of(&scenario, &plan, 40, 40), &plan);
    assert!(!joints.passed && joints.time_s.unwrap() > 18.0, "{joints}");
    assert!(base.value > 0.0 && attitude.value > 1e-6, "{base} {attitude}");
    // Reached on the way: in its attitude, but not at rest.
    let [attitude, _, joints] = checks(&by_way_of(&scenario, &plan, 20, 0), &plan);
    assert!(attitude.passed && !joints.passed, "{attitude} {joints}");
    // Another attitude.
    let elsewhere = varied(&by_way_of(&scenario, &plan, 40, 20), |file| {
        file.maneuver.waypoints[0].target_attitude = Some([0.8, 0.6, 0.0, 0.0]);
    });
    let [attitude, _, joints] = checks(&elsewhere, &plan);
    assert!(!attitude.passed && joints.passed, "{attitude} {joints}");
    assert!(!verify(&elsewhere, &plan).passed);
}
