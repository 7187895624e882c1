//! `slews.svg`: which slews succeed, as points θ·n̂ seen from two sides.

use nalgebra::Vector3;
use righting_sweep::Slews;

use crate::axis::Range;
use crate::heading::heading;
use crate::number::drawn;
use crate::style;
use crate::svg::{Anchor, Stroke, Svg};

/// Side of a view.
const SIDE: f64 = 400.0;
const GAP: f64 = 30.0;
const LEGEND_HEIGHT: f64 = 64.0;
/// Radius of a point in the middle of a view of few; many are drawn smaller.
const POINT: f64 = 4.6;
/// So many points are drawn at that size.
const FEW: f64 = 300.0;
/// Points in front are larger by this share, those behind smaller.
const PERSPECTIVE: f64 = 0.25;
/// Azimuth and elevation of the eye, deg.
const EYES: [[f64; 2]; 2] = [[-60.0, 22.0], [30.0, 22.0]];
const AXES: [&str; 3] = ["x", "y", "z"];

/// The reachability figure of a sweep over slew axes and angles as an SVG document: one point a slew
/// at its rotation vector θ·n̂ (body axes, degrees), coloured by what it cost, a cross where it failed.
pub fn slews_svg(name: &str, slews: &Slews) -> String {
    let width = 2.0 * (style::MARGIN + SIDE) + GAP;
    let top = style::MARGIN + style::TITLE_SIZE + style::LABEL_SIZE + 22.0;
    let height = top + SIDE + LEGEND_HEIGHT;
    let subtitle = subtitle(slews);
    let mut svg = Svg::new(width, height, name, &subtitle);
    let left = style::MARGIN;
    heading(&mut svg, left, name, &subtitle);

    let costs = costs(slews);
    let largest = slews.points.iter().map(|slew| slew.angle_deg.abs()).fold(1e-9, f64::max);
    for (i, eye) in EYES.into_iter().enumerate() {
        let center = [left + 0.5 * SIDE + i as f64 * (SIDE + GAP), top + 0.5 * SIDE];
        let view = View::from(eye, center, 0.42 * SIDE / largest);
        view.draw_sphere(&mut svg, largest);
        view.draw_slews(&mut svg, slews, costs, largest);
    }
    let legend = [left, top + SIDE + 18.0];
    draw_legend(&mut svg, legend, width - 2.0 * style::MARGIN, costs, sample(slews).as_deref());
    svg.finish()
}

/// How many succeed, and what is shown.
pub(crate) fn subtitle(slews: &Slews) -> String {
    let Slews { succeeded, recorded, .. } = slews;
    format!(
        "{succeeded} of {recorded} slews succeed, each verified: rotation vector \u{3b8}\u{b7}n\u{302}, body axes, degrees"
    )
}

/// How many of them are shown, if not all.
pub(crate) fn sample(slews: &Slews) -> Option<String> {
    let Slews { recorded, succeeded, points, .. } = slews;
    let won = points.iter().filter(|slew| slew.succeeded).count();
    let failed = points.len() - won;
    (points.len() < *recorded).then(|| {
        format!(
            "drawn: {won} of {succeeded} that succeed, {failed} of {} that failed",
            recorded - succeeded
        )
    })
}

/// Decimal logarithms of the objectives of slews that succeed.
pub(crate) fn costs(slews: &Slews) -> Range {
    let costs = slews.points.iter().filter(|slew| slew.succeeded && slew.objective > 0.0);
    let costs = Range::of(costs.map(|slew| slew.objective.log10()));
    costs.unwrap_or(Range { low: 0.0, high: 0.0 }).padded(1e-6)
}

/// A parallel projection.
struct View {
    center: [f64; 2],
    scale: f64,
    right: Vector3<f64>,
    up: Vector3<f64>,
    /// Towards the eye.
    near: Vector3<f64>,
}

impl View {
    fn from([azimuth_deg, elevation_deg]: [f64; 2], center: [f64; 2], scale: f64) -> Self {
        let (sin_a, cos_a) = azimuth_deg.to_radians().sin_cos();
        let (sin_e, cos_e) = elevation_deg.to_radians().sin_cos();
        let near = Vector3::new(cos_e * cos_a, cos_e * sin_a, sin_e);
        let right = Vector3::new(-sin_a, cos_a, 0.0);
        Self { center, scale, up: near.cross(&right), right, near }
    }

    fn place(&self, point: &Vector3<f64>) -> [f64; 2] {
        let [x, y] = self.center;
        [x + self.scale * point.dot(&self.right), y - self.scale * point.dot(&self.up)]
    }

    /// The largest angle as a sphere: its outline, its equator and the body axes.
    fn draw_sphere(&self, svg: &mut Svg, radius: f64) {
        let hair = Stroke { color: style::GRID, width: style::HAIR_WIDTH, dash: "" };
        let circle = |a: Vector3<f64>, b: Vector3<f64>| -> Vec<[f64; 2]> {
            let turn = std::f64::consts::TAU / 72.0;
            let at = |i: usize| {
                let (sin, cos) = (turn * i as f64).sin_cos();
                self.place(&(radius * (a * cos + b * sin)))
            };
            (0..=72).map(at).collect()
        };
        let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
        for ring in [circle(self.right, self.up), circle(x, y), circle(x, z), circle(y, z)] {
            svg.polylines(std::iter::once(ring.as_slice()), hair);
        }
        let rule = Stroke { color: style::FRAME, width: style::HAIR_WIDTH, dash: "" };
        for (axis, name) in [x, y, z].into_iter().zip(AXES) {
            svg.line(self.place(&(-radius * axis)), self.place(&(radius * axis)), rule);
            let [px, py] = self.place(&(1.1 * radius * axis));
            let label =
                if name == "z" { format!("z  {}\u{b0}", drawn(radius)) } else { name.to_owned() };
            let at = [px, py + 0.35 * style::LABEL_SIZE];
            svg.text(at, Anchor::Middle, style::LABEL_SIZE, style::INK, &label);
        }
    }

    fn draw_slews(&self, svg: &mut Svg, slews: &Slews, costs: Range, largest: f64) {
        let size = POINT * (FEW / slews.points.len().max(1) as f64).powf(0.35).min(1.0);
        let mut points: Vec<(f64, Vector3<f64>, usize)> = slews
            .points
            .iter()
            .enumerate()
            .map(|(i, slew)| {
                let point = slew.angle_deg * Vector3::from(slew.axis);
                (point.dot(&self.near), point, i)
            })
            .collect();
        points.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
        for (depth, point, i) in points {
            let slew = &slews.points[i];
            let size = size * (1.0 + PERSPECTIVE * depth / largest);
            let [x, y] = self.place(&point);
            if slew.succeeded {
                let share = (slew.objective.log10() - costs.low) / costs.span();
                let edge = Stroke { color: style::PAPER, width: 0.5, dash: "" };
                svg.dot([x, y], (10.0 * size).round() / 10.0, &style::ramp(share), edge);
            } else {
                let width = style::CURVE_WIDTH * (10.0 * size / POINT).round().min(10.0) / 10.0;
                let stroke = Stroke { color: style::X, width, dash: "" };
                svg.line([x - size, y - size], [x + size, y + size], stroke);
                svg.line([x - size, y + size], [x + size, y - size], stroke);
            }
        }
    }
}

/// What the colours and the crosses mean.
fn draw_legend(
    svg: &mut Svg,
    [left, top]: [f64; 2],
    width: f64,
    costs: Range,
    sample: Option<&str>,
) {
    const STEPS: usize = 64;
    let bar = 0.5 * width;
    let cell = bar / STEPS as f64;
    for i in 0..STEPS {
        let color = style::ramp((i as f64 + 0.5) / STEPS as f64);
        svg.rectangle([left + cell * i as f64, top], [cell + 0.4, 10.0], &color);
    }
    for (value, _) in costs.ticks(5.0) {
        let x = left + bar * (value - costs.low) / costs.span();
        let label = drawn(10f64.powf(value));
        svg.text([x, top + 24.0], Anchor::Middle, style::SMALL_SIZE, style::INK, &label);
    }
    let at = [left + 0.5 * bar, top + 39.0];
    svg.text(at, Anchor::Middle, style::SMALL_SIZE, style::INK, "objective of slews that succeed");
    let x = left + bar + 40.0;
    let stroke = Stroke { color: style::X, width: style::CURVE_WIDTH, dash: "" };
    svg.line([x - 4.0, top + 1.0], [x + 4.0, top + 9.0], stroke);
    svg.line([x - 4.0, top + 9.0], [x + 4.0, top + 1.0], stroke);
    svg.text([x + 12.0, top + 9.0], Anchor::Start, style::SMALL_SIZE, style::INK, "failed");
    if let Some(sample) = sample {
        let at = [x - 4.0, top + 24.0];
        svg.text(at, Anchor::Start, style::SMALL_SIZE, style::FAINT_INK, sample);
    }
}
