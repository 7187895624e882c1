//! A slew that misses its target says what would help, and that does help.

use std::time::Duration;

use nalgebra::Vector3;
use righting_multibody::Quaternion;
use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::Scenario;
use righting_scenario::file::Pointing;
use righting_test_support::{shipped, varied};
use righting_verifier::verify;

/// The 2-joint slew in so many seconds, with the effort of 600 steps on 60.
fn slew_in(duration_s: f64, control: f64) -> Scenario {
    varied(&shipped("slew_2dof"), |file| {
        file.horizon.duration_s = righting_scenario::file::Duration::Given(duration_s);
        file.horizon.steps = 60.0;
        file.weights.control = Some(control);
    })
}

fn planned(scenario: &Scenario) -> Planned {
    let mut planner = Planner::new().remedy_time(Duration::from_secs(3600));
    planner.plan(scenario, &mut |_| Control::Continue).unwrap()
}

fn passes(scenario: &Scenario) -> bool {
    verify(scenario, &planned(scenario).trajectory).passed
}

/// The number after `before` in the note that names it.
fn named(notes: &[String], before: &str) -> f64 {
    let named = notes.iter().find_map(|note| note.strip_prefix(before));
    let number = named.and_then(|rest| rest.split(' ').next());
    number.and_then(|number| number.parse().ok()).unwrap_or_else(|| panic!("{notes:?}"))
}

#[test]
fn where_effort_costs_too_much_less_weight_and_more_time_are_tried() {
    let scenario = slew_in(8.0, 0.1);
    let notes = planned(&scenario).solution.notes;
    assert!(notes[0].starts_with("misses its target by 0."), "{notes:?}");
    assert!(notes[1].contains("effort is in the way"), "{notes:?}");
    let longer_s = named(&notes, "horizon.duration_s ");
    assert!((8.0..16.0).contains(&longer_s), "{notes:?}");
    assert!(passes(&slew_in(longer_s, 0.1)));
    assert!(passes(&slew_in(8.0, named(&notes, "weights.control "))));
}

#[test]
fn where_limits_are_in_the_way_they_are_named_and_more_time_is_tried() {
    let scenario = slew_in(6.0, 1e-4);
    let notes = planned(&scenario).solution.notes;
    assert!(notes.iter().any(|note| note.contains("limit") && note.ends_with("% of the time")));
    let longer_s = named(&notes, "horizon.duration_s ");
    assert!((6.0..12.0).contains(&longer_s) && passes(&slew_in(longer_s, 1e-4)), "{notes:?}");
    assert!(!notes.iter().any(|note| note.starts_with("weights.control")), "{notes:?}");
}

/// The boresight half-way on the shortest turn is in the middle of a cone.
#[test]
fn a_cone_across_the_way_is_named() {
    let free = slew_in(7.0, 1e-4);
    let slew = free.maneuver().slew().unwrap().clone();
    let boresight = Vector3::x();
    let [middle, end] = [0.5, 1.0].map(|share| {
        let turn = Quaternion::from_axis_angle(&slew.axis, share * slew.angle_rad);
        turn.to_inertial(&boresight)
    });
    let scenario = varied(&free, |file| {
        file.pointing = vec![Pointing {
            name: "tracker and Sun".to_owned(),
            boresight_body: boresight.into(),
            direction_inertial: Some(middle.into()),
            direction_table: None,
            keep_out_deg: Some(0.7 * middle.angle(&end).to_degrees()),
            keep_in_deg: None,
        }];
    });
    let said = |scenario: &Scenario| {
        let notes = planned(scenario).solution.notes;
        assert!(
            notes[0].starts_with("misses its target") || notes[0].contains("limit"),
            "{notes:?}"
        );
        notes.join("; ")
    };
    let notes = said(&scenario);
    let through = "the shortest turn goes through the cone of \"tracker and Sun\"";
    assert!(notes.contains(through), "{notes}");
    assert!(!said(&free).contains("cone"));
}

#[test]
fn a_slew_that_nothing_asks_for_says_so() {
    let aimless = varied(&slew_in(30.0, 0.01), |file| file.weights.attitude = Some(0.0));
    let notes = planned(&aimless).solution.notes;
    assert_eq!(notes[1..], ["nothing asks for the target: weights.attitude is 0"], "{notes:?}");
}

#[test]
fn a_slew_that_arrives_has_nothing_to_say() {
    assert!(planned(&slew_in(30.0, 0.01)).solution.notes.is_empty());
}
