//! Several maneuvers of different arms side by side, as the paper shows them.

use std::ops::Range;

use righting_results::{Solution, Trajectory};
use righting_scenario::file::{ManeuverType, Scenario};

use crate::asked;
use crate::attitude::{rate_panel, slew_panels};
use crate::figure::Figure;
use crate::joints::accelerations;
use crate::panel::{Curve, Panel};

const PANEL_SIZE: [f64; 2] = [290.0, 120.0];
/// Joints that the legend of one panel names; the next panel names the others.
const NAMED_AT_ONCE: usize = 4;
const LEAST_ANGLE_SPAN_DEG: f64 = 1e-2;
const LEAST_RATE_SPAN_DEG_S: f64 = 1e-3;
const LEAST_ACCELERATION_SPAN_DEG_S2: f64 = 1e-4;

/// The figure of named maneuvers on one time grid, a column each, as an SVG document: the base's
/// rotation (of a slew) or angular rate (of a detumble), and angles, rates and accelerations of the
/// joints.
pub fn maneuvers_svg(title: &str, maneuvers: &[(String, Solution, Trajectory)]) -> String {
    let columns: Vec<Vec<Panel>> = maneuvers
        .iter()
        .map(|(name, solution, trajectory)| column(name, &solution.scenario, trajectory))
        .collect();
    let rows = columns.iter().map(Vec::len).min().unwrap_or(0);
    let across_the_rows = (0..rows).flat_map(|row| columns.iter().map(move |column| &column[row]));
    let times = maneuvers.first().map(|(_, _, trajectory)| trajectory.nodes());
    let figure = Figure {
        title: title.to_owned(),
        subtitle: "Base (dotted: target; black: magnitude) and joints by number".to_owned(),
        places: times.unwrap_or_default().iter().map(|node| node.time_s).collect(),
        columns: columns.len(),
        panel_size: PANEL_SIZE,
        panels: across_the_rows.cloned().collect(),
        ..Figure::default()
    };
    figure.render()
}

fn column(name: &str, scenario: &Scenario, trajectory: &Trajectory) -> Vec<Panel> {
    let nodes = trajectory.nodes();
    let targets = asked::targets(scenario);
    let attitude = match scenario.maneuver.kind {
        ManeuverType::Slew if !targets.is_empty() => {
            let [rotation, _] = slew_panels(nodes, &targets);
            Panel { heading: format!("{name}: base [deg]"), ..rotation }
        }
        _ => {
            let mut rates = rate_panel(nodes);
            rates.curves[0].name.clear();
            Panel { heading: format!("{name}: base [deg/s]"), ..rates }
        }
    };
    let joints = |of: &dyn Fn(usize, usize) -> f64, count: usize, hold: bool| -> Vec<Curve> {
        let curve = |joint: usize| {
            let values = (0..count).map(|k| of(k, joint).to_degrees()).collect();
            Curve { name: String::new(), hold, ..Curve::of_joint(joint, values) }
        };
        (0..trajectory.joints()).map(curve).collect()
    };
    let panel = |heading: &str, curves: Vec<Curve>, least_span: f64| Panel {
        heading: heading.to_owned(),
        curves,
        least_span,
        ..Panel::default()
    };
    let angles = joints(&|k, joint| nodes[k].joint_angles_rad[joint], nodes.len(), false);
    let rates = joints(&|k, joint| nodes[k].joint_rates_rad_s[joint], nodes.len(), false);
    let by_joint: Vec<Vec<f64>> =
        (0..trajectory.joints()).map(|joint| accelerations(trajectory, joint)).collect();
    let is_held = !trajectory.has_jerks();
    let accelerations = joints(&|k, joint| by_joint[joint][k], by_joint[0].len(), is_held);
    let named = |mut curves: Vec<Curve>, joints: Range<usize>| -> Vec<Curve> {
        let named = curves.iter_mut().enumerate().filter(|(joint, _)| joints.contains(joint));
        named.for_each(|(joint, curve)| curve.name = (joint + 1).to_string());
        curves
    };
    let (first, second) = (0..NAMED_AT_ONCE, NAMED_AT_ONCE..2 * NAMED_AT_ONCE);
    vec![
        Panel { axis_label: "", ..attitude },
        panel("Joint angles [deg]", named(angles, first), LEAST_ANGLE_SPAN_DEG),
        panel("Joint rates [deg/s]", named(rates, second), LEAST_RATE_SPAN_DEG_S),
        panel("Joint accelerations [deg/s²]", accelerations, LEAST_ACCELERATION_SPAN_DEG_S2),
    ]
}
