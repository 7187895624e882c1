//! Flights with plants that are as planned, and with others.

use righting_flight::{
    Campaign, Control, Faults, Flight, JointDrives, Recording, Sensors, Settings, Spreads, Stuck,
    Summary,
};
use righting_planner::Planner;
use righting_results::Trajectory;
use righting_scenario::Scenario;
use righting_scenario::file::{Environment, GravityGradient};
use righting_test_support::{shipped, varied};

fn planned(name: &str) -> (Scenario, Trajectory) {
    let scenario = shipped(name);
    let plan = plan_of(&scenario);
    (scenario, plan)
}

fn plan_of(scenario: &Scenario) -> Trajectory {
    let planned = Planner::new().plan(scenario, &mut |_| righting_ocp::Control::Continue).unwrap();
    assert!(planned.solution.verification.passed);
    planned.trajectory
}

fn fly(scenario: &Scenario, plan: &Trajectory, settings: Settings, count: usize) -> Vec<Flight> {
    Campaign::new(scenario, plan, settings).unwrap().fly(count, &|| false)
}

/// The median errors of what is flown, and open loop.
fn medians_deg(summary: &Summary) -> [f64; 2] {
    [summary.flown, summary.open_loop].map(|ends| ends.final_error_deg.median.unwrap())
}

const AS_PLANNED: Settings = Settings {
    spreads: Spreads { masses: 0.0, inertias: 0.0, centers_m: 0.0, mount_m: 0.0 },
    drives: JointDrives { lag_s: 0.0, noise: 0.0 },
    sensors: Sensors { attitude_rad: 0.0, joint_angle_rad: 0.0, joint_rate_rad_s: 0.0 },
    faults: Faults { lost_measurements: 0.0, missed_replans: 0.0, stuck: None },
    control: Control::Replan,
    period_s: 5.0,
    delay_s: 0.0,
    estimates_masses: true,
    deadline: None,
    seed: 0,
};

#[test]
fn a_plant_as_planned_ends_as_planned_with_replans_and_without() {
    let (scenario, plan) = planned("slew_4dof");
    let flight = &fly(&scenario, &plan, AS_PLANNED, 1)[0];
    assert!(flight.open_loop.unwrap().error_rad < 1e-4, "{:?}", flight.open_loop);
    assert!(flight.flown.error_rad < 1e-4, "{:?}", flight.flown);
    assert_eq!((flight.log.replans.len(), flight.log.missed), (5, 0));
}

#[test]
fn replans_bring_other_plants_to_the_target() {
    let (scenario, plan) = planned("slew_4dof");
    let settings = Settings { period_s: 1.0, ..Settings::default() };
    let summary = Summary::of(&fly(&scenario, &plan, settings, 8));
    let [replanned, open_loop] = medians_deg(&summary);
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
    assert_eq!((flight.log.replans.len(), flight.log.missed), (0, 5));
    assert_eq!(Some(flight.flown), flight.open_loop);
}

/// Without the masses that a flight shows, replans on a wrong model bring it nearer; with them, much nearer.
#[test]
fn masses_that_the_flight_shows_bring_it_nearer() {
    let (scenario, plan) = planned("slew_4dof");
    let median = |estimates_masses| {
        let settings = Settings { estimates_masses, ..Settings::default() };
        let summary = Summary::of(&fly(&scenario, &plan, settings, 8));
        summary.flown.final_error_deg.median.unwrap()
    };
    let (with_plan_masses, with_shown_masses) = (median(false), median(true));
    assert!(
        with_shown_masses < 0.2 * with_plan_masses,
        "{with_shown_masses}° of {with_plan_masses}°"
    );
}

/// A plant off so far, with noise and gravity gradient, that a replan from the last multipliers fails: the motion
/// without them is solved to its end, and no replan is missed.
#[test]
fn replans_of_a_large_slew_go_on() {
    let gradient = GravityGradient { altitude_km: 400.0, orbit_attitude: None, elements: None };
    let scenario = varied(&shipped("slew75_4dof"), |file| {
        file.environment =
            Some(Environment { gravity_gradient: Some(gradient), ..Environment::default() });
    });
    let plan = plan_of(&scenario);
    let settings = Settings {
        sensors: Sensors {
            attitude_rad: 0.005_f64.to_radians(),
            joint_angle_rad: 0.005_f64.to_radians(),
            joint_rate_rad_s: 0.002_f64.to_radians(),
        },
        ..Settings::default()
    };
    let flight = Campaign::new(&scenario, &plan, settings).unwrap().flight(2);
    let [flown, open_loop] =
        [flight.flown, flight.open_loop.unwrap()].map(|end| end.error_rad.to_degrees());
    assert_eq!((flight.log.replans.len(), flight.log.missed), (119, 0));
    assert!(open_loop > 5.0 && flown < 0.05, "{flown}° of {open_loop}°");
}

/// What a plan made with the true masses leaves is the least; replans come within 2 % of it.
#[test]
fn detumbles_end_as_if_the_masses_were_known() {
    let (scenario, plan) = planned("detumble_4dof");
    let campaign = Campaign::new(&scenario, &plan, Settings::default()).unwrap();
    for number in 0..4 {
        let recording = campaign.recorded(number).unwrap();
        let known = Planner::new()
            .plan(&recording.scenario, &mut |_| righting_ocp::Control::Continue)
            .unwrap();
        assert!(known.solution.verification.passed);
        let least = known.solution.terminal.angular_rate_deg_s;
        let flown = recording.flight.flown.rate_rad_s.to_degrees();
        assert!(
            flown < 1.02 * least,
            "flight {number}: {flown} deg/s, {least} deg/s with known masses"
        );
    }
}

/// The recorded motion is one of a free-floating system: the plant's own verifier finds its motion right.
#[test]
fn recorded_flights_move_as_their_plants_do() {
    let (scenario, plan) = planned("slew_2dof");
    let settings = Settings { period_s: 5.0, ..Settings::default() };
    let campaign = Campaign::new(&scenario, &plan, settings).unwrap();
    let recording = campaign.recorded(1).unwrap();
    assert_eq!(recording.flight.flown, campaign.flight(1).flown);
    let report = righting_verifier::verify(&recording.scenario, &recording.flown);
    let failed: Vec<String> = report
        .failures()
        .map(ToString::to_string)
        .filter(|check| !check.contains("end") && !check.contains("attitude error"))
        .collect();
    assert!(failed.is_empty(), "{failed:?}");
}

/// Lost measurements, missed replans and a joint that sticks: the flight goes on to its end, and its record says so.
#[test]
fn what_fails_is_recorded_and_the_flight_goes_on() {
    let (scenario, plan) = planned("slew_4dof");
    let faults = Faults {
        lost_measurements: 0.3,
        missed_replans: 0.3,
        stuck: Some(Stuck { joint: 1, time_s: 12.0 }),
    };
    for control in [Control::Feedback, Control::Replan, Control::Both] {
        let settings = Settings { faults, control, ..Settings::default() };
        let campaign = Campaign::new(&scenario, &plan, settings).unwrap();
        let Recording { flight, flown, .. } = campaign.recorded(0).unwrap();
        assert!(flight.flown.is_finite());
        assert!(flight.log.lost > 0, "{control:?}");
        if control.has_replans() {
            assert!(flight.log.missed > 0 && !flight.log.replans.is_empty(), "{control:?}");
            assert_eq!(flight.log.missed + flight.log.replans.len(), 29, "{control:?}");
        }
        let stuck_at = flown.nodes()[242].joint_angles_rad[1];
        assert!((flown.end().joint_angles_rad[1] - stuck_at).abs() < 1e-9);
        assert!((flown.nodes()[200].joint_angles_rad[1] - stuck_at).abs() > 1e-3);
    }
}

/// All measurements lost: the plan is flown as it is.
#[test]
fn without_measurements_the_plan_is_flown_as_it_is() {
    let (scenario, plan) = planned("slew_2dof");
    let blind = Faults { lost_measurements: 1.0, ..Faults::default() };
    for control in [Control::Feedback, Control::Replan, Control::Both] {
        let settings = Settings { faults: blind, control, ..Settings::default() };
        let flight = Campaign::new(&scenario, &plan, settings).unwrap().flight(0);
        assert_eq!(Some(flight.flown), flight.open_loop, "{control:?}");
    }
}

/// Joints that come late and imprecisely, and replans that do: what is seen is mended.
#[test]
fn lags_and_delays_are_mended_by_replans() {
    let (scenario, plan) = planned("slew_4dof");
    let settings = Settings {
        drives: JointDrives { lag_s: 0.1, noise: 0.02 },
        delay_s: 0.2,
        ..Settings::default()
    };
    let summary = Summary::of(&fly(&scenario, &plan, settings, 6));
    let [flown, open_loop] = medians_deg(&summary);
    assert!(flown < 0.2 * open_loop, "{flown}° of {open_loop}°");
}

#[test]
fn feedback_between_replans_brings_other_plants_to_the_target() {
    let (scenario, plan) = planned("slew_4dof");
    let settings = Settings {
        control: Control::Both,
        period_s: 5.0,
        estimates_masses: false,
        ..Settings::default()
    };
    let both = Summary::of(&fly(&scenario, &plan, settings, 8));
    let replans = Settings { control: Control::Replan, ..settings };
    let replans = Summary::of(&fly(&scenario, &plan, replans, 8));
    let [both, replans] =
        [both, replans].map(|summary| summary.flown.final_error_deg.median.unwrap());
    println!("{both}° of {replans}°");
    assert!(both < 0.5 * replans, "{both}° with feedback between replans, {replans}° without");
}

#[test]
fn feedback_alone_brings_the_median_down_fivefold() {
    let (scenario, plan) = planned("slew_4dof");
    let settings = Settings { control: Control::Feedback, ..Settings::default() };
    let summary = Summary::of(&fly(&scenario, &plan, settings, 12));
    let [flown, open_loop] = medians_deg(&summary);
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
