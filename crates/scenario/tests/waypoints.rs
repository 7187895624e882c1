//! Waypoints of a slew: their targets, and when each is reached.

use std::path::Path;

use righting_multibody::Quaternion;
use righting_scenario::file::{self, Duration, DurationRange, Guess, NamedGuess, Waypoint};
use righting_scenario::{Error, Scenario, schema};
use righting_test_support::json_schema::violation;
use righting_test_support::shipped;

const AXIS: [f64; 3] = [0.0, 0.6, 0.8];

fn to_angle(angle_deg: f64) -> Waypoint {
    Waypoint { axis: Some(AXIS), angle_deg: Some(angle_deg), ..Waypoint::default() }
}

/// A slew of the 4-joint arm by 30° about the axis in 60 s and 120 steps.
fn with(change: impl FnOnce(&mut file::Scenario)) -> Result<Scenario, Error> {
    let mut file = shipped("slew_4dof").resolved().clone();
    file.maneuver.axis = Some(AXIS);
    file.maneuver.angle_deg = Some(30.0);
    file.horizon.duration_s = Duration::Given(60.0);
    file.horizon.steps = 120.0;
    change(&mut file);
    Scenario::from_file(file, Path::new("plan.json"))
}

fn by_way_of(waypoints: &[Waypoint]) -> Result<Scenario, Error> {
    with(|file| file.maneuver.waypoints = waypoints.to_vec())
}

fn nodes(scenario: &Scenario) -> Vec<[usize; 2]> {
    scenario.waypoints().iter().map(|waypoint| waypoint.nodes(120)).collect()
}

#[track_caller]
fn assert_refused(refused: Result<Scenario, Error>, field: &str, message: &str) {
    let refused = refused.expect_err(message).to_string();
    assert!(refused.contains(field), "`{refused}` does not name `{field}`");
    assert!(refused.contains(message), "`{refused}` does not say `{message}`");
}

#[test]
fn ways_share_the_time_by_their_angles() {
    // 10°, 20° and 60° of turn in 60 s less 15 s of rest: 5, 10 and 30 s.
    let hold = Waypoint { dwell_s: Some(15.0), ..to_angle(-10.0) };
    let scenario = by_way_of(&[hold, to_angle(-30.0)]).unwrap();
    assert_eq!(nodes(&scenario), [[10, 40], [60, 60]]);
    let legs = scenario.legs();
    let angles: Vec<f64> = legs.iter().map(|leg| leg.angle_rad.to_degrees().round()).collect();
    assert_eq!(angles, [10.0, 20.0, 60.0]);
    assert_eq!([legs[1].start, legs[1].end, legs[2].end], [40.0 / 120.0, 60.0 / 120.0, 1.0]);
    let target = Quaternion::from_axis_angle(&AXIS.into(), (-10.0_f64).to_radians());
    assert!(scenario.waypoints()[0].target.angle_to(&target) < 1e-12);
    assert!(scenario.waypoints()[0].is_at_rest);
}

#[test]
fn given_times_are_kept_and_rounded_to_steps() {
    let slow = Waypoint { duration_s: Some(20.1), dwell_s: Some(0.6), ..to_angle(10.0) };
    let scenario = by_way_of(&[slow]).unwrap();
    assert_eq!(nodes(&scenario), [[40, 41]]);
    let notes = scenario.notes().join("; ");
    assert!(notes.contains("maneuver.waypoints[0].duration_s: taken as 20 s"), "{notes}");
    assert!(notes.contains("maneuver.waypoints[0].dwell_s: taken as 0.5 s"), "{notes}");
}

/// The resolved file has all times and means the same; the schema allows it.
#[test]
fn a_resolved_file_says_it_all() {
    let last = Waypoint { dwell_s: Some(10.0), rest: Some(false), ..to_angle(20.0) };
    for own_target in [true, false] {
        let scenario = with(|file| {
            file.maneuver.waypoints = vec![to_angle(10.0), last.clone()];
            if !own_target {
                file.maneuver.axis = None;
                file.maneuver.angle_deg = None;
            }
        });
        let scenario = scenario.unwrap();
        let resolved = scenario.resolved();
        assert!(resolved.maneuver.waypoints.iter().all(|waypoint| waypoint.duration_s.is_some()
            && waypoint.dwell_s.is_some()
            && waypoint.rest.is_some()));
        let again = Scenario::from_file(resolved.clone(), Path::new("again.json")).unwrap();
        assert_eq!(again.resolved(), resolved);
        assert_eq!(again.waypoints(), scenario.waypoints());
        let json = serde_json::to_value(resolved).unwrap();
        assert_eq!(violation(&schema::scenario_schema(), &json), None);
        if !own_target {
            // It ends in the last one, which is held until the end.
            assert_eq!(nodes(&scenario)[1], [100, 120]);
            let slew = scenario.maneuver().slew().unwrap();
            assert!((slew.angle_rad.to_degrees() - 20.0).abs() < 1e-12);
        }
    }
}

#[test]
fn a_longer_plan_stretches_all_times() {
    let hold = Waypoint { dwell_s: Some(15.0), ..to_angle(-10.0) };
    let scenario = by_way_of(&[hold, to_angle(-30.0)]).unwrap();
    let longer = scenario.varied(|file| file.stretch_to_s(90.0)).unwrap();
    assert_eq!(nodes(&longer), nodes(&scenario));
    assert!((longer.horizon().duration_s - 90.0).abs() < 1e-12);
}

#[test]
fn bad_waypoints_are_refused_by_their_fields() {
    let one = |change: fn(&mut Waypoint)| {
        let mut waypoint = to_angle(10.0);
        change(&mut waypoint);
        by_way_of(&[to_angle(5.0), waypoint])
    };
    let at = |field: &str| format!("maneuver.waypoints[1].{field}");
    assert_refused(one(|w| w.axis = None), &at("axis"), "missing");
    assert_refused(one(|w| w.angle_deg = None), &at("angle_deg"), "missing");
    assert_refused(one(|w| w.angle_deg = Some(181.0)), &at("angle_deg"), "from -180 to 180");
    assert_refused(one(|w| w.axis = Some([0.0; 3])), &at("axis"), "not zero");
    assert_refused(one(|w| w.axis = Some([f64::NAN; 3])), &at("axis[0]"), "expected a number");
    let both = one(|w| w.target_attitude = Some([1.0, 0.0, 0.0, 0.0]));
    assert_refused(both, &at("target_attitude"), "either target_attitude, or axis and angle_deg");
    let no_unit = one(|w| {
        *w = Waypoint { target_attitude: Some([1.0, 1.0, 0.0, 0.0]), ..Waypoint::default() };
    });
    assert_refused(no_unit, &at("target_attitude"), "a unit quaternion");
    assert_refused(one(|w| w.dwell_s = Some(-1.0)), &at("dwell_s"), "a number from 0 to");
    assert_refused(one(|w| w.dwell_s = Some(f64::NAN)), &at("dwell_s"), "a number from 0 to");
    assert_refused(one(|w| w.duration_s = Some(f64::INFINITY)), &at("duration_s"), "a number from");
    assert_refused(one(|w| w.duration_s = Some(0.1)), &at("duration_s"), "a step of the horizon");
    let too_long = one(|w| w.dwell_s = Some(61.0));
    assert_refused(too_long, "maneuver.waypoints:", "at most horizon.duration_s, 60");
    let nothing_left = one(|w| w.duration_s = Some(60.0));
    assert_refused(nothing_left, "maneuver.waypoints", "a step of the horizon");
    assert_refused(by_way_of(&vec![to_angle(5.0); 101]), "maneuver.waypoints:", "at most 100");
    assert_refused(
        with(|file| {
            file.maneuver.waypoints = vec![to_angle(5.0)];
            file.horizon.duration_s = Duration::Free(DurationRange { min: 10.0, max: 60.0 });
        }),
        "horizon.duration_s",
        "maneuver.waypoints do not go with a free duration",
    );
    assert_refused(
        with(|file| {
            file.maneuver.waypoints = vec![to_angle(5.0)];
            file.solver.guess = Some(Guess::Named(NamedGuess::Constant));
        }),
        "solver.guess",
        "maneuver.waypoints do not go with the constant one",
    );
    let detumble = with(|file| {
        file.maneuver = shipped("detumble_4dof").resolved().maneuver.clone();
        file.initial.angular_rate_deg_s = Some([0.0, 3.0, 4.0]);
        file.maneuver.waypoints = vec![to_angle(5.0)];
    });
    assert_refused(detumble, "maneuver.waypoints", "none for a detumble");
}
