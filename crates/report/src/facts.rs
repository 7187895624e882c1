//! The numbers that sum a plan up, as pages show them.

use righting_results::solution::Terminal;
use righting_results::{Check, Sense, Solution, Trajectory};
use righting_scenario::file::ManeuverType;
use serde::Serialize;

use crate::number::short;
use crate::summary::{in_degrees, place, status_phrase};

/// A number with its name, and what to compare it with.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Fact {
    label: &'static str,
    value: String,
    note: String,
}

/// How much of a limit the plan uses.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct UsedLimit {
    name: String,
    value: String,
    place: String,
    /// 1 at the limit.
    share: f64,
}

/// The checks of the plan's own limits; of those made at and between the nodes, the latter.
const LIMITS: [&str; 9] = [
    "joint angle between nodes",
    "joint travel between nodes",
    "joint rate between nodes",
    "joint speed between nodes",
    "joint acceleration",
    "acceleration of sliding joint",
    "clearance from body between nodes",
    "clearance between links between nodes",
    "pointing between nodes",
];

/// What the plan reached and what it took, the most important first.
pub(crate) fn facts(solution: &Solution, trajectory: &Trajectory) -> Vec<Fact> {
    let fact = |label, value, note| Fact { label, value, note };
    let terminal = &solution.terminal;
    let rate = format!("{} °/s", short(terminal.angular_rate_deg_s));
    let mut facts = match solution.scenario.maneuver.kind {
        ManeuverType::Slew => vec![
            fact(
                "Attitude error",
                format!("{}°", short(terminal.attitude_error_deg)),
                format!("vector part {}", short(terminal.attitude_error)),
            ),
            fact("Base at the end", rate, "angular rate".to_owned()),
        ],
        ManeuverType::Detumble => detumble_facts(solution, trajectory, rate),
    };
    let timing = &solution.timing_s;
    let planned = timing.trace + timing.guess + timing.solve;
    let total_power = short(trajectory.peak_power_w());
    facts.extend([
        fact("Joints at the end", joints_at_end(terminal), "norm of the rates".to_owned()),
        fact(
            "Objective",
            precise(solution.objective),
            format!("{} after {} iterations", status_phrase(solution.status), solution.iterations),
        ),
        fact(
            "Planned in",
            format!("{} s", short(planned)),
            format!("verified in {} s", short(timing.verify)),
        ),
        fact("Peak power", format!("{total_power} W"), "mechanical, all joints".to_owned()),
    ]);
    facts
}

fn detumble_facts(solution: &Solution, trajectory: &Trajectory, rate: String) -> Vec<Fact> {
    let at_start = || trajectory.start().state().angular_rate.norm().to_degrees();
    let start = solution.stopped_deg_s.unwrap_or_else(at_start);
    let percent =
        |value: Option<f64>| value.map_or("\u{2013}".to_owned(), |p| format!("{} %", short(p)));
    let bound = solution.bound_deg_s;
    vec![
        Fact {
            label: "Base at the end",
            value: rate,
            note: format!(
                "from {} °/s; bound {}",
                short(start),
                bound.map_or("\u{2013}".to_owned(), |bound| format!("{} °/s", short(bound)))
            ),
        },
        Fact {
            label: "Taken out",
            value: percent(solution.reduction_percent),
            note: format!(
                "at most {} with the arm at rest",
                percent(bound.map(|bound| 100.0 * (1.0 - bound / start)))
            ),
        },
    ]
}

/// How fast the joints still are, such as "0.01 °/s, 0.002 m/s".
pub(crate) fn joints_at_end(terminal: &Terminal) -> String {
    let turning = format!("{} °/s", short(terminal.joint_rate_deg_s));
    match terminal.joint_speed_m_s {
        Some(speed_m_s) => format!("{turning}, {} m/s", short(speed_m_s)),
        None => turning,
    }
}

/// Six significant digits.
fn precise(value: f64) -> String {
    match value.abs() {
        size if (1e-2..1e4).contains(&size) => {
            format!("{value:.*}", (5.0 - size.log10().floor()) as usize)
        }
        _ => format!("{value:.5e}"),
    }
}

/// The plan's limits at their worst places.
pub(crate) fn used_limits(solution: &Solution) -> Vec<UsedLimit> {
    let checks = |name: &'static str| {
        solution.verification.checks.iter().filter(move |check| check.name == name)
    };
    LIMITS.into_iter().flat_map(checks).map(used_limit).collect()
}

fn used_limit(check: &Check) -> UsedLimit {
    let (unit, scale) = in_degrees(&check.unit);
    let [value, limit] = [check.value, check.limit].map(|number| scale * number);
    let share = match check.sense {
        Sense::AtMost if limit > 0.0 => value / limit,
        Sense::AtLeast if limit < 0.0 => value / limit,
        _ => limit / value,
    };
    let sign = match check.sense {
        Sense::AtMost => "\u{2264}",
        Sense::AtLeast => "\u{2265}",
    };
    let beyond = match check.sense {
        Sense::AtMost => value - limit,
        Sense::AtLeast => limit - value,
    };
    let said = match beyond > 0.0 {
        true => format!(", {} beyond", short(beyond)),
        false => String::new(),
    };
    let name = check.name.strip_suffix(" between nodes").unwrap_or(&check.name);
    UsedLimit {
        name: name.to_owned(),
        value: format!("{} {sign} {} {unit}{said}", short(value), short(limit)),
        place: place(check),
        share: if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 },
    }
}
