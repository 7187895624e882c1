//! A page of panels over one horizontal axis.

use righting_results::Solution;

use crate::panel::{Panel, Placement};
use crate::svg::{Anchor, Svg};
use crate::{asked, style};

/// Panels in a grid, row by row, sharing one horizontal axis.
pub(crate) struct Figure {
    pub title: String,
    pub subtitle: String,
    /// Name and unit of the horizontal axis.
    pub across: &'static str,
    /// Where the panels' values lie on it: times of the nodes, s, in most figures.
    pub places: Vec<f64>,
    pub columns: usize,
    /// Width and height of every panel.
    pub panel_size: [f64; 2],
    pub panels: Vec<Panel>,
}

impl Default for Figure {
    fn default() -> Self {
        Self {
            title: String::new(),
            subtitle: String::new(),
            across: "Time [s]",
            places: Vec::new(),
            columns: 1,
            panel_size: [0.0; 2],
            panels: Vec::new(),
        }
    }
}

impl Figure {
    /// The figure as an SVG document.
    pub fn render(&self) -> String {
        let columns = self.columns.max(1);
        let rows = self.panels.len().div_ceil(columns);
        let [panel_width, panel_height] = self.panel_size;
        // Only the first column names its axis; all of them need room for tick labels.
        let left = style::MARGIN + style::AXIS_LABEL_WIDTH;
        let column_step = style::TICK_LABEL_WIDTH + panel_width + style::COLUMN_GAP;
        let top = style::MARGIN + style::TITLE_SIZE + style::LABEL_SIZE + 14.0;
        let row_step = style::HEADING_HEIGHT + panel_height + style::ROW_GAP;
        let width = left + columns as f64 * column_step - style::COLUMN_GAP + style::MARGIN;
        let height = top + rows as f64 * row_step + style::TIME_AXIS_HEIGHT;

        let mut svg = Svg::new(width, height, &self.title, &self.subtitle);
        let base = style::MARGIN + style::TITLE_SIZE;
        svg.text([left, base], Anchor::Start, style::TITLE_SIZE, style::INK, &self.title);
        let base = base + style::LABEL_SIZE + 7.0;
        svg.text([left, base], Anchor::Start, style::LABEL_SIZE, style::FAINT_INK, &self.subtitle);
        for (i, panel) in self.panels.iter().enumerate() {
            let (row, column) = (i / columns, i % columns);
            let corner = [
                left + column as f64 * column_step + style::TICK_LABEL_WIDTH,
                top + row as f64 * row_step + style::HEADING_HEIGHT,
            ];
            let is_lowest = i + columns >= self.panels.len();
            let across = if is_lowest { self.across } else { "" };
            panel.draw(&mut svg, &self.places, Placement { corner, size: self.panel_size, across });
        }
        svg.finish()
    }
}

/// Title and subtitle of a maneuver's figures: what it is, what was asked, whether it is proven.
pub(crate) fn heading(solution: &Solution) -> (String, String) {
    let asked = asked::planned_phrase_drawn(solution);
    (solution.scenario.name.clone(), format!("{asked}, {}", verdict_in_short(solution)))
}

/// Whether a plan is proven, in a word or two.
pub(crate) fn verdict_in_short(solution: &Solution) -> &'static str {
    match (solution.status.is_acceptable(), solution.verification.passed) {
        (true, true) => "verified",
        (false, true) => "verified, not optimal",
        (true, false) => "NOT VERIFIED",
        (false, false) => "NOT SOLVED",
    }
}
