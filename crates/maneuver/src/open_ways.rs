//! What may help when there is no plan.

use crate::scenario::Scenario;
use crate::solution::Status;
use crate::trajectory::Trajectory;

/// So close to a limit, as a share of it, it counts as reached.
const AT_LIMIT: f64 = 1e-3;
/// A limit reached in so much of the time is worth naming.
const MOST_OF_THE_TIME: f64 = 0.5;

/// Which ways are open after a solve that did not converge; nothing to say after one that did.
pub(crate) fn open_ways(
    scenario: &Scenario,
    trajectory: &Trajectory,
    status: Status,
) -> Vec<String> {
    let mut ways = Vec::new();
    match status {
        Status::Solved | Status::Acceptable | Status::Interrupted => return ways,
        Status::IterationLimit | Status::TimeLimit => {
            ways.push("may converge with more: raise solver.max_iterations".to_owned());
        }
        _ => {}
    }
    ways.extend(active_limits(scenario, trajectory));
    let duration_s = scenario.horizon().duration_s;
    ways.push(format!("a longer maneuver needs less: try horizon.duration_s {}", 1.5 * duration_s));
    ways.push(r#"another start may get there: try solver.guess {"starts": 24}"#.to_owned());
    ways
}

/// The joint limits that were active most of the time.
fn active_limits(scenario: &Scenario, trajectory: &Trajectory) -> Vec<String> {
    let mut active = Vec::new();
    let mut note = |joint: usize, what: &str, reached: usize, all: usize| {
        let share = reached as f64 / all.max(1) as f64;
        if share >= MOST_OF_THE_TIME {
            let percent = (100.0 * share).round();
            active.push(format!(
                "joint {} is at its {what} limit {percent} % of the time",
                joint + 1
            ));
        }
    };
    let (nodes, intervals) = (trajectory.nodes(), trajectory.intervals());
    for (joint, limits) in scenario.system().joint_limits.iter().enumerate() {
        let is_fast = |value: f64, limit: f64| value.abs() >= limit * (1.0 - AT_LIMIT);
        let accelerating = intervals.iter().filter(|interval| {
            is_fast(interval.joint_accelerations_rad_s2[joint], limits.acceleration_max_rad_s2)
        });
        note(joint, "acceleration", accelerating.count(), intervals.len());
        let moving =
            nodes.iter().filter(|n| is_fast(n.joint_rates_rad_s[joint], limits.rate_max_rad_s));
        note(joint, "rate", moving.count(), nodes.len());
        let margin = AT_LIMIT * (limits.angle_max_rad - limits.angle_min_rad);
        let turned = nodes.iter().filter(|n| {
            let angle = n.joint_angles_rad[joint];
            angle <= limits.angle_min_rad + margin || angle >= limits.angle_max_rad - margin
        });
        note(joint, "angle", turned.count(), nodes.len());
    }
    active
}
