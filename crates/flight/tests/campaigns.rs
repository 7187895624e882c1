//! Flights with plants that are as planned, and with others.

use righting_flight::{Campaign, Control, Flight, Sensors, Settings, Spreads, Summary};
use righting_planner::Planner;
use righting_results::Trajectory;
use righting_scenario::Scenario;
use righting_test_support::shipped;

fn planned(name: &str) -> (Scenario, Trajectory) {
    let scenario = shipped(name);
    let planned = Planner::new().plan(&scenario, &mut |_| righting_ocp::Control::Continue).unwrap();
    assert!(planned.solution.verification.passed);
    (scenario, planned.trajectory)
}

fn fly(scenario: &Scenario, plan: &Trajectory, settings: Settings, count: usize) -> Vec<Flight> {
    Campaign::new(scenario, plan, settings).unwrap().fly(count, &|| false)
}

const AS_PLANNED: Settings = Settings {
    spreads: Spreads { masses: 0.0, inertias: 0.0, centers_m: 0.0, mount_m: 0.0 },
    sensors: Sensors { attitude_rad: 0.0, joint_angle_rad: 0.0, joint_rate_rad_s: 0.0 },
    control: Control::Replan,
    period_s: 5.0,
    deadline: None,
    seed: 0,
};

#[test]
fn a_plant_as_planned_ends_as_planned_with_replans_and_without() {
    let (scenario, plan) = planned("slew_4dof");
    let flight = &fly(&scenario, &plan, AS_PLANNED, 1)[0];
    assert!(flight.open_loop.error_rad < 1e-4, "{:?}", flight.open_loop);
    assert!(flight.flown.error_rad < 1e-4, "{:?}", flight.flown);
    assert_eq!((flight.replans.len(), flight.missed), (5, 0));
}

#[test]
fn replans_bring_other_plants_to_the_target() {
    let (scenario, plan) = planned("slew_4dof");
    let settings = Settings { period_s: 1.0, ..Settings::default() };
    let summary = Summary::of(&fly(&scenario, &plan, settings, 8));
    let [replanned, open_loop] =
        [summary.flown, summary.open_loop].map(|ends| ends.final_error_deg.median.unwrap());
    println!("{summary:?}");
    assert_eq!((summary.completed, summary.missed_replans), (8, 0));
    assert!(open_loop > 0.1, "{open_loop}° open loop shows nothing");
    assert!(replanned < 0.2 * open_loop, "{replanned}° of {open_loop}°");
}

/// Each flight is the same whatever flies beside it, but for its times.
#[test]
fn a_flight_depends_on_its_seed_and_number_alone() {
    let (scenario, plan) = planned("slew_2dof");
    let noisy = Settings {
        sensors: Sensors { attitude_rad: 1e-4, joint_angle_rad: 1e-4, joint_rate_rad_s: 1e-4 },
        period_s: 5.0,
        ..Settings::default()
    };
    let ends = |flights: Vec<Flight>| -> Vec<_> {
        flights.into_iter().map(|flight| (flight.open_loop, flight.flown)).collect()
    };
    let six = ends(fly(&scenario, &plan, noisy, 6));
    assert_eq!(six[..3], ends(fly(&scenario, &plan, noisy, 3)));
    assert_ne!(six[0], six[1]);
    let other = ends(fly(&scenario, &plan, Settings { seed: 1, ..noisy }, 1));
    assert_ne!(six[0], other[0]);
}

/// A deadline that nothing meets: the plan is flown as it is, and the record says why.
#[test]
fn missed_replans_leave_the_plan_as_it_is() {
    let (scenario, plan) = planned("slew_2dof");
    let hurried = Settings {
        period_s: 5.0,
        deadline: Some(std::time::Duration::ZERO),
        ..Settings::default()
    };
    let flight = &fly(&scenario, &plan, hurried, 1)[0];
    assert_eq!((flight.replans.len(), flight.missed), (0, 5));
    assert_eq!(flight.flown, flight.open_loop);
}

#[test]
fn feedback_alone_brings_the_median_down_fivefold() {
    let (scenario, plan) = planned("slew_4dof");
    let settings = Settings { control: Control::Feedback, ..Settings::default() };
    let summary = Summary::of(&fly(&scenario, &plan, settings, 12));
    let [flown, open_loop] =
        [summary.flown, summary.open_loop].map(|ends| ends.final_error_deg.median.unwrap());
    println!("{summary:?}");
    assert!(flown < 0.2 * open_loop, "{flown}° of {open_loop}°");
}

#[test]
fn feedback_needs_a_target() {
    let (scenario, plan) = planned("detumble_2dof");
    let settings = Settings { control: Control::Feedback, ..Settings::default() };
    let refused = Campaign::new(&scenario, &plan, settings).err().unwrap().to_string();
    assert_eq!(refused, "feedback is for slews, this is a detumble");
}
