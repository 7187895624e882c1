//! The interior solver against Ipopt, whole plans on the asked grids.

use righting_ocp::Control;
use righting_planner::{Planned, Planner};
use righting_results::UsedOptimizer;
use righting_scenario::file::{Guess, NamedGuess, Optimizer};
use righting_test_support::{shipped, solves, varied};

fn planned(name: &str, optimizer: Optimizer, guess: NamedGuess) -> Planned {
    let scenario = varied(&shipped(name), |file| {
        file.solver.optimizer = Some(optimizer);
        file.solver.guess = Some(Guess::Named(guess));
    });
    Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap()
}

/// The same solves on the way, the same iterations and the same plan.
#[track_caller]
fn agree(name: &str, guess: NamedGuess) {
    let [own, ipopt] =
        [Optimizer::Interior, Optimizer::Ipopt].map(|optimizer| planned(name, optimizer, guess));
    assert_eq!(own.solution.versions.optimizer, UsedOptimizer::Interior, "{name}");
    assert_eq!(ipopt.solution.versions.optimizer, UsedOptimizer::Ipopt, "{name}");
    assert_eq!(own.solution.status, ipopt.solution.status, "{name}");
    assert_eq!(solves(&own.solution.attempts), solves(&ipopt.solution.attempts), "{name}");
    let difference = (own.solution.objective - ipopt.solution.objective).abs();
    assert!(difference <= 1e-9 * ipopt.solution.objective, "{name}: {difference:e}");
    let largest = (own.trajectory.nodes().iter().zip(ipopt.trajectory.nodes()))
        .flat_map(|(own, ipopt)| own.joint_angles_rad.iter().zip(&ipopt.joint_angles_rad))
        .fold(0.0_f64, |largest, (own, ipopt)| largest.max((own - ipopt).abs()));
    assert!(largest < 1e-6, "{name}: joint angles differ by {largest:e} rad");
}

#[test]
fn both_compare_the_same_starts_and_refine_to_the_same_plan() {
    for name in ["slew_2dof", "detumble_2dof", "slew_4dof", "detumble_4dof", "slew_canadarm2"] {
        agree(name, NamedGuess::Auto);
    }
}

#[test]
fn both_go_the_same_way_from_the_papers_guess() {
    for name in ["slew_2dof", "slew_4dof", "slew_canadarm2_table"] {
        agree(name, NamedGuess::Constant);
    }
}

/// The objectives at which CasADi 3.8.2 with Ipopt 3.14 ends from the paper's guess in the paper's form, and
/// its iterations.
#[test]
fn the_papers_guess_ends_where_casadi_ends() {
    for (name, reference, iterations) in [
        ("slew_2dof", 7.937306e-4, 44),
        ("slew_4dof", 9.06836e-4, 51),
        ("detumble_2dof", 3.679018, 79),
        ("detumble_4dof", 4.711023, 69),
    ] {
        let scenario = varied(&shipped(&format!("{name}_full")), |file| {
            file.solver.guess = Some(Guess::Named(NamedGuess::Constant));
        });
        let plan = Planner::new().plan(&scenario, &mut |_| Control::Continue).unwrap();
        assert_eq!(plan.solution.versions.optimizer, UsedOptimizer::Ipopt, "{name}");
        let apart = plan.solution.objective / reference - 1.0;
        assert!(
            apart.abs() < 1e-6,
            "{name}: {} is {apart:e} from {reference}",
            plan.solution.objective
        );
        assert_eq!(plan.solution.iterations, iterations, "{name}");
    }
}

#[test]
fn ipopt_makes_what_is_delivered_and_the_interior_solver_what_leads_there() {
    for name in ["slew_4dof", "detumble_canadarm2", "slew_2dof_full"] {
        let plan = Planner::new().plan(&shipped(name), &mut |_| Control::Continue).unwrap();
        assert_eq!(plan.solution.versions.optimizer, UsedOptimizer::Ipopt, "{name}");
        let (last, before) = plan.solution.attempts.split_last().unwrap();
        assert_eq!((last.steps, last.optimizer), (600, UsedOptimizer::Ipopt), "{name}");
        assert_eq!(
            (last.status, last.iterations),
            (Some(plan.solution.status), plan.solution.iterations),
            "{name}"
        );
        assert!(before.len() >= 5, "{name}: {before:?}");
        // Where the interior solver gives up, Ipopt solves from the same start.
        let mut was_given_up = false;
        for attempt in before {
            let expected = match was_given_up {
                true => UsedOptimizer::Ipopt,
                false => UsedOptimizer::Interior,
            };
            assert_eq!(attempt.optimizer, expected, "{name}: {attempt:?}");
            was_given_up = attempt.given_up.is_some();
        }
    }
}
