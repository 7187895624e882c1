//! What stands above a figure: its name, what it shows, and which line means what.

use crate::style;
use crate::svg::{Anchor, Stroke, Svg};

/// Room between a line of the heading and the next.
const LEADING: f64 = 7.0;

/// Writes name and subtitle at the top of a figure. Returns the baseline of the line that follows.
pub(crate) fn heading(svg: &mut Svg, left: f64, name: &str, subtitle: &str) -> f64 {
    let base = style::MARGIN + style::TITLE_SIZE;
    svg.text([left, base], Anchor::Start, style::TITLE_SIZE, style::INK, name);
    let base = base + style::LABEL_SIZE + LEADING;
    svg.text([left, base], Anchor::Start, style::LABEL_SIZE, style::FAINT_INK, subtitle);
    base + style::LABEL_SIZE + LEADING
}

/// An entry of a legend: a piece of the line, and what it means.
pub(crate) fn legend_entry(svg: &mut Svg, [x, base]: [f64; 2], stroke: Stroke, label: &str) {
    svg.line([x, base - 4.0], [x + 26.0, base - 4.0], stroke);
    svg.text([x + 32.0, base], Anchor::Start, style::SMALL_SIZE, style::INK, label);
}
