//! `attitude.svg`: how the base turns.

use nalgebra::UnitQuaternion;
use righting_results::{Node, Solution, Trajectory};

use crate::asked::{self, Target};
use crate::figure::{Figure, heading};
use crate::number::drawn;
use crate::panel::{Curve, Panel, Rule, RuleKind};
use crate::style;

const PANEL_SIZE: [f64; 2] = [620.0, 150.0];
/// Below these heights a curve counts as constant.
const LEAST_ANGLE_SPAN_DEG: f64 = 1e-3;
const LEAST_RATE_SPAN_DEG_S: f64 = 1e-4;

/// The figure of the base's attitude and angular rate, as an SVG document.
///
/// A slew shows the rotation vector from the start (body axes, degrees) on its way to the target
/// and the angle still to turn, by way of its waypoints to the next of them; a detumble, which may turn through several revolutions, shows the
/// attitude quaternion. Both show the angular rate by components (body axes) and its magnitude.
pub fn attitude_svg(solution: &Solution, trajectory: &Trajectory) -> String {
    let nodes = trajectory.nodes();
    let targets = asked::targets(&solution.scenario);
    let panels = match targets.is_empty() {
        false => {
            let [rotation, error] = slew_panels(nodes, &targets);
            vec![rotation, error, rate_panel(nodes)]
        }
        true => {
            vec![
                quaternion_panel(nodes),
                rate_panel(nodes),
                spin_panel(nodes, solution.bound_deg_s),
            ]
        }
    };
    let (title, subtitle) = heading(solution);
    let figure = Figure {
        title,
        subtitle,
        places: nodes.iter().map(|node| node.time_s).collect(),
        panel_size: PANEL_SIZE,
        panels,
        ..Figure::default()
    };
    figure.render()
}

pub(crate) fn slew_panels(nodes: &[Node], targets: &[Target]) -> [Panel; 2] {
    let start = asked::unit(nodes[0].attitude);
    let turned: Vec<_> =
        nodes.iter().map(|n| rotation_deg(start, asked::unit(n.attitude))).collect();
    let asked: Vec<_> = targets.iter().map(|target| rotation_deg(start, target.attitude)).collect();
    let colors = [style::X, style::Y, style::Z];
    let rotation = Panel {
        heading: "Rotation of the base from its start, body axes (dotted: target)".to_owned(),
        axis_label: "Rotation [deg]",
        note: String::new(),
        curves: components(["x", "y", "z"], |i| turned.iter().map(|v| v[i]).collect()),
        rules: asked
            .iter()
            .flat_map(|asked| colors.into_iter().zip(asked))
            .map(|(color, &value)| Rule { kind: RuleKind::Target(color), value })
            .collect(),
        least_span: LEAST_ANGLE_SPAN_DEG,
        ..Panel::default()
    };
    let error_deg = |node: &Node| {
        let target = asked::target_at(targets, node.time_s)?;
        Some(asked::unit(node.attitude).angle_to(&target).to_degrees())
    };
    let errors: Vec<f64> = nodes.iter().filter_map(error_deg).collect();
    let note = format!("{}° at the end", drawn(*errors.last().unwrap_or(&f64::NAN)));
    let error = Panel {
        heading: "Angle to the target attitude".to_owned(),
        axis_label: "Error [deg]",
        note,
        curves: vec![magnitude(errors)],
        rules: Vec::new(),
        least_span: LEAST_ANGLE_SPAN_DEG,
        ..Panel::default()
    };
    [rotation, error]
}

fn quaternion_panel(nodes: &[Node]) -> Panel {
    let scalar = nodes.iter().map(|n| n.attitude[0]).collect();
    let mut curves = vec![Curve { name: "w".to_owned(), ..Curve::plain(style::W, scalar) }];
    curves
        .extend(components(["x", "y", "z"], |i| nodes.iter().map(|n| n.attitude[i + 1]).collect()));
    Panel {
        heading: "Attitude quaternion of the base, body to inertial".to_owned(),
        axis_label: "Quaternion [\u{2013}]",
        note: String::new(),
        curves,
        rules: Vec::new(),
        least_span: 1e-3,
        ..Panel::default()
    }
}

pub(crate) fn rate_panel(nodes: &[Node]) -> Panel {
    let mut curves = components(["x", "y", "z"], |i| {
        nodes.iter().map(|n| n.angular_rate_rad_s[i].to_degrees()).collect()
    });
    curves.insert(0, Curve { name: "magnitude".to_owned(), ..magnitude(spin_deg_s(nodes)) });
    Panel {
        heading: "Angular rate of the base, body axes".to_owned(),
        axis_label: "Rate [deg/s]",
        note: String::new(),
        curves,
        rules: Vec::new(),
        least_span: LEAST_RATE_SPAN_DEG_S,
        ..Panel::default()
    }
}

fn spin_panel(nodes: &[Node], bound_deg_s: Option<f64>) -> Panel {
    let spin = spin_deg_s(nodes);
    let (first, last) = (spin[0], spin[spin.len() - 1]);
    let bound = bound_deg_s
        .map(|b| format!(", dashed: least with the arm at rest, {}", drawn(b)))
        .unwrap_or_default();
    Panel {
        heading: "Magnitude of the angular rate".to_owned(),
        axis_label: "Rate [deg/s]",
        note: format!("{} to {} deg/s{bound}", drawn(first), drawn(last)),
        curves: vec![magnitude(spin)],
        rules: bound_deg_s.map(|value| Rule { kind: RuleKind::Limit, value }).into_iter().collect(),
        least_span: LEAST_RATE_SPAN_DEG_S,
        ..Panel::default()
    }
}

fn components(names: [&'static str; 3], values: impl Fn(usize) -> Vec<f64>) -> Vec<Curve> {
    let colors = [style::X, style::Y, style::Z];
    (0..3)
        .map(|i| Curve { name: names[i].to_owned(), ..Curve::plain(colors[i], values(i)) })
        .collect()
}

fn magnitude(values: Vec<f64>) -> Curve {
    Curve::plain(style::MAGNITUDE, values)
}

fn spin_deg_s(nodes: &[Node]) -> Vec<f64> {
    let norm = |v: &[f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt().to_degrees();
    nodes.iter().map(|node| norm(&node.angular_rate_rad_s)).collect()
}

/// The rotation vector that takes `from` to `to`, in the body axes of `from`, degrees.
fn rotation_deg(from: UnitQuaternion<f64>, to: UnitQuaternion<f64>) -> [f64; 3] {
    (from.inverse() * to).scaled_axis().map(f64::to_degrees).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asked::unit;

    #[test]
    fn rotation_vectors_are_in_degrees_and_body_axes() {
        let quarter = std::f64::consts::FRAC_1_SQRT_2;
        let about_x = unit([quarter, quarter, 0.0, 0.0]);
        let then_about_body_z = about_x * unit([quarter, 0.0, 0.0, quarter]);
        let vector = rotation_deg(about_x, then_about_body_z);
        assert!((vector[2] - 90.0).abs() < 1e-12 && vector[0].abs() + vector[1].abs() < 1e-12);
        // The same attitude by the quaternion of other sign.
        let negated = unit([-quarter, -quarter, 0.0, 0.0]);
        let [x, _, _] = rotation_deg(unit([1.0, 0.0, 0.0, 0.0]), negated);
        assert!((x - 90.0).abs() < 1e-12);
    }
}
