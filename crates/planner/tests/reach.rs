//! What is possible at all is found from both sides, told with its evidence, and the same every time.

use std::f64::consts::TAU;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use righting_analysis::detumble::rate_bound_rad_s;
use righting_ocp::Control;
use righting_planner::reach::{LONGEST, Progress, Quantity, StartedFrom};
use righting_planner::{PlanError, Planner, Reach, ReachError, ReachSettings, reach};
use righting_results::{Status, Terminal};
use righting_scenario::Scenario;
use righting_test_support::{shipped, varied};
use righting_verifier::verify;

fn coarse(name: &str) -> Scenario {
    varied(&shipped(name), |file| file.horizon.steps = 60.0)
}

fn searched(scenario: &Scenario, settings: ReachSettings) -> Reach {
    reach(scenario, settings, &mut |_| Control::Continue).unwrap()
}

/// Whether a cold solve with this duration succeeds.
fn succeeds_in(scenario: &Scenario, duration_s: f64) -> bool {
    let scenario = varied(scenario, |file| {
        file.horizon.duration_s = righting_scenario::file::Duration::Given(duration_s)
    });
    let plan = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
    verify(&scenario, &plan.trajectory).passed
}

#[test]
fn the_shortest_duration_lies_between_failures_and_successes() {
    // What effort costs on 600 steps, it does on 60 with ten times the weight.
    let scenario = varied(&coarse("slew_2dof"), |file| file.weights.control = Some(0.1));
    let settings = ReachSettings { resolution: 4.0, ..ReachSettings::new(Quantity::Duration) };
    let mut started = Vec::new();
    let found = reach(&scenario, settings, &mut |progress| {
        if let Progress::Trying { value, start } = progress {
            started.push((value, start));
        }
        Control::Continue
    })
    .unwrap();
    let (pass, fail) = (found.first_succeeding.unwrap(), found.last_failing.unwrap());
    assert!(0.0 < pass - fail && pass - fail <= 0.04 * pass, "{fail} {pass}");
    assert!(succeeds_in(&scenario, 1.1 * pass) && !succeeds_in(&scenario, 0.9 * fail));
    // Every value on the easy side succeeded, every other failed, and only after a warm and a cold
    // start.
    for tried in &found.tries {
        assert_eq!(tried.succeeded, tried.duration_s >= pass, "{tried:?}");
        assert_eq!(tried.shortfall.is_none(), tried.succeeded);
        let starts = started.iter().filter(|(value, _)| *value == tried.duration_s);
        let starts: Vec<StartedFrom> = starts.map(|(_, start)| *start).collect();
        if !tried.succeeded {
            assert_eq!(starts, [StartedFrom::Neighbor, StartedFrom::Cold]);
        }
    }
    // The plan at the edge is the evidence.
    let edge = found.plan.as_ref().unwrap();
    assert_eq!(edge.scenario.horizon().duration_s, pass);
    assert!(verify(&edge.scenario, &edge.planned.trajectory).passed);
    // The weights give up before the arm does.
    assert!(found.notes[0].contains("effort costs too much"), "{:?}", found.notes);
    let cheap = varied(&scenario, |file| file.weights.control = Some(1e-5));
    let limits = searched(&cheap, settings);
    assert!(limits.first_succeeding.unwrap() < 0.95 * pass, "{:?}", limits.first_succeeding);
    assert!(limits.notes[0].contains("fails even with"), "{:?}", limits.notes);
}

/// One plan that chooses its duration finds the edge that the search finds step by step, or a shorter one, and it takes a
/// few tries to show it.
#[test]
fn the_fastest_plan_is_at_the_edge() {
    for (name, resolution) in
        [("slew_2dof", 2.0), ("slew_4dof", 2.0), ("slew_canadarm2_table", 4.0)]
    {
        let scenario = varied(&coarse(name), |file| {
            file.weights = righting_scenario::file::Weights::default();
            file.end = None;
        });
        let settings = ReachSettings { resolution, ..ReachSettings::new(Quantity::Duration) };
        let found = searched(&scenario, settings);
        let stepwise = searched(&scenario, ReachSettings { plans_fastest: false, ..settings });
        let [edge, compared] = [&found, &stepwise].map(|found| found.first_succeeding.unwrap());
        assert!(edge <= compared * (1.0 + 2.0 * resolution / 100.0), "{name}: {edge} {compared}");
        assert_eq!(found.tries[0].start, StartedFrom::Fastest, "{name}");
        assert!(found.tries.len() < stepwise.tries.len(), "{name}: {}", found.tries.len());
        let fail = found.last_failing.unwrap();
        assert!(0.0 < edge - fail && edge - fail <= resolution / 100.0 * edge, "{fail} {edge}");
        let plan = found.plan.unwrap();
        assert_eq!(plan.scenario.horizon().duration_s, edge);
        assert!(verify(&plan.scenario, &plan.planned.trajectory).passed);
    }
}

#[test]
fn a_search_that_begins_with_failure_goes_to_easier_values() {
    let scenario = varied(&coarse("slew_2dof"), |file| {
        file.horizon.duration_s = righting_scenario::file::Duration::Given(5.0)
    });
    let settings = ReachSettings { resolution: 20.0, ..ReachSettings::new(Quantity::Duration) };
    let found = searched(&scenario, settings);
    let pass = found.first_succeeding.unwrap();
    assert!((5.0..=10.0).contains(&pass) && found.last_failing.unwrap() >= 5.0);
    assert_eq!(found.tries[0].duration_s, 5.0);
    assert_eq!(found.tries[1].duration_s, 10.0);
    assert_eq!(found.tries, searched(&scenario, settings).tries);
}

#[test]
fn the_largest_angle_keeps_its_sign() {
    let scenario = varied(&coarse("slew_2dof"), |file| {
        file.maneuver.angle_deg = Some(-20.0);
        file.horizon.duration_s = righting_scenario::file::Duration::Given(10.0);
    });
    let settings = ReachSettings { resolution: 4.0, ..ReachSettings::new(Quantity::Angle) };
    let found = searched(&scenario, settings);
    let (pass, fail) = (found.first_succeeding.unwrap(), found.last_failing.unwrap());
    assert!(pass < fail && fail - pass <= 4.0, "{pass} {fail}");
    assert!(found.tries.iter().all(|tried| tried.angle_deg.is_some_and(|angle| angle < 0.0)));
    let edge = found.plan.unwrap();
    assert_eq!(edge.scenario.resolved().maneuver.angle_deg, Some(-pass));
    assert!(Terminal::reached(&edge.scenario, &edge.planned.trajectory).attitude_error <= 1e-3);
}

#[test]
fn a_detumble_needs_so_long_to_come_near_its_bound() {
    let scenario = coarse("detumble_2dof");
    let settings = ReachSettings { resolution: 10.0, ..ReachSettings::new(Quantity::Duration) };
    let found = searched(&scenario, settings);
    let goal = 1.02 * found.bound_deg_s.unwrap();
    for tried in &found.tries {
        assert!(tried.is_verified);
        assert_eq!(tried.succeeded, tried.terminal.angular_rate_deg_s <= goal, "{tried:?}");
    }
    assert!(found.first_succeeding.unwrap() < 30.0 && found.last_failing.is_some());
    let best = found.tries.iter().map(|tried| tried.terminal.angular_rate_deg_s);
    let percent = 100.0 * (best.fold(f64::INFINITY, f64::min) / goal * 1.02 - 1.0);
    assert!((found.closest_to_bound_percent().unwrap() - percent).abs() < 1e-9);
    let angle = reach(&scenario, ReachSettings::new(Quantity::Angle), &mut |_| Control::Continue);
    assert!(matches!(angle, Err(ReachError::NoAngle(_))));
}

#[test]
fn what_cannot_be_solved_is_out_of_reach() {
    let scenario = varied(&coarse("slew_2dof"), |file| file.solver.max_iterations = Some(1.0));
    let found = searched(&scenario, ReachSettings::new(Quantity::Duration));
    assert_eq!((found.first_succeeding, found.last_failing), (None, Some(LONGEST * 30.0)));
    assert!(found.plan.is_none() && found.tries.len() == 5);
    assert!(found.tries.iter().all(|tried| tried.status == Status::IterationLimit));
}

#[test]
fn angles_that_no_motion_makes_fail_without_a_solve() {
    // One joint within limits, about the base's own axis: the angle is all it has.
    let scenario = varied(&shipped("slew_2dof"), |file| {
        let righting_scenario::file::SystemReference::Inline(system) = &mut file.system else {
            panic!("a resolved system is inline")
        };
        system.mount.as_mut().unwrap().position_m = [0.0; 3];
        system.links.remove(0);
        system.links[0].theta_deg = 0.0;
        file.initial.joint_angles_deg = vec![0.0];
        file.initial.joint_rates_deg_s = None;
        file.maneuver.axis = Some([0.0, 0.0, 1.0]);
        file.maneuver.angle_deg = Some(60.0);
        file.horizon.duration_s = righting_scenario::file::Duration::Given(60.0);
        file.horizon.steps = 60.0;
    });
    let settings = ReachSettings { resolution: 4.0, ..ReachSettings::new(Quantity::Angle) };
    let found = searched(&scenario, settings);
    // By its ratio of inertias the rod turns the base so far within ± 90°.
    let (m, l, mass) = (25.0_f64, 1.0, 300.0);
    let rod = m * l * l / 12.0 + m * mass / (m + mass) * l * l / 4.0;
    let most = 90.0 * rod / (mass * 0.25 / 6.0 + rod);
    let (pass, fail) = (found.first_succeeding.unwrap(), found.last_failing.unwrap());
    assert!(pass <= most && most <= fail && fail - pass <= 4.0, "{pass} {most} {fail}");
    for tried in found.tries.iter().filter(|tried| !tried.succeeded) {
        assert!(tried.iterations == 0 && tried.objective.is_nan(), "{tried:?}");
        let shortfall = tried.shortfall.as_ref().unwrap();
        assert!(shortfall.starts_with("impossible: only joint 1"), "{shortfall}");
    }
    // Across, no angle is possible, and the search says why.
    let across = varied(&scenario, |file| file.maneuver.axis = Some([1.0, 0.0, 0.0]));
    let refused = reach(&across, settings, &mut |_| Control::Continue);
    assert!(matches!(refused, Err(ReachError::Plan(PlanError::Impossible(_)))), "{refused:?}");
}

#[test]
fn a_search_that_is_stopped_keeps_what_it_has() {
    let scenario = coarse("slew_2dof");
    let mut decided = 0;
    let found = reach(&scenario, ReachSettings::new(Quantity::Duration), &mut |progress| {
        decided += usize::from(matches!(progress, Progress::Tried(_)));
        if decided == 2 { Control::Stop } else { Control::Continue }
    })
    .unwrap();
    assert!(found.is_interrupted);
    assert_eq!((found.tries.len(), found.first_succeeding), (2, Some(22.5)));
    let found = reach(&scenario, ReachSettings::new(Quantity::Duration), &mut |_| Control::Stop);
    assert!(found.unwrap().tries.is_empty());
}

#[test]
fn no_clear_posture_has_more_inertia_than_the_bound_says() {
    // The last arm's posture of most inertia collides; the others are kept so far apart that it
    // might.
    let scenarios =
        [("detumble_2dof", 0.05), ("detumble_4dof", 0.05), ("detumble_canadarm2", 0.01)];
    for (name, clearance_m) in scenarios {
        let scenario = varied(&shipped(name), |file| {
            file.collision.clearance_m = Some(clearance_m);
            file.horizon.steps = 60.0;
        });
        let system = scenario.system();
        let momentum = scenario.initial().angular_momentum_n_m_s.norm();
        let largest = momentum / rate_bound_rad_s(&scenario);
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut uniform = || random.random::<f64>();
        let mut most = 0.0_f64;
        for _ in 0..4000 {
            let limits = system.joint_limits.iter();
            let posture: Vec<f64> = limits
                .map(|limits| match limits.angle_max_rad - limits.angle_min_rad {
                    range if range.is_finite() => limits.angle_min_rad + range * uniform(),
                    _ => TAU * uniform(),
                })
                .collect();
            let kinematics = system.model.kinematics(&posture);
            let is_clear = scenario
                .collision()
                .clearances(&kinematics)
                .all(|clearance| clearance.distance_m >= clearance.least_m);
            if is_clear {
                let inertia = system.model.locked_inertia(&posture);
                most = most.max(inertia.symmetric_eigenvalues().max());
            }
        }
        assert!(0.8 * largest < most && most <= largest, "{name}: {most} {largest}");
        // A plan climbs towards the posture of most inertia too.
        let plan = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
        let end = &plan.trajectory.end().joint_angles_rad;
        let inertia = system.model.locked_inertia(end).symmetric_eigenvalues().max();
        assert!(inertia <= largest * (1.0 + 1e-6), "{name}: {inertia} {largest}");
    }
}

#[test]
fn angles_whose_target_is_outside_a_cone_fail_without_a_solve() {
    let scenario = varied(&shipped("slew_2dof"), |file| {
        file.horizon.duration_s = righting_scenario::file::Duration::Given(60.0);
        file.horizon.steps = 60.0;
        let axis = nalgebra::Vector3::from(file.maneuver.axis.unwrap()).normalize();
        let across = axis.cross(&nalgebra::Vector3::x()).normalize();
        file.pointing = vec![righting_scenario::file::Pointing {
            name: "camera".to_owned(),
            boresight_body: across.into(),
            direction_inertial: Some(across.into()),
            direction_table: None,
            keep_out_deg: None,
            keep_in_deg: Some(23.0),
        }];
    });
    let settings = ReachSettings { resolution: 2.0, ..ReachSettings::new(Quantity::Angle) };
    let found = searched(&scenario, settings);
    let (pass, fail) = (found.first_succeeding.unwrap(), found.last_failing.unwrap());
    assert!(pass <= 23.0 && 23.0 < fail && fail - pass <= 2.0, "{pass} {fail}");
    let refused = found.tries.iter().find(|tried| tried.value(Quantity::Angle) == fail).unwrap();
    assert_eq!(refused.iterations, 0);
    assert!(refused.shortfall.as_ref().unwrap().contains("pointing[0].keep_in_deg"), "{refused:?}");
}
