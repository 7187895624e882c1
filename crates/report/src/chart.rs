//! One panel over any two quantities, with frame, grid, ticks and labels.

use crate::axis::Range;
use crate::style;
use crate::svg::{Anchor, Stroke, Svg};

/// A panel on its own page, to draw curves on.
pub(crate) struct Chart {
    pub svg: Svg,
    corner: [f64; 2],
    size: [f64; 2],
    x: Range,
    y: Range,
}

/// What a chart says beside its curves.
pub(crate) struct Labels<'a> {
    pub title: &'a str,
    pub subtitle: &'a str,
    pub x: &'a str,
    pub y: &'a str,
}

const SIZE: [f64; 2] = [560.0, 300.0];
/// Room right of the panel for the names of curves.
const NAMES_WIDTH: f64 = 150.0;

impl Chart {
    pub fn new(labels: &Labels<'_>, x: Range, y: Range) -> Self {
        Self::with_ticks(labels, (x, &x.ticks(7.0)), y)
    }

    /// A chart over decimal logarithms.
    pub fn over_decades(labels: &Labels<'_>, x: Range, y: Range) -> Self {
        Self::with_ticks(labels, (x, &x.decades()), y)
    }

    fn with_ticks(labels: &Labels<'_>, (x, ticks): (Range, &[(f64, String)]), y: Range) -> Self {
        let left = style::MARGIN + style::AXIS_LABEL_WIDTH + style::TICK_LABEL_WIDTH;
        let top = style::MARGIN + style::TITLE_SIZE + style::LABEL_SIZE + 22.0;
        let width = left + SIZE[0] + NAMES_WIDTH + style::MARGIN;
        let height = top + SIZE[1] + style::TIME_AXIS_HEIGHT + style::MARGIN;
        let mut svg = Svg::new(width, height, labels.title, labels.subtitle);
        let base = style::MARGIN + style::TITLE_SIZE;
        let [title_size, size] = [style::TITLE_SIZE, style::LABEL_SIZE];
        svg.text([style::MARGIN, base], Anchor::Start, title_size, style::INK, labels.title);
        let base = [style::MARGIN, base + size + 7.0];
        svg.text(base, Anchor::Start, size, style::FAINT_INK, labels.subtitle);
        let mut chart = Self { svg, corner: [left, top], size: SIZE, x, y };
        chart.draw_axes(labels, ticks);
        chart
    }

    fn draw_axes(&mut self, labels: &Labels<'_>, ticks: &[(f64, String)]) {
        let ([left, top], [width, height]) = (self.corner, self.size);
        let grid = Stroke { color: style::GRID, width: style::HAIR_WIDTH, dash: "" };
        let size = style::SMALL_SIZE;
        for (value, label) in ticks {
            let [x, _] = self.place([*value, self.y.low]);
            self.svg.line([x, top], [x, top + height], grid);
            let at = [x, top + height + size + 4.0];
            self.svg.text(at, Anchor::Middle, size, style::INK, label);
        }
        for (value, label) in self.y.ticks(6.0) {
            let [_, y] = self.place([self.x.low, value]);
            self.svg.line([left, y], [left + width, y], grid);
            self.svg.text([left - 5.0, y + 0.35 * size], Anchor::End, size, style::INK, &label);
        }
        let frame = Stroke { color: style::FRAME, width: style::HAIR_WIDTH, dash: "" };
        self.svg.frame(self.corner, self.size, frame);
        let below = [left + 0.5 * width, top + height + style::TIME_AXIS_HEIGHT - 4.0];
        self.svg.text(below, Anchor::Middle, style::LABEL_SIZE, style::INK, labels.x);
        let beside = [left - style::TICK_LABEL_WIDTH + 4.0, top + 0.5 * height];
        self.svg.vertical_text(beside, style::LABEL_SIZE, style::INK, labels.y);
    }

    /// Where a point is on the page.
    pub fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([left, top], [width, height]) = (self.corner, self.size);
        [
            left + width * (x - self.x.low) / self.x.span(),
            top + height * (1.0 - (y - self.y.low) / self.y.span()),
        ]
    }

    /// A curve through points, which need not be on the page yet.
    pub fn curve(&mut self, points: &[[f64; 2]], stroke: Stroke) {
        let placed: Vec<[f64; 2]> = points.iter().map(|&point| self.place(point)).collect();
        self.svg.polylines(std::iter::once(placed.as_slice()), stroke);
    }

    /// A name in the margin, at the height of a value or, where that is taken, below.
    pub fn name(&mut self, value: f64, least_y: f64, color: &str, name: &str) -> f64 {
        let [x, y] = self.place([self.x.high, value]);
        let y = (y + 0.35 * style::SMALL_SIZE).max(least_y);
        self.svg.text([x + 8.0, y], Anchor::Start, style::SMALL_SIZE, color, name);
        y + 1.2 * style::SMALL_SIZE
    }
}
