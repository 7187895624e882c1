//! `envelope.svg`: momentum and torque envelopes of arm and wheels, seen along each axis.

use nalgebra::Vector3;

use crate::axis::Range;
use crate::body_view::{self, BodyView, GAP, SIDE, VIEWS};
use crate::heading::{heading, legend_entry};
use crate::style;
use crate::svg::{Stroke, Svg};

/// Points whose convex hulls are drawn.
#[derive(Clone, Debug, Default)]
pub struct EnvelopeOutlines {
    /// Extreme points of the arm.
    pub arm: Vec<Vector3<f64>>,
    /// Samples of the arm's motion.
    pub sampled: Vec<Vector3<f64>>,
    /// Corners of what the wheels give.
    pub wheels: Vec<Vector3<f64>>,
}

/// The figure of both envelopes as an SVG document: outlines in the xy, xz and yz planes, all views
/// of a quantity to one scale.
pub fn envelope_svg(
    name: &str,
    momentum_n_m_s: &EnvelopeOutlines,
    torque_n_m: &EnvelopeOutlines,
) -> String {
    let left = style::MARGIN + GAP;
    let top = style::MARGIN + style::TITLE_SIZE + 2.0 * style::LABEL_SIZE + 28.0;
    let row_step = SIDE + style::TIME_AXIS_HEIGHT + style::ROW_GAP;
    let width = left + 3.0 * (SIDE + GAP) - GAP + style::MARGIN;
    let height = top + 2.0 * row_step;
    let subtitle = "Momentum and torque envelopes of the arm and of reaction wheels, body axes";
    let mut svg = Svg::new(width, height, name, subtitle);
    let base = heading(&mut svg, left, name, subtitle);
    for (i, (stroke, label)) in
        [(ARM, "arm, true extent"), (SAMPLED, "arm, hull of samples"), (WHEELS, "wheels")]
            .into_iter()
            .enumerate()
    {
        let x = left + 190.0 * i as f64;
        legend_entry(&mut svg, [x, base], stroke, label);
    }
    for (row, (outlines, quantity, unit)) in
        [(momentum_n_m_s, "H", "N m s"), (torque_n_m, "T", "N m")].into_iter().enumerate()
    {
        for (column, view) in VIEWS.into_iter().enumerate() {
            let corner = [left + column as f64 * (SIDE + GAP), top + row as f64 * row_step];
            let view = BodyView { corner, view, range: range(outlines) };
            view.draw_axes(&mut svg, quantity, unit);
            let curves =
                [(&outlines.sampled, SAMPLED), (&outlines.arm, ARM), (&outlines.wheels, WHEELS)];
            for (points, stroke) in curves {
                view.draw_hull(&mut svg, points, stroke);
            }
        }
    }
    svg.finish()
}

const ARM: Stroke = Stroke { color: style::Z, width: style::CURVE_WIDTH, dash: "" };
const SAMPLED: Stroke =
    Stroke { color: style::Z, width: style::RULE_WIDTH, dash: style::LIMIT_DASH };
const WHEELS: Stroke = Stroke { color: style::X, width: style::CURVE_WIDTH, dash: "" };

/// One range for all axes of a quantity, symmetric about zero.
fn range(outlines: &EnvelopeOutlines) -> Range {
    let points = [&outlines.arm, &outlines.sampled, &outlines.wheels];
    body_view::range(points.into_iter().flatten())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_to_draw_is_no_failure() {
        let nothing = EnvelopeOutlines::default();
        assert!(envelope_svg("a<b", &nothing, &nothing).ends_with("</svg>\n"));
    }
}
