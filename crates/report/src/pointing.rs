//! `pointing.svg`: where instruments look.

use righting_analysis::Histories;
use righting_analysis::histories::PointingHistory;
use righting_results::{Solution, Trajectory};
use righting_scenario::ConeSide;

use crate::figure::{Figure, heading};
use crate::number::drawn;
use crate::panel::{Curve, Panel, Rule, RuleKind};
use crate::style;

const PANEL_SIZE: [f64; 2] = [620.0, 150.0];
/// Below this height a curve counts as constant.
const LEAST_SPAN_DEG: f64 = 1e-3;

/// The figure of the angles between boresights and the axes of their cones, as an SVG document: a panel an
/// instrument, with its half-angle; none where no cone is given.
pub fn pointing_svg(
    solution: &Solution,
    trajectory: &Trajectory,
    histories: &Histories,
) -> Option<String> {
    if histories.pointing.is_empty() {
        return None;
    }
    let (title, subtitle) = heading(solution);
    let figure = Figure {
        title,
        subtitle,
        places: trajectory.nodes().iter().map(|node| node.time_s).collect(),
        panel_size: PANEL_SIZE,
        panels: histories.pointing.iter().map(panel).collect(),
        ..Figure::default()
    };
    Some(figure.render())
}

fn panel(history: &PointingHistory) -> Panel {
    let angles_deg: Vec<f64> = history.angles_rad.iter().map(|angle| angle.to_degrees()).collect();
    let half_angle_deg = history.half_angle_rad.to_degrees();
    let (side, worst_deg) = match history.side {
        ConeSide::Outside => ("at least", angles_deg.iter().copied().fold(f64::INFINITY, f64::min)),
        ConeSide::Inside => {
            ("at most", angles_deg.iter().copied().fold(f64::NEG_INFINITY, f64::max))
        }
    };
    Panel {
        heading: format!("{}: {side} {}° off", history.name, drawn(half_angle_deg)),
        axis_label: "Angle [deg]",
        note: format!("{side} {}° at the nodes", drawn(worst_deg)),
        curves: vec![Curve::plain(style::MAGNITUDE, angles_deg)],
        rules: vec![Rule { kind: RuleKind::Limit, value: half_angle_deg }],
        least_span: LEAST_SPAN_DEG,
        ..Panel::default()
    }
}
