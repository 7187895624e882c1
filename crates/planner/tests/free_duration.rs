//! Durations that the plan chooses.

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_scenario::Scenario;
use righting_scenario::file::{Duration, DurationRange};
use righting_test_support::{by_hand, shipped, varied};

fn plan(scenario: &Scenario) -> Planned {
    Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap()
}

fn free(scenario: &Scenario, min: f64, max: f64, time: f64) -> Scenario {
    varied(scenario, |file| {
        file.horizon.duration_s = Duration::Free(DurationRange { min, max });
        file.weights.time = Some(time);
    })
}

fn assert_verified(planned: &Planned) {
    let verification = &planned.solution.verification;
    let failures: Vec<String> = verification.failures().map(ToString::to_string).collect();
    let (status, notes) = (planned.solution.status, &planned.solution.notes);
    assert!(verification.passed, "{status:?} {failures:?} {notes:?}");
}

/// The time against the effort: a duration that is given is no better than the one that was chosen.
#[test]
fn no_given_duration_is_better_than_the_chosen_one() {
    for name in ["slew_2dof", "slew_4dof"] {
        let scenario = free(&shipped(name), 5.0, 60.0, 1e-4);
        let chosen = plan(&scenario);
        assert_verified(&chosen);
        let chosen_s = chosen.solution.duration_s.unwrap();
        assert!((5.0..60.0).contains(&chosen_s), "{name}: {chosen_s}");
        assert!((chosen.trajectory.end().time_s - chosen_s).abs() < 1e-9 * chosen_s);
        for factor in [0.9, 0.97, 1.03, 1.1] {
            let given = varied(&shipped(name), |file| {
                file.horizon.duration_s = Duration::Given(factor * chosen_s);
            });
            let planned = plan(&given);
            let objective = planned.solution.objective + 1e-4 * factor * chosen_s;
            let best = chosen.solution.objective;
            assert!(objective > best * (1.0 - 1e-4), "{name} {factor}: {objective} {best}");
        }
    }
}

/// One joint that turns about the base's axis z through its centre of mass, with a rod of mass m and length l
/// that reaches out along x: with I_b the base's inertia about z and I_a the arm's about the joint, as far as
/// the system's centre of mass lets it, the base turns back by I_a/(I_a + I_b) of the joint's angle. From rest to
/// rest at the largest acceleration u the joint takes T = 2 √(q/u), or, at its largest rate v, q/v + v/u.
#[test]
fn the_fastest_turn_of_one_joint_is_bang_bang() {
    let arm = [by_hand::link(10.0, 2.0, 0.0, Some(150.0))];
    let (mass, length, base_mass) = (10.0, 2.0_f64, 100.0);
    let reduced = mass * base_mass / (mass + base_mass);
    let arm_inertia = mass * length.powi(2) / 12.0 + reduced * (0.5 * length).powi(2);
    let share = arm_inertia / (arm_inertia + base_mass / 6.0);
    for angle_deg in [2.0, 10.0, 40.0] {
        let joint_deg: f64 = angle_deg / share;
        let (rate, acceleration): (f64, f64) = (20.0, 10.0);
        let fastest_s = match joint_deg < rate * rate / acceleration {
            true => 2.0 * (joint_deg / acceleration).sqrt(),
            false => joint_deg / rate + rate / acceleration,
        };
        let scenario = varied(&by_hand::on_a_cube([0.0; 3], &arm), |file| {
            file.maneuver.angle_deg = Some(angle_deg);
            file.horizon.steps = 200.0;
            file.horizon.duration_s = Duration::Free(DurationRange { min: 0.1, max: 40.0 });
            file.weights.control = Some(1e-9);
            file.weights.time = Some(1.0);
        });
        let planned = plan(&scenario);
        assert_verified(&planned);
        let chosen_s = planned.solution.duration_s.unwrap();
        let off = chosen_s / fastest_s - 1.0;
        assert!(off.abs() < 0.005, "{angle_deg}: {chosen_s} s, {fastest_s} s by hand");
    }
}

#[test]
fn a_duration_at_the_edge_of_its_range_stays_in_it() {
    let longest = plan(&free(&shipped("slew_2dof"), 5.0, 20.0, 0.0));
    assert_verified(&longest);
    assert!((longest.solution.duration_s.unwrap() - 20.0).abs() < 1e-3);
    let shortest = plan(&free(&shipped("slew_2dof"), 35.0, 60.0, 1.0));
    assert_verified(&shortest);
    assert!((shortest.solution.duration_s.unwrap() - 35.0).abs() < 1e-3);
}
