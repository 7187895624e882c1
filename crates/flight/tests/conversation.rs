//! A flight over pipes, with the verifier's model at the other end.

use std::io::{BufRead, BufReader, Write, pipe};
use std::thread;

use righting_flight::{Control, ConversationError, Guidance, Plant, Settings, fly_with};
use righting_planner::Planner;
use righting_results::Trajectory;
use righting_scenario::{Scenario, file};
use righting_test_support::shipped;
use righting_verifier::model::State;
use serde_json::{Value, json};

fn planned() -> (Scenario, Trajectory) {
    let scenario = shipped("slew_2dof");
    let planned = Planner::new().plan(&scenario, &mut |_| righting_ocp::Control::Continue).unwrap();
    (scenario, planned.trajectory)
}

/// Follows what it is told, and answers.
fn answer_for(plan: Trajectory, orders: impl BufRead, mut answers: impl Write) {
    let mut lines =
        orders.lines().map(|line| serde_json::from_str::<Value>(&line.unwrap()).unwrap());
    let opening = lines.next().unwrap();
    assert_eq!(opening["schema"], "righting.plant/1");
    assert_eq!(opening["steps"], 600);
    let mut system: file::System = serde_json::from_value(opening["system"].clone()).unwrap();
    system.links[1].mass_kg *= 1.1;
    let mut plant = Plant::new(&system, None, &State::of_node(plan.start()));
    for command in lines {
        let accelerations: Vec<f64> =
            serde_json::from_value(command["joint_accelerations_rad_s2"].clone()).unwrap();
        plant.advance(&accelerations, command["duration_s"].as_f64().unwrap());
        let state = plant.state();
        let answer = json!({
            "attitude": state.attitude_wxyz(),
            "joint_angles_rad": state.joint_angles,
            "joint_rates_rad_s": state.joint_rates,
            "angular_rate_rad_s": state.angular_rate.as_slice(),
        });
        writeln!(answers, "{answer}").unwrap();
    }
}

#[test]
fn a_plant_at_the_other_end_of_a_pipe_is_flown_to_the_target() {
    let (scenario, plan) = planned();
    let end = |control| {
        let settings = Settings { control, ..Settings::default() };
        let guidance = Guidance::new(&scenario, &plan, &settings).unwrap();
        let (orders, mut commands) = pipe().unwrap();
        let (answers, replies) = pipe().unwrap();
        let other_end = thread::spawn({
            let plan = plan.clone();
            move || answer_for(plan, BufReader::new(orders), replies)
        });
        let pipes = (&mut BufReader::new(answers), &mut commands);
        let flight = fly_with(&scenario, &plan, guidance, pipes).unwrap();
        drop(commands);
        other_end.join().unwrap();
        flight
    };
    let (open_loop, replanned) = (end(Control::OpenLoop), end(Control::Replan));
    assert_eq!((replanned.log.replans.len(), replanned.log.missed), (29, 0));
    let [open_loop, replanned] = [open_loop, replanned].map(|flight| flight.flown.error_rad);
    assert!(open_loop > 1e-3 && replanned < 0.1 * open_loop, "{replanned} of {open_loop}");
}

/// Silence and nonsense end the flight with an error that says what was expected.
#[test]
fn answers_that_are_none_are_named() {
    let (scenario, plan) = planned();
    let flown_with = |said: &str| {
        let settings = Settings { control: Control::OpenLoop, ..Settings::default() };
        let guidance = Guidance::new(&scenario, &plan, &settings).unwrap();
        fly_with(&scenario, &plan, guidance, (&mut said.as_bytes(), &mut Vec::new())).unwrap_err()
    };
    let silent = flown_with("");
    assert!(matches!(silent, ConversationError::Silent { step: 1, steps: 600 }));
    let few =
        "{\"attitude\": [1, 0, 0, 0], \"joint_angles_rad\": [0], \"joint_rates_rad_s\": [0, 0]}\n";
    assert_eq!(
        flown_with(few).to_string(),
        "the plant's answer to step 1: joint_angles_rad: found 1 values, expected 2"
    );
    let nonsense = flown_with("hello\n").to_string();
    assert!(
        nonsense.contains("step 1") && nonsense.contains("\"attitude\": [w, x, y, z]"),
        "{nonsense}"
    );
    assert!(
        flown_with("{\"attitude\": [1, 0, 0, 0], \"joints\": []}\n").to_string().contains("joints")
    );
}
