//! `momentum.svg`: what the arm takes from the base, and that the sum stays.

use nalgebra::Vector3;
use righting_analysis::Histories;
use righting_results::{Solution, Trajectory};

use crate::figure::{Figure, heading};
use crate::number::drawn;
use crate::panel::{Curve, Panel};
use crate::style;

const PANEL_SIZE: [f64; 2] = [620.0, 150.0];
/// Below these heights a curve counts as constant.
const LEAST_MOMENTUM_SPAN_N_M_S: f64 = 1e-15;
const LEAST_POSITION_SPAN_M: f64 = 1e-15;

/// The figure of the momentum of the arm's motion, and of what integration makes of the conserved
/// angular momentum and center of mass, as an SVG document.
pub fn momentum_svg(solution: &Solution, trajectory: &Trajectory, histories: &Histories) -> String {
    let momentum_drift = from_the_first(&histories.angular_momentum_n_m_s);
    let wander = from_the_first(&histories.center_of_mass_m);
    let panels = vec![
        panel(
            "Momentum of the arm relative to the base, body axes",
            "Momentum [N m s]",
            &histories.arm_momentum_n_m_s,
            LEAST_MOMENTUM_SPAN_N_M_S,
        ),
        panel(
            "Drift of the system's angular momentum, inertial axes",
            "Drift [N m s]",
            &momentum_drift,
            LEAST_MOMENTUM_SPAN_N_M_S,
        ),
        panel(
            "Drift of the system's center of mass, inertial axes",
            "Drift [m]",
            &wander,
            LEAST_POSITION_SPAN_M,
        ),
    ];
    let (title, subtitle) = heading(solution);
    let times = trajectory.nodes().iter().map(|node| node.time_s).collect();
    Figure { title, subtitle, places: times, panel_size: PANEL_SIZE, panels, ..Figure::default() }
        .render()
}

fn panel(
    heading: &str,
    axis_label: &'static str,
    vectors: &[Vector3<f64>],
    least_span: f64,
) -> Panel {
    let largest = vectors.iter().map(Vector3::norm).fold(0.0, f64::max);
    Panel {
        heading: heading.to_owned(),
        axis_label,
        note: format!("at most {}", drawn(largest)),
        curves: components(vectors),
        least_span,
        ..Panel::default()
    }
}

fn from_the_first(vectors: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let first = vectors.first().copied().unwrap_or_default();
    vectors.iter().map(|vector| vector - first).collect()
}

fn components(vectors: &[Vector3<f64>]) -> Vec<Curve> {
    let curve = |(i, (name, color)): (usize, (&str, &'static str))| Curve {
        name: name.to_owned(),
        ..Curve::plain(color, vectors.iter().map(|vector| vector[i]).collect())
    };
    [("x", style::X), ("y", style::Y), ("z", style::Z)].into_iter().enumerate().map(curve).collect()
}
