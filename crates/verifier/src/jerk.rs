//! Where a joint's jerk is limited: jerks within their limits, and accelerations that are continuous from
//! zero at the start to zero at the end.

use righting_results::trajectory::Trajectory;

use crate::joints::Accelerations;
use crate::ledger::{Ledger, Worst};
use crate::requirements::Requirements;
use crate::worst_of_joints::WorstOfJoints;

pub(super) fn check(asked: &Requirements, trajectory: &Trajectory, ledger: &mut Ledger) {
    if asked.joint_limits.iter().all(|limits| limits.jerk_max_rad_s3.is_none()) {
        return;
    }
    let tolerances = &asked.tolerances;
    let of_jerk = tolerances.of_kinds(tolerances.at_nodes.jerk_rad_s3);
    let of_acceleration = tolerances.of_kinds(tolerances.at_nodes.acceleration_rad_s2);
    let mut jerk = WorstOfJoints::new(
        &asked.slides,
        Worst::of_limit("joint jerk", "rad/s³", of_jerk[0]),
        Worst::of_limit("jerk of sliding joint", "m/s³", of_jerk[1]),
    );
    let accelerations = |turning, sliding| {
        WorstOfJoints::new(
            &asked.slides,
            Worst::new(turning, "rad/s²", of_acceleration[0]),
            Worst::new(sliding, "m/s²", of_acceleration[1]),
        )
    };
    let mut jump = accelerations(
        "jump of joint acceleration at nodes",
        "jump of sliding joint's acceleration at nodes",
    );
    let mut ends = accelerations(
        "joint acceleration at start and end",
        "acceleration of sliding joint at start and end",
    );
    let steps = trajectory.steps();
    // What the acceleration was where the interval before ended.
    let mut before = vec![0.0; asked.joint_limits.len()];
    for (k, interval) in trajectory.intervals().iter().enumerate() {
        let accelerations = Accelerations::of(interval);
        let (start_s, end_s) = (asked.horizon.time_s(k), asked.horizon.time_s(k + 1));
        for (joint, (limits, before)) in asked.joint_limits.iter().zip(&mut before).enumerate() {
            if let Some(limit) = limits.jerk_max_rad_s3 {
                jerk.at_most(joint, accelerations.jerk(joint).abs(), limit, start_s);
            }
            let begins = (accelerations.at(joint, 0.0) - *before).abs();
            let worst = if k == 0 { &mut ends } else { &mut jump };
            worst.at_most(joint, begins, 0.0, start_s);
            *before = accelerations.at(joint, end_s - start_s);
            if k + 1 == steps {
                ends.at_most(joint, before.abs(), 0.0, end_s);
            }
        }
    }
    for worst in [jerk, jump, ends] {
        worst.enter(ledger);
    }
}
