//! `wheels.svg`: what the reaction wheels store and give.

use righting_results::{Solution, Trajectory};
use righting_scenario::wheels::Wheel;

use crate::figure::{Figure, heading};
use crate::panel::Panel;

const PANEL_SIZE: [f64; 2] = [620.0, 110.0];

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
            Panel::limited(
                format!("Momentum of wheel {}", index + 1),
                "Momentum [N m s]",
                momenta.collect(),
                wheel.momentum_max_n_m_s,
                true,
            ),
            Panel::limited(
                format!("Torque of wheel {}", index + 1),
                "Torque [N m]",
                torques.collect(),
                wheel.torque_max_n_m,
                true,
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
