//! `envelope.svg`: momentum and torque envelopes of arm and wheels, seen along each axis.

use nalgebra::Vector3;

use crate::axis::Range;
use crate::style;
use crate::svg::{Anchor, Stroke, Svg};

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

const SIDE: f64 = 230.0;
const GAP: f64 = style::TICK_LABEL_WIDTH + style::AXIS_LABEL_WIDTH + style::COLUMN_GAP;
/// Horizontal and vertical axis of each view.
const VIEWS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];
const AXES: [&str; 3] = ["x", "y", "z"];

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
    let mut base = style::MARGIN + style::TITLE_SIZE;
    svg.text([left, base], Anchor::Start, style::TITLE_SIZE, style::INK, name);
    base += style::LABEL_SIZE + 7.0;
    svg.text([left, base], Anchor::Start, style::LABEL_SIZE, style::FAINT_INK, subtitle);
    base += style::LABEL_SIZE + 7.0;
    for (i, (stroke, label)) in
        [(ARM, "arm, true extent"), (SAMPLED, "arm, hull of samples"), (WHEELS, "wheels")]
            .into_iter()
            .enumerate()
    {
        let x = left + 190.0 * i as f64;
        svg.line([x, base - 4.0], [x + 26.0, base - 4.0], stroke);
        svg.text([x + 32.0, base], Anchor::Start, style::SMALL_SIZE, style::INK, label);
    }
    for (row, (outlines, quantity, unit)) in
        [(momentum_n_m_s, "H", "N m s"), (torque_n_m, "T", "N m")].into_iter().enumerate()
    {
        for (column, view) in VIEWS.into_iter().enumerate() {
            let corner = [left + column as f64 * (SIDE + GAP), top + row as f64 * row_step];
            View { corner, view, range: range(outlines) }.draw(&mut svg, outlines, quantity, unit);
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
    let largest = points.into_iter().flatten().map(Vector3::amax).fold(0.0, f64::max);
    Range { low: -largest, high: largest }.padded(1e-9)
}

struct View {
    corner: [f64; 2],
    view: (usize, usize),
    range: Range,
}

impl View {
    fn draw(&self, svg: &mut Svg, outlines: &EnvelopeOutlines, quantity: &str, unit: &str) {
        let [left, top] = self.corner;
        let grid = Stroke { color: style::GRID, width: style::HAIR_WIDTH, dash: "" };
        let size = style::SMALL_SIZE;
        for (value, label) in self.range.ticks(5.0) {
            let [x, y] = self.place([value, value]);
            svg.line([x, top], [x, top + SIDE], grid);
            svg.line([left, y], [left + SIDE, y], grid);
            svg.text([x, top + SIDE + size + 4.0], Anchor::Middle, size, style::INK, &label);
            svg.text([left - 5.0, y + 0.35 * size], Anchor::End, size, style::INK, &label);
        }
        let frame = Stroke { color: style::FRAME, width: style::HAIR_WIDTH, dash: "" };
        svg.frame(self.corner, [SIDE, SIDE], frame);
        let (across, up) = self.view;
        let label = |axis: usize| format!("{quantity}{} [{unit}]", AXES[axis]);
        let below = [left + 0.5 * SIDE, top + SIDE + style::TIME_AXIS_HEIGHT - 6.0];
        svg.text(below, Anchor::Middle, style::LABEL_SIZE, style::INK, &label(across));
        let beside = [left - style::TICK_LABEL_WIDTH + 6.0, top + 0.5 * SIDE];
        svg.vertical_text(beside, style::LABEL_SIZE, style::INK, &label(up));
        let curves =
            [(&outlines.sampled, SAMPLED), (&outlines.arm, ARM), (&outlines.wheels, WHEELS)];
        for (points, stroke) in curves {
            let flat: Vec<[f64; 2]> = points.iter().map(|p| [p[across], p[up]]).collect();
            let mut outline: Vec<[f64; 2]> =
                outline(flat).into_iter().map(|point| self.place(point)).collect();
            outline.extend(outline.first().copied());
            svg.polylines(std::iter::once(outline.as_slice()), stroke);
        }
    }

    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, top] = self.corner;
        let share = |value: f64| (value - self.range.low) / self.range.span();
        [left + SIDE * share(x), top + SIDE * (1.0 - share(y))]
    }
}

/// The convex hull of points in a plane, counter-clockwise (Andrew's monotone chain).
fn outline(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let chain = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for &c in points {
            while let [.., a, b] = kept[..] {
                let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                if turn > 0.0 {
                    break;
                }
                kept.pop();
            }
            kept.push(c);
        }
        kept.pop();
        kept
    };
    let mut outline = chain(&mut points.iter());
    outline.extend(chain(&mut points.iter().rev()));
    outline
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outline_of_a_grid_is_its_corners() {
        let grid = (0..25).map(|i| [f64::from(i % 5), f64::from(i / 5)]).collect();
        assert_eq!(outline(grid), [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
    }

    #[test]
    fn nothing_to_draw_is_no_failure() {
        let nothing = EnvelopeOutlines::default();
        assert!(envelope_svg("a<b", &nothing, &nothing).ends_with("</svg>\n"));
    }
}
