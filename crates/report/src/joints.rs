//! `joints.svg`: what the arm does.

use righting_results::{Solution, Trajectory};
use righting_scenario::file::{Link, Scenario, SystemReference};

use crate::figure::{Figure, heading};
use crate::number::drawn;
use crate::panel::{Curve, Panel, Rule, RuleKind};
use crate::style;

const PANEL_SIZE: [f64; 2] = [290.0, 92.0];
/// Below these heights (deg, deg/s, deg/s²) a curve counts as constant.
const LEAST_SPANS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// The figure of angle, rate and acceleration of every joint with its limits, as an SVG document:
/// one row a joint, one column a quantity, degrees throughout.
pub fn joints_svg(solution: &Solution, trajectory: &Trajectory) -> String {
    let links = links(&solution.scenario);
    let panels = (0..trajectory.joints())
        .flat_map(|joint| joint_panels(trajectory, joint, links.get(joint)))
        .collect();
    let (title, subtitle) = heading(solution);
    let figure = Figure {
        title,
        subtitle,
        places: trajectory.nodes().iter().map(|node| node.time_s).collect(),
        columns: 3,
        panel_size: PANEL_SIZE,
        panels,
        ..Figure::default()
    };
    figure.render()
}

/// The links of a resolved scenario; none if the system is a file, which a result never has.
fn links(scenario: &Scenario) -> &[Link] {
    match &scenario.system {
        SystemReference::Inline(system) => &system.links,
        SystemReference::File(_) => &[],
    }
}

fn joint_panels(trajectory: &Trajectory, joint: usize, link: Option<&Link>) -> [Panel; 3] {
    let nodes = trajectory.nodes().iter();
    let angles = nodes.clone().map(|n| n.joint_angles_rad[joint]).collect();
    let rates = nodes.map(|n| n.joint_rates_rad_s[joint]).collect();
    let intervals = trajectory.intervals().iter();
    let accelerations = intervals.map(|i| i.joint_accelerations_rad_s2[joint]).collect();
    let either_way = |bound: Option<f64>| [bound.map(|b| -b), bound];
    let angle_limits = [link.and_then(|l| l.angle_min_deg), link.and_then(|l| l.angle_max_deg)];
    let rate_limits = either_way(link.map(|l| l.rate_max_deg_s));
    let acceleration_limits = either_way(link.map(|l| l.acceleration_max_deg_s2));
    let number = joint + 1;
    [
        panel(format!("Joint {number} angle [deg]"), angles, angle_limits, LEAST_SPANS[0], false),
        panel(format!("Joint {number} rate [deg/s]"), rates, rate_limits, LEAST_SPANS[1], false),
        panel(
            format!("Joint {number} acceleration [deg/s²]"),
            accelerations,
            acceleration_limits,
            LEAST_SPANS[2],
            true,
        ),
    ]
}

/// A panel of one curve, given in radians, between limits in degrees.
fn panel(
    heading: String,
    values_rad: Vec<f64>,
    limits_deg: [Option<f64>; 2],
    least_span: f64,
    hold: bool,
) -> Panel {
    let values: Vec<f64> = values_rad.into_iter().map(f64::to_degrees).collect();
    let note = match limits_deg {
        [Some(low), Some(high)] if low == -high => {
            let peak = values.iter().fold(0.0, |peak: f64, v| peak.max(v.abs()));
            format!("peak {} of {}", drawn(peak), drawn(high))
        }
        _ => String::new(),
    };
    let limit = |value| Rule { kind: RuleKind::Limit, value };
    let rules = limits_deg.into_iter().flatten().map(limit).collect();
    let curves = vec![Curve { hold, ..Curve::plain(style::Z, values) }];
    Panel { heading, note, curves, rules, least_span, ..Panel::default() }
}
