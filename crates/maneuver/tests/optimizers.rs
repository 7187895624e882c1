//! The program's own loop against Ipopt, whole plans on the asked grids.

mod support;

use righting_maneuver::file::{Guess, NamedGuess, Optimizer};
use righting_maneuver::{Plan, UsedOptimizer, plan};
use righting_ocp::Control;
use support::{shipped, varied};

fn planned(name: &str, optimizer: Optimizer, guess: NamedGuess) -> Plan {
    let scenario = varied(&shipped(name), |file| {
        file.solver.optimizer = Some(optimizer);
        file.solver.guess = Some(Guess::Named(guess));
    });
    plan(&scenario, &mut |_| Control::Continue).unwrap()
}

/// The same solves on the way, the same iterations and the same plan.
#[track_caller]
fn agree(name: &str, guess: NamedGuess) {
    let [own, ipopt] =
        [Optimizer::Auto, Optimizer::Ipopt].map(|optimizer| planned(name, optimizer, guess));
    assert_eq!(own.optimizer, UsedOptimizer::Interior, "{name}");
    assert_eq!(ipopt.optimizer, UsedOptimizer::Ipopt, "{name}");
    assert_eq!(own.status, ipopt.status, "{name}");
    assert_eq!(own.rungs, ipopt.rungs, "{name}");
    let difference = (own.objective - ipopt.objective).abs();
    assert!(difference <= 1e-9 * ipopt.objective, "{name}: {difference:e}");
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
