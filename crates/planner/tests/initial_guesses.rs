//! Where plans start from decides where they end: saddles are left, good starts found, an earlier
//! plan saves iterations.

use std::time::Duration;

use righting_ocp::Control;
use righting_planner::{PlanError, Planned, Planner};
use righting_results::solution::AttemptRecord;
use righting_results::{Status, Terminal};
use righting_scenario::Scenario;
use righting_scenario::file::{Guess, LowDiscrepancyStarts, NamedGuess};
use righting_test_support::{motion, shipped, solves, varied};
use righting_verifier::verify;

fn planned(scenario: &Scenario) -> Planned {
    Planner::new().plan(scenario, &mut |_| Control::Continue).unwrap()
}

/// The arm of a detumble straight up, where every joint's pull on the base vanishes by symmetry.
fn straight_up(name: &str, guess: NamedGuess) -> Scenario {
    varied(&shipped(name), |file| {
        file.horizon.steps = 120.0;
        file.initial.joint_angles_deg.fill(0.0);
        file.solver.guess = Some(Guess::Named(guess));
    })
}

#[test]
fn a_saddle_is_left() {
    for name in ["detumble_2dof", "detumble_4dof"] {
        let scenario = straight_up(name, NamedGuess::Constant);
        let plan = planned(&scenario);
        let reached = Terminal::reached(&scenario, &plan.trajectory);
        let reduction = reached.reduction_percent(&scenario);
        assert_eq!(plan.solution.status, Status::Solved, "{name}");
        assert!(reduction >= 45.0, "{name}: {reduction} %");
        assert!(reached.joint_rate_deg_s < 1.0, "{name}: {} deg/s", reached.joint_rate_deg_s);
        assert!(
            plan.solution.notes[0].starts_with("left a stationary point"),
            "{name}: {:?}",
            plan.solution.notes
        );
        assert!(verify(&scenario, &plan.trajectory).passed, "{name}");
    }
}

#[test]
fn a_saddle_is_left_where_the_solve_ends_on_its_first_point() {
    // Where the asked grid is the coarse one, the last solve starts at the saddle with its
    // multipliers and makes no iteration: nothing but the curvature there tells that it is one.
    for name in ["detumble_2dof", "detumble_4dof"] {
        let scenario = varied(&straight_up(name, NamedGuess::Constant), |file| {
            file.horizon.steps = 20.0;
        });
        let joints = scenario.system().joint_count();
        let still = motion(&scenario, &vec![vec![0.0; joints]; 20]);
        let plan =
            Planner::new().warm_start(&still).plan(&scenario, &mut |_| Control::Continue).unwrap();
        let reached = Terminal::reached(&scenario, &plan.trajectory);
        assert!(reached.reduction_percent(&scenario) >= 45.0, "{name}: {reached:?}");
        assert!(
            plan.solution.notes[0].starts_with("left a stationary point"),
            "{name}: {:?}",
            plan.solution.notes
        );
    }
}

#[test]
fn a_minimum_is_not_taken_for_a_saddle() {
    for name in ["slew_2dof", "detumble_2dof", "slew_4dof", "detumble_4dof"] {
        let scenario = varied(&shipped(name), |file| file.horizon.steps = 120.0);
        assert!(planned(&scenario).solution.notes.is_empty(), "{name}");
    }
}

#[test]
fn the_automatic_guess_detumbles_from_straight_up() {
    // The best of 64 starts ends with 3.316.
    let scenario = straight_up("detumble_4dof", NamedGuess::Auto);
    let plan = planned(&scenario);
    let reached = Terminal::reached(&scenario, &plan.trajectory);
    assert!(reached.reduction_percent(&scenario) >= 49.0, "{reached:?}");
    assert!(plan.solution.objective < 3.33, "{}", plan.solution.objective);
}

fn turned_by(angle_deg: f64) -> Scenario {
    varied(&shipped("slew75_4dof"), |file| {
        file.maneuver.angle_deg = Some(angle_deg);
        file.horizon.steps = 120.0;
        file.solver.guess = Some(Guess::Named(NamedGuess::Auto));
    })
}

/// On the coarse grid: the constant start, which comes first, and the earlier plan's, the last.
fn coarse_attempts(plan: &Planned) -> (&AttemptRecord, &AttemptRecord) {
    let first = &plan.solution.attempts[0];
    let mut coarse = plan.solution.attempts.iter().filter(|attempt| attempt.steps == first.steps);
    (first, coarse.next_back().unwrap())
}

#[test]
fn the_neighboring_angle_s_plan_saves_iterations() {
    let neighbor = planned(&turned_by(75.0));
    let scenario = turned_by(72.0);
    let cold = planned(&scenario);
    let warm = Planner::new()
        .warm_start(&neighbor.trajectory)
        .plan(&scenario, &mut |_| Control::Continue)
        .unwrap();
    assert_eq!((cold.solution.status, warm.solution.status), (Status::Solved, Status::Solved));
    let (from_constant, from_neighbor) = coarse_attempts(&warm);
    assert!(from_neighbor.iterations < from_constant.iterations, "{:?}", warm.solution.attempts);
    assert!(
        warm.solution.objective <= cold.solution.objective * 1.001,
        "{} {}",
        warm.solution.objective,
        cold.solution.objective
    );
    assert!(verify(&scenario, &warm.trajectory).passed);
}

#[test]
fn a_plan_of_another_duration_and_grid_is_a_start_too() {
    let neighbor = planned(&varied(&shipped("slew_2dof"), |file| file.horizon.steps = 90.0));
    let scenario = varied(&shipped("slew_2dof"), |file| {
        file.horizon.steps = 120.0;
        file.horizon.duration_s = file.horizon.duration_s.times(1.25);
    });
    let cold = planned(&scenario);
    let warm = Planner::new()
        .warm_start(&neighbor.trajectory)
        .plan(&scenario, &mut |_| Control::Continue)
        .unwrap();
    assert_eq!(warm.solution.status, Status::Solved);
    let (from_constant, from_neighbor) = coarse_attempts(&warm);
    assert!(from_neighbor.iterations < from_constant.iterations, "{:?}", warm.solution.attempts);
    assert!(warm.solution.objective <= cold.solution.objective * (1.0 + 1e-6));
}

#[test]
fn mirrored_starts_give_mirrored_plans() {
    // The arm bends in the plane normal to y: in that mirror its first joint turns the other way and
    // an axis of rotation, an axial vector, keeps its y alone.
    let slew = |axis: [f64; 3]| {
        varied(&shipped("slew_4dof"), |file| {
            file.maneuver.axis = Some(axis);
            file.maneuver.angle_deg = Some(30.0);
            file.horizon.steps = 120.0;
        })
    };
    let plan = planned(&slew([0.5, 0.6, 0.62]));
    let mirrored = varied(&slew([-0.5, 0.6, -0.62]), |file| {
        file.solver.guess = Some(Guess::Named(NamedGuess::Constant));
    });
    let image = Planner::new()
        .warm_start(&plan.trajectory)
        .plan(&mirrored, &mut |_| Control::Continue)
        .unwrap();
    let (from_constant, from_image) = coarse_attempts(&image);
    assert!(from_image.iterations < from_constant.iterations, "{:?}", image.solution.attempts);
    assert!(
        (image.solution.objective / plan.solution.objective - 1.0).abs() < 1e-6,
        "{}",
        image.solution.objective
    );
    for (node, other) in plan.trajectory.nodes().iter().zip(image.trajectory.nodes()) {
        let angles = node.joint_angles_rad.iter().zip(&other.joint_angles_rad);
        for ((angle, other), sign) in angles.zip([-1.0, 1.0, 1.0, 1.0]) {
            assert!((sign * angle - other).abs() < 1e-4, "{node:?} {other:?}");
        }
    }
}

#[test]
fn a_plan_of_another_arm_is_refused() {
    let four = varied(&shipped("slew_4dof"), |file| file.horizon.steps = 20.0);
    let earlier = planned(&four);
    let refused = Planner::new()
        .warm_start(&earlier.trajectory)
        .plan(&shipped("slew_2dof"), &mut |_| Control::Continue);
    assert!(matches!(refused, Err(PlanError::Shape(_))));
}

#[test]
fn without_a_plan_there_is_a_reason_and_what_was_tried() {
    let scenario = varied(&shipped("slew_4dof"), |file| {
        file.horizon.steps = 60.0;
        file.solver.max_iterations = Some(2.0);
    });
    // As long as a loaded machine takes for what a second is enough for.
    let mut planner = Planner::new().remedy_time(Duration::from_secs(3600));
    let plan = planner.plan(&scenario, &mut |_| Control::Continue).unwrap();
    assert_eq!(plan.solution.status, Status::IterationLimit);
    let notes = &plan.solution.notes;
    assert_eq!(notes[0], "the solver used up solver.max_iterations", "{notes:?}");
    let tried = "no duration that was tried works either, from 45 to ";
    assert!(notes.iter().any(|note| note.starts_with(tried)), "{notes:?}");
}

#[test]
fn one_seed_gives_one_plan() {
    let seeded = |seed| {
        let scenario = varied(&shipped("slew_4dof"), |file| {
            file.horizon.steps = 60.0;
            file.solver.guess = Some(Guess::Starts(LowDiscrepancyStarts { starts: 3, seed }));
        });
        planned(&scenario)
    };
    let [first, second, other] = [5, 5, 6].map(seeded);
    assert_eq!(first.trajectory, second.trajectory);
    assert_eq!(solves(&first.solution.attempts), solves(&second.solution.attempts));
    assert_ne!(
        solves(&first.solution.attempts),
        solves(&other.solution.attempts),
        "another seed tries other starts"
    );
}
