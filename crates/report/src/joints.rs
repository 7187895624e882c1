//! `joints.svg`: what the arm does.

use righting_results::{Solution, Trajectory};
use righting_scenario::Names;
use righting_scenario::file::{JointKind, JointRow, JointWords, Scenario, SystemReference};

use crate::figure::{Figure, heading};
use crate::number::drawn;
use crate::panel::{Curve, Panel, Rule, RuleKind};
use crate::style;

const PANEL_SIZE: [f64; 2] = [290.0, 92.0];
/// Below these heights (deg, deg/s, deg/s², deg/s³) a curve counts as constant.
const LEAST_SPANS: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-5];
/// Heading and note of a panel have room side by side up to so many characters.
const HEAD_CHARACTERS: usize = 48;

/// The figure of angle, rate, acceleration and, where the plan has it, jerk of every joint with its limits,
/// as an SVG document: one row a joint, one column a quantity, degrees throughout.
pub fn joints_svg(solution: &Solution, trajectory: &Trajectory) -> String {
    let (rows, names) = joints(&solution.scenario);
    let panels = (0..trajectory.joints())
        .flat_map(|joint| joint_panels(trajectory, joint, rows.get(joint), &names.joint(joint)))
        .collect();
    let (title, subtitle) = heading(solution);
    let figure = Figure {
        title,
        subtitle,
        places: trajectory.nodes().iter().map(|node| node.time_s).collect(),
        columns: if trajectory.has_jerks() { 4 } else { 3 },
        panel_size: PANEL_SIZE,
        panels,
        ..Figure::default()
    };
    figure.render()
}

/// The joints of a resolved scenario; none if the system is a file, which a result never has.
fn joints(scenario: &Scenario) -> (Vec<JointRow>, Names) {
    match &scenario.system {
        SystemReference::Inline(system) => (system.joints(), Names::of(system)),
        SystemReference::File(_) => (Vec::new(), Names::default()),
    }
}

fn joint_panels(
    trajectory: &Trajectory,
    joint: usize,
    row: Option<&JointRow>,
    name: &str,
) -> Vec<Panel> {
    let nodes = trajectory.nodes().iter();
    let angles = nodes.clone().map(|n| n.joint_angles_rad[joint]).collect();
    let rates = nodes.map(|n| n.joint_rates_rad_s[joint]).collect();
    let either_way = |bound: Option<f64>| [bound.map(|b| -b), bound];
    let limits = [row.and_then(|row| row.min), row.and_then(|row| row.max)];
    let rate_limits = either_way(row.and_then(|row| row.rate_max));
    let acceleration_limits = either_way(row.and_then(|row| row.acceleration_max));
    let kind = row.map_or(JointKind::Revolute, |row| row.kind);
    let words = JointWords::of(kind);
    let (coordinate, rate) = match kind {
        JointKind::Revolute => ("angle", "rate"),
        JointKind::Prismatic => ("travel", "speed"),
    };
    let unit = words.unit;
    // A metre of travel counts like so many degrees of a turn where a panel has a least span.
    let spans = LEAST_SPANS.map(|span| words.from_si(span.to_radians()));
    let name = capitalized(name);
    let mut panels = vec![
        panel(format!("{name} {coordinate} [{unit}]"), words, angles, limits, spans[0], false),
        panel(format!("{name} {rate} [{unit}/s]"), words, rates, rate_limits, spans[1], false),
        panel(
            format!("{name} acceleration [{unit}/s²]"),
            words,
            accelerations(trajectory, joint),
            acceleration_limits,
            spans[2],
            !trajectory.has_jerks(),
        ),
    ];
    if trajectory.has_jerks() {
        let jerks = trajectory.intervals().iter().map(|i| i.joint_jerk_rad_s3(joint)).collect();
        let limits = either_way(row.and_then(|row| row.jerk_max));
        let heading = format!("{name} jerk [{unit}/s³]");
        panels.push(panel(heading, words, jerks, limits, spans[3], true));
    }
    panels
}

/// A joint's acceleration, rad/s²: of every interval where it is held, else at every node.
pub(crate) fn accelerations(trajectory: &Trajectory, joint: usize) -> Vec<f64> {
    let values = trajectory.steps() + usize::from(trajectory.has_jerks());
    (0..values).map(|k| trajectory.joint_accelerations_at(k)[joint]).collect()
}

/// "joint 2" at the head of a panel; names of the user's stay as they are.
fn capitalized(name: &str) -> String {
    name.strip_prefix("joint ").map_or_else(|| name.to_owned(), |number| format!("Joint {number}"))
}

/// A panel of one curve, given in SI units, between limits in those of the file.
fn panel(
    heading: String,
    words: &JointWords,
    values: Vec<f64>,
    limits: [Option<f64>; 2],
    least_span: f64,
    hold: bool,
) -> Panel {
    let values: Vec<f64> = values.into_iter().map(|value| words.from_si(value)).collect();
    let note = match limits {
        [Some(low), Some(high)] if low == -high => {
            let peak = values.iter().fold(0.0, |peak: f64, v| peak.max(v.abs()));
            format!("peak {} of {}", drawn(peak), drawn(high))
        }
        _ => String::new(),
    };
    let is_short = heading.chars().count() + note.chars().count() <= HEAD_CHARACTERS;
    let note = if is_short { note } else { String::new() };
    let limit = |value| Rule { kind: RuleKind::Limit, value };
    let rules = limits.into_iter().flatten().map(limit).collect();
    let curves = vec![Curve { hold, ..Curve::plain(style::Z, values) }];
    Panel { heading, note, curves, rules, least_span, ..Panel::default() }
}
