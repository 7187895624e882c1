//! `wheels.svg`: what the reaction wheels store and give.

use righting_results::{Solution, Trajectory};
use righting_scenario::wheels::Wheel;

use crate::figure::{Figure, heading};
use crate::number::drawn;
use crate::panel::{Curve, Panel, Rule, RuleKind};
use crate::style;

const PANEL_SIZE: [f64; 2] = [620.0, 110.0];
/// Below this share of its limit a momentum or torque counts as constant.
const LEAST_SHARE: f64 = 1e-9;

/// The figure of momentum and torque beside their limits, of every wheel that works, as an SVG document; none without
/// such wheels.
pub fn wheels_svg(
    solution: &Solution,
    wheels: &[Wheel],
    trajectory: &Trajectory,
) -> Option<String> {
    if wheels.iter().all(|wheel| wheel.failed) {
        return None;
    }
    let (title, subtitle) = heading(solution);
    let nodes = 0..trajectory.nodes().len();
    let working = wheels.iter().enumerate().filter(|(_, wheel)| !wheel.failed);
    let panels = working.flat_map(|(index, wheel)| {
        let momenta = trajectory.nodes().iter().map(|node| node.wheel_momenta_n_m_s[index]);
        let torques = nodes.clone().map(|k| trajectory.wheel_torques_at(k)[index]);
        [
            panel(
                format!("Momentum of wheel {}", index + 1),
                "Momentum [N m s]",
                momenta.collect(),
                wheel.momentum_max_n_m_s,
            ),
            panel(
                format!("Torque of wheel {}", index + 1),
                "Torque [N m]",
                torques.collect(),
                wheel.torque_max_n_m,
            ),
        ]
    });
    let figure = Figure {
        title,
        subtitle,
        places: trajectory.nodes().iter().map(|node| node.time_s).collect(),
        panel_size: PANEL_SIZE,
        panels: panels.collect(),
        ..Figure::default()
    };
    Some(figure.render())
}

fn panel(heading: String, axis_label: &'static str, values: Vec<f64>, most: f64) -> Panel {
    let peak = values.iter().fold(0.0, |peak: f64, value| peak.max(value.abs()));
    let limit = |value| Rule { kind: RuleKind::Limit, value };
    Panel {
        heading,
        axis_label,
        note: format!("peak {} of {}", drawn(peak), drawn(most)),
        curves: vec![Curve::plain(style::Z, values)],
        rules: vec![limit(-most), limit(most)],
        least_span: LEAST_SHARE * most,
        ..Panel::default()
    }
}
