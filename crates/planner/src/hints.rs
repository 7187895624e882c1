//! What stands in the way where a plan misses its target or there is none.

mod cones;

use righting_results::WaypointRecord;
use righting_results::solution::{Status, Terminal};
use righting_results::trajectory::Trajectory;
use righting_scenario::file::JointKind;
use righting_scenario::scenario::{Maneuver, Scenario};
use righting_verifier::ATTITUDE_ERROR;

use crate::planned::Planned;
use crate::scaling::largest_turn_rad;
use crate::spin::fast_spin;

/// So close to a limit, as a share of it, it counts as reached.
const AT_LIMIT: f64 = 1e-3;
/// The same of a torque, which is stated at both ends of a step and changes within.
const NEAR_TORQUE: f64 = 0.02;
/// A limit reached in so much of the time is worth naming.
const MOST_OF_THE_TIME: f64 = 0.5;
/// How much longer than the estimate a slew should take, for the estimate to be enough.
const DURATION_MARGIN: f64 = 0.1;
/// An estimate far from what was solved says little, …
const MOST_TIMES_LONGER: f64 = 3.0;
/// … and this is as good.
const TIMES_LONGER: f64 = 1.5;

/// What stood in the way of a solve that did not converge or misses its target; nothing to say after any
/// other.
pub(crate) fn hints(scenario: &Scenario, trajectory: &Trajectory, status: Status) -> Vec<String> {
    match status {
        Status::Interrupted => Vec::new(),
        Status::Solved | Status::Acceptable => {
            let missed = missed(scenario, trajectory);
            if missed.is_empty() { missed } else { reasons(scenario, trajectory, missed) }
        }
        Status::IterationLimit => {
            let mut reasons = vec!["the solver used up solver.max_iterations".to_owned()];
            reasons.extend(active_limits(scenario, trajectory));
            reasons.extend(cones::in_the_way(scenario, trajectory));
            reasons
        }
        _ => {
            let mut reasons = active_limits(scenario, trajectory);
            reasons.extend(cones::in_the_way(scenario, trajectory));
            reasons.extend(fast_spin(scenario));
            reasons
        }
    }
}

/// The targets that a slew did not reach, and by how much.
fn missed(scenario: &Scenario, trajectory: &Trajectory) -> Vec<String> {
    if scenario.maneuver().slew().is_none() {
        return Vec::new();
    }
    let waypoints = WaypointRecord::reached(scenario, trajectory).into_iter().enumerate();
    let on_the_way = waypoints.map(|(index, found)| {
        let name = format!("waypoint {}", index + 1);
        (name, found.attitude_error, found.attitude_error_deg)
    });
    let end = Terminal::reached(scenario, trajectory);
    let end = ("its target".to_owned(), end.attitude_error, end.attitude_error_deg);
    let missed = on_the_way.chain([end]).filter(|(_, error, _)| *error > ATTITUDE_ERROR);
    missed.map(|(name, _, by_deg)| format!("misses {name} by {by_deg:.3}\u{b0}")).collect()
}

fn reasons(scenario: &Scenario, trajectory: &Trajectory, missed: Vec<String>) -> Vec<String> {
    let mut reasons = missed;
    if scenario.weights().attitude == 0.0 {
        reasons.push("nothing asks for the target: weights.attitude is 0".to_owned());
        return reasons;
    }
    let limits = active_limits(scenario, trajectory);
    let cones = cones::in_the_way(scenario, trajectory);
    if limits.is_empty() && cones.is_empty() {
        reasons.push(match scenario.is_end_hard() {
            true => "no joint is at a limit most of the time".to_owned(),
            false => "no joint is at a limit most of the time: effort is in the way".to_owned(),
        });
    }
    reasons.extend(limits);
    reasons.extend(cones);
    reasons
}

/// How many times as long a maneuver should take, about.
pub(crate) fn estimated_times_longer(scenario: &Scenario, planned: &Planned) -> f64 {
    let Maneuver::Slew(slew) = scenario.maneuver() else { return TIMES_LONGER };
    let (error, error_deg) = planned.solution.largest_miss();
    let still_to_turn = error_deg.to_radians();
    let slew_rad = largest_turn_rad(scenario, slew);
    // Against its limits an arm turns the base by an angle that grows with the square of the time.
    // Without any, the error is a trade for effort, which falls with its third power.
    let times_longer = match active_limits(scenario, &planned.trajectory).is_empty() {
        false => (slew_rad / (slew_rad - still_to_turn)).sqrt(),
        true => (error / ATTITUDE_ERROR).cbrt(),
    };
    let is_telling = slew_rad > still_to_turn && times_longer <= MOST_TIMES_LONGER;
    match is_telling && planned.solution.status.is_acceptable() {
        true => (1.0 + DURATION_MARGIN) * times_longer,
        false => TIMES_LONGER,
    }
}

/// Rounded up to two digits.
pub(crate) fn two_digits(value: f64) -> f64 {
    let unit = 10f64.powf(value.log10().floor() - 1.0);
    // A unit below one is a fraction that does not print well; its inverse is a whole number.
    if unit < 1.0 {
        (value / unit).ceil() / (1.0 / unit).round()
    } else {
        (value / unit).ceil() * unit
    }
}

/// The joint limits that were active most of the time.
fn active_limits(scenario: &Scenario, trajectory: &Trajectory) -> Vec<String> {
    let mut active = Vec::new();
    let mut note = |joint: usize, what: &str, reached: usize, all: usize| {
        let share = reached as f64 / all.max(1) as f64;
        if share >= MOST_OF_THE_TIME {
            let percent = (100.0 * share).round();
            active.push(format!(
                "{} is at its {what} limit {percent} % of the time",
                scenario.system().names.joint(joint)
            ));
        }
    };
    let (nodes, intervals) = (trajectory.nodes(), trajectory.intervals());
    for (joint, limits) in scenario.system().joint_limits.iter().enumerate() {
        let (coordinate, effort) = match limits.kind {
            JointKind::Revolute => ("angle", "torque"),
            JointKind::Prismatic => ("travel", "force"),
        };
        let is_fast = |value: f64, limit: f64| value.abs() >= limit * (1.0 - AT_LIMIT);
        let accelerating = intervals.iter().filter(|interval| {
            is_fast(interval.joint_accelerations_rad_s2[joint], limits.acceleration_max_rad_s2)
        });
        note(joint, "acceleration", accelerating.count(), intervals.len());
        let jerking = intervals
            .iter()
            .filter(|interval| is_fast(interval.joint_jerk_rad_s3(joint), limits.jerk_max_rad_s3));
        note(joint, "jerk", jerking.count(), intervals.len());
        let moving =
            nodes.iter().filter(|n| is_fast(n.joint_rates_rad_s[joint], limits.rate_max_rad_s));
        note(joint, "rate", moving.count(), nodes.len());
        let drive = &scenario.system().drives[joint];
        let pushing = intervals.iter().zip(nodes).filter(|(interval, node)| {
            let torque_n_m = drive.torque(
                interval.joint_torques_n_m[joint],
                node.joint_rates_rad_s[joint],
                interval.joint_accelerations_rad_s2[joint],
            );
            torque_n_m.abs() >= (1.0 - NEAR_TORQUE) * limits.torque_max_n_m
        });
        note(joint, effort, pushing.count(), intervals.len());
        let margin = AT_LIMIT * (limits.angle_max_rad - limits.angle_min_rad);
        let turned = nodes.iter().filter(|n| {
            let angle = n.joint_angles_rad[joint];
            angle <= limits.angle_min_rad + margin || angle >= limits.angle_max_rad - margin
        });
        note(joint, coordinate, turned.count(), nodes.len());
    }
    active
}
