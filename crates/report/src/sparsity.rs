//! `sparsity.svg`: where the KKT matrix of the nonlinear program can be nonzero.

use righting_ocp::KktSparsity;
use righting_results::Solution;

use crate::figure::heading;
use crate::style;
use crate::svg::{Anchor, Stroke, Svg};

const SIDE: f64 = 620.0;
const LEGEND: [(&str, &str); 2] =
    [("Hessian of the Lagrangian", style::Z), ("constraint Jacobian", style::X)];

/// The figure of a KKT matrix of the first few intervals, both triangles, as an SVG document;
/// `steps` is the number of intervals it is of.
pub fn sparsity_svg(solution: &Solution, sparsity: &KktSparsity, steps: usize) -> String {
    let size = sparsity.variables + sparsity.constraints;
    let left = style::MARGIN + style::TICK_LABEL_WIDTH;
    let top = style::MARGIN + style::TITLE_SIZE + 3.0 * style::LABEL_SIZE + 22.0;
    let (title, _) = heading(solution);
    let subtitle = format!(
        "KKT matrix of {steps} of {} intervals: {} variables, {} constraints, {} entries",
        solution.scenario.horizon.steps,
        sparsity.variables,
        sparsity.constraints,
        sparsity.hessian.len() + sparsity.jacobian.len(),
    );
    let width = left + SIDE + style::MARGIN;
    let height = top + SIDE + style::TIME_AXIS_HEIGHT;
    let mut svg = Svg::new(width, height, &title, &subtitle);
    let mut base = style::MARGIN + style::TITLE_SIZE;
    svg.text([left, base], Anchor::Start, style::TITLE_SIZE, style::INK, &title);
    base += style::LABEL_SIZE + 7.0;
    svg.text([left, base], Anchor::Start, style::LABEL_SIZE, style::FAINT_INK, &subtitle);
    base += style::LABEL_SIZE + 7.0;
    for (i, (name, color)) in LEGEND.into_iter().enumerate() {
        let x = left + 210.0 * i as f64;
        svg.squares(std::iter::once([x, base - 9.0]), 9.0, color);
        svg.text([x + 15.0, base], Anchor::Start, style::SMALL_SIZE, style::INK, name);
    }
    let cell = SIDE / size.max(1) as f64;
    let place =
        |(row, column): (usize, usize)| [left + cell * column as f64, top + cell * row as f64];
    let both = |(row, column): (usize, usize)| [place((row, column)), place((column, row))];
    let hessian = sparsity.hessian.iter().copied().flat_map(both);
    svg.squares(hessian, cell, LEGEND[0].1);
    let below = |&(row, column): &(usize, usize)| (sparsity.variables + row, column);
    svg.squares(sparsity.jacobian.iter().map(below).flat_map(both), cell, LEGEND[1].1);
    let hair = Stroke { color: style::FRAME, width: style::HAIR_WIDTH, dash: "" };
    let border = cell * sparsity.variables as f64;
    svg.line([left, top + border], [left + SIDE, top + border], hair);
    svg.line([left + border, top], [left + border, top + SIDE], hair);
    svg.frame([left, top], [SIDE, SIDE], hair);
    let ink = (style::LABEL_SIZE, style::INK);
    let under = top + SIDE + style::LABEL_SIZE + 6.0;
    let rest = 0.5 * (border + SIDE);
    for (middle, name) in [(0.5 * border, "Variables [\u{2013}]"), (rest, "Multipliers [\u{2013}]")]
    {
        svg.text([left + middle, under], Anchor::Middle, ink.0, ink.1, name);
        svg.vertical_text([left - 12.0, top + middle], ink.0, ink.1, name);
    }
    svg.finish()
}
