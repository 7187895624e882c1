//! `explain.svg`: the ellipsoid of turn rates, seen along each body axis.

use std::f64::consts::TAU;

use nalgebra::{Matrix2x3, Vector2, Vector3};

use crate::body_view::{self, BodyView, GAP, SIDE, VIEWS};
use crate::heading::{heading, legend_entry};
use crate::style;
use crate::svg::{Stroke, Svg};

/// Points of an outline.
const POINTS: usize = 180;
const OUTLINE: Stroke = Stroke { color: style::MAGNITUDE, width: style::CURVE_WIDTH, dash: "" };
const PRINCIPAL: [&str; 3] = [style::X, style::Y, style::Z];
const NAMES: [&str; 3] = ["first axis", "second axis", "third axis"];

/// The figure of turn rates as an SVG document: the outlines of their ellipsoid in the xy, xz and yz planes
/// to one scale, its semi-axes (body axes, deg/s; the longest need not be the first), and the axis that a
/// slew asks for (a unit vector, body axes) if there is one.
pub fn turn_rates_svg(
    name: &str,
    semi_axes: &[Vector3<f64>; 3],
    asked: Option<&Vector3<f64>>,
) -> String {
    let left = style::MARGIN + GAP;
    let top = style::MARGIN + style::TITLE_SIZE + 2.0 * style::LABEL_SIZE + 28.0;
    let width = left + 3.0 * (SIDE + GAP) - GAP + style::MARGIN;
    let height = top + SIDE + style::TIME_AXIS_HEIGHT + style::ROW_GAP;
    let subtitle = "Turn rates of the base that loops of the joints keep up, body axes";
    let mut svg = Svg::new(width, height, name, subtitle);
    let base = heading(&mut svg, left, name, subtitle);
    let legend = [("ellipsoid", OUTLINE)].into_iter();
    let legend = legend.chain([0, 1, 2].map(|k| (NAMES[k], principal(k))));
    for (i, (label, stroke)) in legend.chain(asked.map(|_| ("axis asked", ASKED))).enumerate() {
        let x = left + 150.0 * i as f64;
        legend_entry(&mut svg, [x, base], stroke, label);
    }

    let squares: Vector3<f64> = semi_axes.iter().map(|axis| axis.component_mul(axis)).sum();
    let range = body_view::range(std::iter::once(&squares.map(f64::sqrt)));
    for (column, view) in VIEWS.into_iter().enumerate() {
        let corner = [left + column as f64 * (SIDE + GAP), top];
        let view = BodyView { corner, view, range };
        view.draw_axes(&mut svg, "\u{3c9}", "deg/s");
        let line = |svg: &mut Svg, from: Vector3<f64>, to: Vector3<f64>, stroke| {
            let [from, to] = [from, to].map(|end| view.place(view.flat(&end)));
            svg.line(from, to, stroke);
        };
        for (k, semi_axis) in semi_axes.iter().enumerate() {
            line(&mut svg, -semi_axis, *semi_axis, principal(k));
        }
        if let Some(axis) = asked {
            line(&mut svg, Vector3::zeros(), axis * range.high, ASKED);
        }
        let columns = semi_axes.map(|semi_axis| Vector2::from(view.flat(&semi_axis)));
        let outline: Vec<[f64; 2]> =
            shadow(&Matrix2x3::from_columns(&columns)).map(|point| view.place(point)).collect();
        svg.polylines(std::iter::once(outline.as_slice()), OUTLINE);
    }
    svg.finish()
}

const ASKED: Stroke =
    Stroke { color: style::LIMIT, width: style::RULE_WIDTH, dash: style::LIMIT_DASH };

fn principal(k: usize) -> Stroke {
    Stroke { color: PRINCIPAL[k], width: style::RULE_WIDTH, dash: "" }
}

/// The outline of the ellipsoid with these semi-axes as it is seen: L u over all unit vectors u reaches as
/// far as (L Lᵀ)^½ w over unit vectors w of the plane.
fn shadow(semi_axes: &Matrix2x3<f64>) -> impl Iterator<Item = [f64; 2]> {
    let eigen = (semi_axes * semi_axes.transpose()).symmetric_eigen();
    let lengths = eigen.eigenvalues.map(|value| value.max(0.0).sqrt());
    (0..=POINTS).map(move |k| {
        let (sin, cos) = (TAU * k as f64 / POINTS as f64).sin_cos();
        (eigen.eigenvectors * Vector2::new(lengths.x * cos, lengths.y * sin)).into()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ellipsoid_s_outline_touches_its_support_lines() {
        let semi_axes = Matrix2x3::new(1.0, 0.5, -0.2, 0.3, -0.4, 2.0);
        let direction = Vector2::new(0.6, 0.8);
        let support = (semi_axes.transpose() * direction).norm();
        let reached = shadow(&semi_axes).map(|point| direction.dot(&Vector2::from(point)));
        let reached = reached.fold(0.0, f64::max);
        assert!(reached <= support + 1e-12 && reached > 0.999 * support, "{reached} {support}");
    }

    #[test]
    fn an_arm_that_turns_nothing_still_has_a_figure() {
        let nothing = [Vector3::zeros(); 3];
        assert!(turn_rates_svg("a<b", &nothing, Some(&Vector3::x())).ends_with("</svg>\n"));
    }
}
