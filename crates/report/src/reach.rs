//! `reach.svg`: what each tried duration or angle costs, and what it misses.

use righting_planner::reach::{Quantity, Reach, Try};
use righting_scenario::file::Scenario;
use righting_verifier::ATTITUDE_ERROR;

use crate::axis::Range;
use crate::number::drawn;
use crate::svg::{Anchor, Stroke, Svg};
use crate::{asked, style};

const SIZE: [f64; 2] = [620.0, 190.0];
const DOT_RADIUS: f64 = 3.6;

/// The figure of a search as an SVG document: objective, and attitude error or angular rate left,
/// over the durations or angles tried. What came to no plan is not in it.
pub fn reach_svg(scenario: &Scenario, reach: &Reach) -> String {
    let mut points: Vec<&Try> =
        reach.tries.iter().filter(|tried| tried.status.is_acceptable()).collect();
    points.sort_by(|a, b| a.value(reach.quantity).total_cmp(&b.value(reach.quantity)));
    let without = reach.tries.len() - points.len();
    let missing = match without {
        0 => String::new(),
        1 => ", 1 without a plan is not shown".to_owned(),
        _ => format!(", {without} without a plan are not shown"),
    };
    let title = &scenario.name;
    let subtitle = format!("Reach of the {}{missing}", asked::phrase_drawn(scenario));
    let left = style::MARGIN + style::AXIS_LABEL_WIDTH + style::TICK_LABEL_WIDTH;
    let top = style::MARGIN + style::TITLE_SIZE + style::LABEL_SIZE + 14.0;
    let row_step = style::HEADING_HEIGHT + SIZE[1] + style::ROW_GAP;
    let width = left + SIZE[0] + style::MARGIN;
    let height = top + 2.0 * row_step + style::TIME_AXIS_HEIGHT;
    let mut svg = Svg::new(width, height, title, &subtitle);
    let mut base = style::MARGIN + style::TITLE_SIZE;
    let start = style::MARGIN;
    svg.text([start, base], Anchor::Start, style::TITLE_SIZE, style::INK, title);
    base += style::LABEL_SIZE + 7.0;
    svg.text([start, base], Anchor::Start, style::LABEL_SIZE, style::FAINT_INK, &subtitle);

    let across = Range::of(points.iter().map(|tried| tried.value(reach.quantity)))
        .unwrap_or(Range { low: 0.0, high: 1.0 })
        .padded(1e-3);
    let corner = |row: f64| [left, top + row * row_step + style::HEADING_HEIGHT];
    let chart = |row: f64, heading, label, is_logarithmic, rules| Chart {
        corner: corner(row),
        heading,
        label,
        is_logarithmic,
        rules,
        across,
        edge: reach.first_succeeding,
    };
    // A slew's objective is all effort and grows by decades; a detumble's, the rate left, does not.
    let is_slew = reach.bound_deg_s.is_none();
    let cost = chart(0.0, "Objective".to_owned(), "Objective [\u{2013}]", is_slew, Vec::new());
    cost.draw(&mut svg, reach, &points, |tried| tried.objective);
    let (missed, read): (Chart, fn(&Try) -> f64) = match reach.bound_deg_s {
        None => {
            let heading = format!("Attitude error at the end (dashed: {ATTITUDE_ERROR:.0e})");
            let rules = vec![ATTITUDE_ERROR];
            let chart = chart(1.0, heading, "Error [\u{2013}]", true, rules);
            (chart, |tried| tried.terminal.attitude_error)
        }
        Some(bound) => {
            let heading = format!("Angular rate left (dashed: its bound, {} deg/s)", drawn(bound));
            let chart = chart(1.0, heading, "Rate [deg/s]", false, vec![bound]);
            (chart, |tried| tried.terminal.angular_rate_deg_s)
        }
    };
    missed.draw(&mut svg, reach, &points, read);
    missed.draw_axis(&mut svg, reach);
    svg.finish()
}

/// One set of axes with a point a try.
struct Chart {
    corner: [f64; 2],
    heading: String,
    label: &'static str,
    is_logarithmic: bool,
    /// Values that the points are judged by.
    rules: Vec<f64>,
    /// The durations or angles.
    across: Range,
    /// The hardest success.
    edge: Option<f64>,
}

impl Chart {
    fn draw(&self, svg: &mut Svg, reach: &Reach, points: &[&Try], read: fn(&Try) -> f64) {
        let [left, top] = self.corner;
        let [width, height] = SIZE;
        let placed: Vec<(bool, f64, f64)> = points
            .iter()
            .map(|tried| (tried.succeeded, tried.value(reach.quantity), self.scaled(read(tried))))
            .filter(|(_, _, y)| y.is_finite())
            .collect();
        let rules = self.rules.iter().map(|&rule| self.scaled(rule));
        let up = Range::of(placed.iter().map(|(_, _, y)| *y).chain(rules.clone()))
            .unwrap_or(Range { low: 0.0, high: 1.0 })
            .padded(if self.is_logarithmic { 0.5 } else { 1e-3 });
        let x = |value: f64| left + width * (value - self.across.low) / self.across.span();
        let y = |value: f64| top + height * (up.high - value) / up.span();

        let grid = Stroke { color: style::GRID, width: style::HAIR_WIDTH, dash: "" };
        let size = style::SMALL_SIZE;
        for (value, _) in self.across.ticks(8.0) {
            svg.line([x(value), top], [x(value), top + height], grid);
        }
        let ticks = if self.is_logarithmic { up.decades() } else { up.ticks(5.0) };
        for (value, label) in ticks {
            let y = y(value);
            svg.line([left, y], [left + width, y], grid);
            svg.text([left - 5.0, y + 0.35 * size], Anchor::End, size, style::INK, &label);
        }
        let frame = Stroke { color: style::FRAME, width: style::HAIR_WIDTH, dash: "" };
        svg.frame(self.corner, SIZE, frame);
        let limit =
            Stroke { color: style::LIMIT, width: style::RULE_WIDTH, dash: style::LIMIT_DASH };
        for rule in rules {
            svg.line([left, y(rule)], [left + width, y(rule)], limit);
        }
        if let Some(edge) = self.edge {
            let dotted = Stroke {
                color: style::FAINT_INK,
                width: style::RULE_WIDTH,
                dash: style::TARGET_DASH,
            };
            svg.line([x(edge), top], [x(edge), top + height], dotted);
        }
        let curve: Vec<[f64; 2]> =
            placed.iter().filter(|point| point.0).map(|point| [x(point.1), y(point.2)]).collect();
        let line = Stroke { color: style::Z, width: style::CURVE_WIDTH, dash: "" };
        svg.polylines(std::iter::once(curve.as_slice()), line);
        for (succeeded, across, up) in placed {
            let (fill, stroke) = marks(succeeded);
            svg.dot([x(across), y(up)], DOT_RADIUS, fill, stroke);
        }
        let base = top - 6.0;
        svg.text([left, base], Anchor::Start, style::LABEL_SIZE, style::INK, &self.heading);
        let mut right = left + width;
        for (succeeded, name) in [(false, "fails"), (true, "succeeds")] {
            svg.text([right, base], Anchor::End, size, style::INK, name);
            right -= name.len() as f64 * size * style::CHARACTER_ADVANCE + 8.0;
            let (fill, stroke) = marks(succeeded);
            svg.dot([right, base - 3.5], DOT_RADIUS, fill, stroke);
            right -= 14.0;
        }
        let beside = [left - style::TICK_LABEL_WIDTH - 2.0, top + 0.5 * height];
        svg.vertical_text(beside, style::LABEL_SIZE, style::INK, self.label);
    }

    /// Labels and name of the axis that both charts share.
    fn draw_axis(&self, svg: &mut Svg, reach: &Reach) {
        let [left, top] = self.corner;
        let [width, height] = SIZE;
        let size = style::SMALL_SIZE;
        for (value, label) in self.across.ticks(8.0) {
            let x = left + width * (value - self.across.low) / self.across.span();
            let at = [x, top + height + size + 4.0];
            svg.text(at, Anchor::Middle, size, style::INK, &label);
        }
        let (name, unit) = match reach.quantity {
            Quantity::Duration => ("Duration [s]", "s is the shortest"),
            Quantity::Angle => ("Angle [deg]", "deg is the largest"),
        };
        let edge = match reach.first_succeeding {
            Some(edge) => format!("{name} (dotted: {edge} {unit} that succeeds)"),
            None => name.to_owned(),
        };
        let at = [left + 0.5 * width, top + height + style::TIME_AXIS_HEIGHT - 6.0];
        svg.text(at, Anchor::Middle, style::LABEL_SIZE, style::INK, &edge);
    }

    fn scaled(&self, value: f64) -> f64 {
        if self.is_logarithmic { value.log10() } else { value }
    }
}

fn marks(succeeded: bool) -> (&'static str, Stroke) {
    let color = if succeeded { style::Z } else { style::X };
    let fill = if succeeded { style::Z } else { style::PAPER };
    (fill, Stroke { color, width: style::CURVE_WIDTH, dash: "" })
}
