//! Where a joint's jerk is limited: jerks within their limits, and accelerations that are continuous from
//! zero at the start to zero at the end.

use righting_results::trajectory::Trajectory;

use crate::joints::Accelerations;
use crate::ledger::{Ledger, Subject, Worst};
use crate::requirements::Requirements;

pub(super) fn check(asked: &Requirements, trajectory: &Trajectory, ledger: &mut Ledger) {
    if asked.joint_limits.iter().all(|limits| limits.jerk_max_rad_s3.is_none()) {
        return;
    }
    let tolerances = &asked.tolerances.at_nodes;
    let mut jerk = Worst::of_limit("joint jerk", "rad/s³", tolerances.jerk_rad_s3);
    let of_acceleration = |name| Worst::new(name, "rad/s²", tolerances.acceleration_rad_s2);
    let mut jump = of_acceleration("jump of joint acceleration at nodes");
    let mut ends = of_acceleration("joint acceleration at start and end");
    let steps = trajectory.steps();
    // What the acceleration was where the interval before ended.
    let mut before = vec![0.0; asked.joint_limits.len()];
    for (k, interval) in trajectory.intervals().iter().enumerate() {
        let accelerations = Accelerations::of(interval);
        let (start_s, end_s) = (asked.horizon.time_s(k), asked.horizon.time_s(k + 1));
        for (joint, (limits, before)) in asked.joint_limits.iter().zip(&mut before).enumerate() {
            let subject = Some(Subject::Joint(joint));
            if let Some(limit) = limits.jerk_max_rad_s3 {
                jerk.at_most(accelerations.jerk(joint).abs(), limit, subject, Some(start_s));
            }
            let begins = (accelerations.at(joint, 0.0) - *before).abs();
            let worst = if k == 0 { &mut ends } else { &mut jump };
            worst.at_most(begins, 0.0, subject, Some(start_s));
            *before = accelerations.at(joint, end_s - start_s);
            if k + 1 == steps {
                ends.at_most(before.abs(), 0.0, subject, Some(end_s));
            }
        }
    }
    for worst in [jerk, jump, ends] {
        ledger.add(worst);
    }
}
