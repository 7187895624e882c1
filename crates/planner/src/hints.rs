//! What may help when there is no plan.

use righting_results::solution::{Status, Terminal};
use righting_results::trajectory::Trajectory;
use righting_scenario::scenario::{Maneuver, Scenario};
use righting_verifier::ATTITUDE_ERROR;

/// So close to a limit, as a share of it, it counts as reached.
const AT_LIMIT: f64 = 1e-3;
/// A limit reached in so much of the time is worth naming.
const MOST_OF_THE_TIME: f64 = 0.5;
/// How much longer than the estimate a slew should take, for the estimate to be enough.
const DURATION_MARGIN: f64 = 0.1;
/// An estimate far from what was solved says little.
const MOST_TIMES_LONGER: f64 = 3.0;

const MORE_STARTS: &str = r#"another start may get there: try solver.guess {"starts": 24}"#;

/// Which ways are open after a solve that did not converge or misses its target; nothing to say
/// after any other.
pub(crate) fn hints(scenario: &Scenario, trajectory: &Trajectory, status: Status) -> Vec<String> {
    let mut ways = Vec::new();
    match status {
        Status::Interrupted => return ways,
        Status::Solved | Status::Acceptable => {
            return match missed(scenario, trajectory) {
                Some(missed) => ways_to_target(scenario, trajectory, missed),
                None => ways,
            };
        }
        Status::IterationLimit | Status::TimeLimit => {
            ways.push("may converge with more: raise solver.max_iterations".to_owned());
        }
        _ => {}
    }
    ways.extend(active_limits(scenario, trajectory));
    let duration_s = scenario.horizon().duration_s;
    ways.push(format!("a longer maneuver needs less: try horizon.duration_s {}", 1.5 * duration_s));
    ways.push(MORE_STARTS.to_owned());
    ways
}

/// What the target of a slew was missed by.
struct Missed {
    slew_rad: f64,
    terminal: Terminal,
}

fn missed(scenario: &Scenario, trajectory: &Trajectory) -> Option<Missed> {
    let Maneuver::Slew(slew) = scenario.maneuver() else { return None };
    let terminal = Terminal::reached(scenario, trajectory);
    let misses = terminal.attitude_error > ATTITUDE_ERROR;
    misses.then_some(Missed { slew_rad: slew.angle_rad.abs(), terminal })
}

fn ways_to_target(scenario: &Scenario, trajectory: &Trajectory, missed: Missed) -> Vec<String> {
    let Missed { slew_rad, terminal } = missed;
    let mut ways = vec![format!("misses its target by {:.3}\u{b0}", terminal.attitude_error_deg)];
    if scenario.weights().attitude == 0.0 {
        ways.push("nothing asks for the target: weights.attitude is 0".to_owned());
        return ways;
    }
    let limits = active_limits(scenario, trajectory);
    if limits.is_empty() {
        ways.push(
            "no joint is at a limit most of the time: a smaller weights.control comes closer"
                .to_owned(),
        );
    }
    // Against its limits an arm turns the base by an angle that grows with the square of the time.
    // Without any, the error is a trade for effort, which falls with its fourth power.
    let still_to_turn = terminal.attitude_error_deg.to_radians();
    let times_longer = match limits.is_empty() {
        false => (slew_rad / (slew_rad - still_to_turn)).sqrt(),
        true => (terminal.attitude_error / ATTITUDE_ERROR).powf(0.25),
    };
    ways.extend(limits);
    let duration_s = scenario.horizon().duration_s;
    if slew_rad > still_to_turn && times_longer <= MOST_TIMES_LONGER {
        let enough_s = (1.0 + DURATION_MARGIN) * times_longer * duration_s;
        ways.push(format!("more time helps: try horizon.duration_s {}", two_digits(enough_s)));
    } else {
        ways.push(format!("more time helps: try horizon.duration_s {}", 2.0 * duration_s));
    }
    ways.push(MORE_STARTS.to_owned());
    ways.push("`righting reach` finds the shortest duration and the largest angle".to_owned());
    ways
}

/// Rounded up to two digits.
fn two_digits(value: f64) -> f64 {
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
