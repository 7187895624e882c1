//! `convergence.svg`: how the optimizer got there.

use righting_results::{IterationRecord, Solution};

use crate::figure::{Figure, heading};
use crate::panel::{Curve, Panel, Scale};
use crate::style;

const PANEL_SIZE: [f64; 2] = [620.0, 170.0];

/// The figure of objective, infeasibilities and barrier parameter by iteration of the last solve, as
/// an SVG document; none where no iterations were recorded.
pub fn convergence_svg(solution: &Solution) -> Option<String> {
    let history = &solution.history;
    if history.is_empty() {
        return None;
    }
    let of = |value: fn(&IterationRecord) -> f64| history.iter().map(value).collect::<Vec<f64>>();
    let named =
        |name: &str, color, values| Curve { name: name.to_owned(), ..Curve::plain(color, values) };
    let panels = vec![
        Panel {
            heading: "Objective".into(),
            axis_label: "Objective [\u{2013}]",
            curves: vec![Curve::plain(style::Z, of(|record| record.objective))],
            scale: Scale::Logarithmic,
            ..Panel::default()
        },
        Panel {
            heading: "Infeasibility and barrier parameter".into(),
            axis_label: "Size [\u{2013}]",
            curves: vec![
                named("primal", style::SERIES[1], of(|record| record.primal_infeasibility)),
                named("dual", style::SERIES[2], of(|record| record.dual_infeasibility)),
                named("barrier", style::SERIES[3], of(|record| record.barrier_parameter)),
            ],
            scale: Scale::Logarithmic,
            ..Panel::default()
        },
        Panel {
            heading: "Step size".into(),
            axis_label: "Step [\u{2013}]",
            curves: vec![
                named("primal", style::SERIES[1], of(|record| record.primal_step)),
                named("dual", style::SERIES[2], of(|record| record.dual_step)),
            ],
            least_span: 1e-3,
            ..Panel::default()
        },
    ];
    let (title, subtitle) = heading(solution);
    let places = history.iter().map(|record| record.iteration as f64).collect();
    let across = "Iteration of the last solve";
    let figure = Figure {
        title,
        subtitle,
        across,
        places,
        panel_size: PANEL_SIZE,
        panels,
        ..Figure::default()
    };
    Some(figure.render())
}
