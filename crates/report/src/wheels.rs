//! `wheels.svg`: what the reaction wheels store and give, and how fast they spin.

use righting_results::{Solution, Trajectory};
use righting_scenario::wheels::Wheel;

use crate::figure::{Figure, heading};
use crate::panel::Panel;

const PANEL_SIZE: [f64; 2] = [620.0, 110.0];

/// Turns a minute of a wheel that stores a momentum, where its inertia is known.
fn rpm(wheel: &Wheel, momentum_n_m_s: f64) -> Option<f64> {
    wheel.speed_rad_s(momentum_n_m_s).map(|speed| speed * 60.0 / std::f64::consts::TAU)
}

/// The figure of momentum, torque of the motor and, where the inertia is known, speed beside their limits, of every wheel that works, as an SVG document; none without
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
        let stored = |k: usize| trajectory.nodes()[k].wheel_momenta_n_m_s[index];
        let torques = nodes
            .clone()
            .map(|k| wheel.motor_torque_n_m(trajectory.wheel_torques_at(k)[index], stored(k)));
        let speeds: Option<Vec<f64>> = nodes.clone().map(|k| rpm(wheel, stored(k))).collect();
        let speed = speeds.zip(rpm(wheel, wheel.momentum_max_n_m_s)).map(|(speeds, most)| {
            let heading = format!("Speed of wheel {}", index + 1);
            Panel::limited(heading, "Speed [rpm]", speeds, most, true)
        });
        let panels = [
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
        ];
        panels.into_iter().chain(speed)
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
