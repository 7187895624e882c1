//! Vectors in body axes, seen along each of them.

use nalgebra::Vector3;

use crate::axis::Range;
use crate::style;
use crate::svg::{Anchor, Stroke, Svg};

/// Width and height of a view.
pub(crate) const SIDE: f64 = 230.0;
/// Room left of each view.
pub(crate) const GAP: f64 = style::TICK_LABEL_WIDTH + style::AXIS_LABEL_WIDTH + style::COLUMN_GAP;
/// Horizontal and vertical axis of each view.
pub(crate) const VIEWS: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];
const AXES: [&str; 3] = ["x", "y", "z"];

/// One range for all axes, symmetric about zero, that holds all points.
pub(crate) fn range<'a>(points: impl Iterator<Item = &'a Vector3<f64>>) -> Range {
    let largest = points.map(Vector3::amax).fold(0.0, f64::max);
    Range { low: -largest, high: largest }.padded(1e-9)
}

/// A square in which two components of vectors are drawn to one scale.
pub(crate) struct BodyView {
    pub corner: [f64; 2],
    /// Horizontal and vertical axis.
    pub view: (usize, usize),
    pub range: Range,
}

impl BodyView {
    /// Grid, frame, ticks and the names of both axes.
    pub fn draw_axes(&self, svg: &mut Svg, quantity: &str, unit: &str) {
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
    }

    /// The outline of the convex hull of points.
    pub fn draw_hull(&self, svg: &mut Svg, points: &[Vector3<f64>], stroke: Stroke) {
        let flat: Vec<[f64; 2]> = points.iter().map(|point| self.flat(point)).collect();
        let mut outline: Vec<[f64; 2]> =
            outline(flat).into_iter().map(|point| self.place(point)).collect();
        outline.extend(outline.first().copied());
        svg.polylines(std::iter::once(outline.as_slice()), stroke);
    }

    /// The two components that are seen.
    pub fn flat(&self, vector: &Vector3<f64>) -> [f64; 2] {
        let (across, up) = self.view;
        [vector[across], vector[up]]
    }

    /// Where two components lie on the page.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
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
}
