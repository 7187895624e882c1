//! One set of axes: curves over time, or another quantity, with the values they must keep to.

use crate::axis::Range;
use crate::number::drawn;
use crate::style;
use crate::svg::{Anchor, Stroke, Svg};

/// A quantity over time.
#[derive(Clone)]
pub(crate) struct Curve {
    /// Its legend entry; none when empty.
    pub name: String,
    pub color: &'static str,
    /// A dash pattern; empty for a solid curve.
    pub dash: &'static str,
    /// One value a node; one fewer when `hold` and the last node has none.
    pub values: Vec<f64>,
    /// Each value lasts until the next node, as a control does.
    pub hold: bool,
}

impl Curve {
    /// A solid curve through values at the nodes, without a legend entry.
    pub fn plain(color: &'static str, values: Vec<f64>) -> Self {
        Self { name: String::new(), color, dash: "", values, hold: false }
    }

    /// The curve of a joint, counted from zero, named by its number.
    pub fn of_joint(joint: usize, values: Vec<f64>) -> Self {
        let (color, dash) = style::joint(joint);
        Self { name: (joint + 1).to_string(), dash, ..Self::plain(color, values) }
    }
}

/// A constant that curves are judged by.
#[derive(Clone, Copy)]
pub(crate) struct Rule {
    pub kind: RuleKind,
    pub value: f64,
}

/// What a [`Rule`] means.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum RuleKind {
    /// Not to be crossed: dashed.
    Limit,
    /// To be reached: dotted, in the colour of the curve that is to reach it.
    Target(&'static str),
    /// Another's value, to compare with: dashed grey.
    Reference,
}

/// How values map to heights.
#[derive(Clone, Copy, Default, PartialEq)]
pub(crate) enum Scale {
    #[default]
    Linear,
    /// Powers of ten; what is not positive is not drawn.
    Logarithmic,
}

/// A panel's contents.
#[derive(Clone, Default)]
pub(crate) struct Panel {
    pub heading: String,
    /// Quantity and unit; left out when empty.
    pub axis_label: &'static str,
    /// A remark in the heading line, at the right end.
    pub note: String,
    pub curves: Vec<Curve>,
    pub rules: Vec<Rule>,
    /// The least height of the axis, in its unit: anything smaller is drawn as constant. A
    /// logarithmic axis has one decade at least instead.
    pub least_span: f64,
    pub scale: Scale,
}

/// Where a panel lies on the page.
#[derive(Clone, Copy)]
pub(crate) struct Placement {
    pub corner: [f64; 2],
    pub size: [f64; 2],
    /// Name of the horizontal axis, drawn with its tick labels; neither when empty.
    pub across: &'static str,
}

const RULE_LABEL_INSET: f64 = 4.0;
/// Height kept free of curves for a limit that is off scale and its label.
const OFF_SCALE_STRIP: f64 = 16.0;

/// Below this share of its limit a quantity counts as constant.
const LEAST_SHARE: f64 = 1e-9;

impl Panel {
    /// Of a quantity that is limited by `most` in magnitude, and also from below where it has a sign; its peak stands
    /// in the corner.
    pub fn limited(
        heading: String,
        axis_label: &'static str,
        values: Vec<f64>,
        most: f64,
        is_signed: bool,
    ) -> Self {
        let peak = values.iter().fold(0.0, |peak: f64, value| peak.max(value.abs()));
        let limit = |value| Rule { kind: RuleKind::Limit, value };
        let color = if is_signed { style::Z } else { style::MAGNITUDE };
        Self {
            heading,
            axis_label,
            note: format!("peak {} of {}", drawn(peak), drawn(most)),
            curves: vec![Curve::plain(color, values)],
            rules: is_signed.then(|| limit(-most)).into_iter().chain([limit(most)]).collect(),
            least_span: LEAST_SHARE * most,
            ..Self::default()
        }
    }

    /// The range of values shown: all curves and targets, and each limit that leaves the curves
    /// [`style::LEAST_CURVE_SHARE`] of the height. The other limits get a strip at the edge that
    /// they lie behind, out of the `height` in pixels.
    fn range(&self, height: f64) -> Range {
        let is_target = |rule: &&Rule| matches!(rule.kind, RuleKind::Target(_));
        let values = self.curves.iter().flat_map(|curve| curve.values.iter().copied());
        let targets = self.rules.iter().filter(is_target).map(|rule| rule.value);
        let curves = Range::of(values.chain(targets)).unwrap_or(Range { low: 0.0, high: 0.0 });
        let largest = curves.span().max(self.least_span) / style::LEAST_CURVE_SHARE;
        let mut limits: Vec<f64> = self.rules.iter().map(|rule| rule.value).collect();
        limits.retain(|v| v.is_finite());
        // The nearest limit first: of a pair too far apart to show, the one that matters stays.
        let distance = |v: f64| (curves.low - v).max(v - curves.high);
        limits.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)));
        let include = |range: Range, limit: f64| {
            let wider = range.including(limit);
            if wider.span() <= largest { wider } else { range }
        };
        let shown = match limits.as_slice() {
            // A limit either way is one limit: half of it would make the panel lopsided.
            &[a, b] if a == -b => {
                let both = curves.including(a).including(b);
                if both.span() <= largest { both } else { curves }
            }
            limits => limits.iter().copied().fold(curves, include),
        };
        let shown = shown.padded(self.least_span);
        let strip = |off_scale: bool| if off_scale { OFF_SCALE_STRIP } else { 0.0 };
        let is_off_scale = |beyond: &dyn Fn(f64) -> bool| {
            self.rules.iter().any(|rule| rule.value.is_finite() && beyond(rule.value))
        };
        let above = strip(is_off_scale(&|value| value > shown.high));
        let below = strip(is_off_scale(&|value| value < shown.low));
        let per_pixel = shown.span() / (height - above - below);
        Range { low: shown.low - below * per_pixel, high: shown.high + above * per_pixel }
    }

    /// Draws the panel over the nodes at `times`.
    pub fn draw(&self, svg: &mut Svg, times: &[f64], at: Placement) {
        if self.scale == Scale::Logarithmic {
            self.in_decades().draw_linearly(svg, times, at, Scale::Logarithmic);
        } else {
            self.draw_linearly(svg, times, at, Scale::Linear);
        }
    }

    /// The same with the decimal logarithms of all values.
    fn in_decades(&self) -> Self {
        let decades = |value: f64| if value > 0.0 { value.log10() } else { f64::NAN };
        let mut panel = self.clone();
        panel.scale = Scale::Linear;
        panel.least_span = 1.0;
        let values = panel.curves.iter_mut().flat_map(|curve| &mut curve.values);
        values.chain(panel.rules.iter_mut().map(|rule| &mut rule.value)).for_each(|value| {
            *value = decades(*value);
        });
        panel
    }

    fn draw_linearly(&self, svg: &mut Svg, times: &[f64], at: Placement, scale: Scale) {
        let axes = Axes {
            time: Range::of(times.iter().copied()).unwrap_or(Range { low: 0.0, high: 1.0 }),
            value: self.range(at.size[1]),
            has_fractions: times.iter().any(|time| time.fract() != 0.0),
            scale,
            at,
        };
        axes.draw_grid(svg);
        for rule in &self.rules {
            axes.draw_rule(svg, rule);
        }
        for curve in &self.curves {
            let stroke = Stroke { color: curve.color, width: style::CURVE_WIDTH, dash: curve.dash };
            let runs = axes.runs(times, curve);
            svg.polylines(runs.iter().map(Vec::as_slice), stroke);
        }
        self.draw_heading(svg, at);
        if !self.axis_label.is_empty() {
            let x = at.corner[0] - style::TICK_LABEL_WIDTH - 2.0;
            let middle = at.corner[1] + 0.5 * at.size[1];
            svg.vertical_text([x, middle], style::LABEL_SIZE, style::INK, self.axis_label);
        }
    }

    /// The heading at the left end, legend and note at the right one.
    fn draw_heading(&self, svg: &mut Svg, at: Placement) {
        let [left, top] = at.corner;
        let base = top - 6.0;
        if !self.heading.is_empty() {
            svg.text([left, base], Anchor::Start, style::LABEL_SIZE, style::INK, &self.heading);
        }
        let mut right = left + at.size[0];
        if !self.note.is_empty() {
            let size = style::SMALL_SIZE;
            svg.text([right, base], Anchor::End, size, style::FAINT_INK, &self.note);
            right -= advance(&self.note) + 14.0;
        }
        // Legends may come as near to the heading as its real letters allow.
        let room = left + 0.88 * advance(&self.heading) * style::LABEL_SIZE / style::SMALL_SIZE;
        for curve in self.curves.iter().rev().filter(|curve| !curve.name.is_empty()) {
            let size = style::SMALL_SIZE;
            if right - advance(&curve.name) - 21.0 < room {
                svg.text([right, base], Anchor::End, size, style::INK, "\u{2026}");
                break;
            }
            svg.text([right, base], Anchor::End, size, style::INK, &curve.name);
            right -= advance(&curve.name) + 5.0;
            let width = 1.5 * style::CURVE_WIDTH;
            let stroke = Stroke { color: curve.color, width, dash: curve.dash };
            svg.line([right - 16.0, base - 3.5], [right, base - 3.5], stroke);
            right -= 16.0 + 12.0;
        }
    }
}

/// The width of a small text, near enough to keep legend entries apart.
fn advance(text: &str) -> f64 {
    text.chars().count() as f64 * style::SMALL_SIZE * style::CHARACTER_ADVANCE
}

/// The map from (time, value) to the page.
struct Axes {
    time: Range,
    value: Range,
    /// Whether there is anything between whole numbers of the horizontal axis.
    has_fractions: bool,
    /// How ticks of values are labelled.
    scale: Scale,
    at: Placement,
}

impl Axes {
    fn x(&self, time: f64) -> f64 {
        let span = self.time.span().max(f64::MIN_POSITIVE);
        self.at.corner[0] + self.at.size[0] * (time - self.time.low) / span
    }

    fn y(&self, value: f64) -> f64 {
        self.at.corner[1] + self.at.size[1] * (self.value.high - value) / self.value.span()
    }

    /// Ticks of the value axis: of a logarithmic one at whole powers, and between them where it
    /// shows no two of those.
    fn value_ticks(&self, count: f64) -> Vec<(f64, String)> {
        let ticks = self.value.ticks(count);
        if self.scale == Scale::Linear {
            return ticks;
        }
        let is_whole = |value: f64| (value - value.round()).abs() < 1e-9;
        let few = self.value.span() < 2.0;
        let ticks = ticks.into_iter().filter(|(value, _)| few || is_whole(*value));
        let label = |value: f64| if few { drawn(10f64.powf(value)) } else { power_of_ten(value) };
        ticks.map(|(value, _)| (value, label(value))).collect()
    }

    fn draw_grid(&self, svg: &mut Svg) {
        let [left, top] = self.at.corner;
        let [width, height] = self.at.size;
        let grid = Stroke { color: style::GRID, width: style::HAIR_WIDTH, dash: "" };
        let size = style::SMALL_SIZE;
        for (time, label) in self.time.ticks(6.0) {
            if !self.has_fractions && time.fract().abs() > 1e-9 {
                continue;
            }
            let x = self.x(time);
            let label = if self.has_fractions { label } else { format!("{time:.0}") };
            svg.line([x, top], [x, top + height], grid);
            if !self.at.across.is_empty() {
                let at = [x, top + height + size + 4.0];
                svg.text(at, Anchor::Middle, size, style::INK, &label);
            }
        }
        for (value, label) in self.value_ticks((height / 20.0).clamp(4.0, 6.0)) {
            let y = self.y(value);
            svg.line([left, y], [left + width, y], grid);
            svg.text([left - 5.0, y + 0.35 * size], Anchor::End, size, style::INK, &label);
        }
        let frame = Stroke { color: style::FRAME, width: style::HAIR_WIDTH, dash: "" };
        svg.frame(self.at.corner, self.at.size, frame);
        if !self.at.across.is_empty() {
            let at = [left + 0.5 * width, top + height + style::TIME_AXIS_HEIGHT - 6.0];
            svg.text(at, Anchor::Middle, style::LABEL_SIZE, style::INK, self.at.across);
        }
    }

    /// A rule across the panel; one beyond the axis is drawn at the edge it lies behind, and says so.
    fn draw_rule(&self, svg: &mut Svg, rule: &Rule) {
        if !rule.value.is_finite() {
            return;
        }
        let (color, dash) = match rule.kind {
            RuleKind::Limit => (style::LIMIT, style::LIMIT_DASH),
            RuleKind::Target(color) => (color, style::TARGET_DASH),
            RuleKind::Reference => (style::REFERENCE, style::LIMIT_DASH),
        };
        let stroke = Stroke { color, width: style::RULE_WIDTH, dash };
        let [left, top] = self.at.corner;
        let right = left + self.at.size[0];
        let above = rule.value > self.value.high;
        let off_scale = !self.value.contains(rule.value);
        let y = match (off_scale, above) {
            (false, _) => self.y(rule.value),
            (true, true) => top + 2.5,
            (true, false) => top + self.at.size[1] - 2.5,
        };
        svg.line([left, y], [right, y], stroke);
        if off_scale {
            let arrow = if above { '\u{2191}' } else { '\u{2193}' };
            let baseline = if above { y + style::SMALL_SIZE } else { y - 3.5 };
            let value = match self.scale {
                Scale::Linear => rule.value,
                Scale::Logarithmic => 10f64.powf(rule.value),
            };
            let label = format!("{} {arrow} off scale", drawn(value));
            let at = [right - RULE_LABEL_INSET, baseline];
            svg.text(at, Anchor::End, style::SMALL_SIZE, color, &label);
        }
    }

    /// The curve as runs of points on the page, broken where a value is not finite.
    fn runs(&self, times: &[f64], curve: &Curve) -> Vec<Vec<[f64; 2]>> {
        let mut runs = vec![Vec::new()];
        for (k, &value) in curve.values.iter().enumerate().take(times.len()) {
            if !(value.is_finite() && times[k].is_finite()) {
                runs.push(Vec::new());
                continue;
            }
            let run = runs.last_mut().expect("there is always one");
            let y = self.y(value);
            run.push([self.x(times[k]), y]);
            if let (true, Some(&until)) = (curve.hold, times.get(k + 1)) {
                run.push([self.x(until), y]);
            }
        }
        runs.iter().map(|run| thinned(run)).collect()
    }
}

/// 10 with the whole exponent raised.
fn power_of_ten(exponent: f64) -> String {
    let raised = |c: char| match c {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        digit => char::from_u32(0x2070 + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
    };
    let digits: String = format!("{exponent:.0}").chars().map(raised).collect();
    format!("10{digits}")
}

/// `points`, ordered in x, with no more than first, lowest, highest and last of each quarter pixel:
/// what the eye sees of a long trajectory, at a size that does not grow with it.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept = Vec::with_capacity(points.len().min(8192));
    for column in points.chunk_by(|a, b| (4.0 * a[0]).floor() == (4.0 * b[0]).floor()) {
        if column.len() <= 4 {
            kept.extend_from_slice(column);
            continue;
        }
        let by_height = |&a: &usize, &b: &usize| column[a][1].total_cmp(&column[b][1]);
        let lowest = (0..column.len()).min_by(by_height).unwrap_or(0);
        let highest = (0..column.len()).max_by(by_height).unwrap_or(0);
        let mut chosen = [0, lowest.min(highest), lowest.max(highest), column.len() - 1].to_vec();
        chosen.dedup();
        kept.extend(chosen.into_iter().map(|i| column[i]));
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(values: Vec<f64>, limits: &[f64]) -> Panel {
        let rules =
            limits.iter().map(|&value| Rule { kind: RuleKind::Limit, value }).collect::<Vec<_>>();
        let curves = vec![Curve::plain(style::Z, values)];
        Panel { curves, rules, least_span: 1e-3, ..Panel::default() }
    }

    #[test]
    fn near_limits_are_to_scale_and_far_ones_are_not() {
        let range = panel(vec![-3.0, 3.0], &[-17.2, 17.2]).range(100.0);
        assert!(range.contains(17.2) && range.contains(-17.2));
        let range = panel(vec![-0.3, 0.3], &[-17.2, 17.2]).range(100.0);
        assert!(!range.contains(17.2) && !range.contains(-17.2));
        let range = panel(vec![-1.0, 1.5], &[-11.5, 11.5]).range(100.0);
        assert!(!range.contains(11.5) && !range.contains(-11.5));
        let range = panel(vec![40.0, 50.0], &[45.0, f64::INFINITY]).range(100.0);
        assert!(range.span() < 20.0);
    }

    #[test]
    fn long_curves_are_thinned_but_keep_their_extremes() {
        let points: Vec<_> = (0..100_000)
            .map(|i| [i as f64 * 1e-3, if i == 54_321 { 9.0 } else { (i % 7) as f64 * 0.1 }])
            .collect();
        let thin = thinned(&points);
        assert!(thin.len() <= 4 * 401, "{}", thin.len());
        assert!(thin.iter().any(|p| p[1] == 9.0));
        assert_eq!(thin.first(), points.first());
        assert_eq!(thin.last(), points.last());
        assert!(thin.is_sorted_by(|a, b| a[0] <= b[0]));
    }

    #[test]
    fn powers_of_ten_are_raised() {
        let shown = [-12.0, 0.0, 3.0].map(power_of_ten);
        assert_eq!(shown, ["10⁻¹²", "10⁰", "10³"]);
    }

    #[test]
    fn what_is_not_positive_has_no_logarithm() {
        let logarithmic = panel(vec![1e-3, 0.0, -1.0, 100.0], &[10.0]).in_decades();
        assert_eq!(logarithmic.curves[0].values[0], -3.0);
        assert!(logarithmic.curves[0].values[1].is_nan());
        assert!(logarithmic.curves[0].values[2].is_nan());
        assert_eq!((logarithmic.curves[0].values[3], logarithmic.rules[0].value), (2.0, 1.0));
    }

    #[test]
    fn gaps_break_a_curve() {
        let axes = Axes {
            time: Range { low: 0.0, high: 3.0 },
            value: Range { low: 0.0, high: 1.0 },
            has_fractions: true,
            scale: Scale::Linear,
            at: Placement { corner: [0.0, 0.0], size: [3.0, 1.0], across: "" },
        };
        let curve = Curve::plain("", vec![1.0, f64::NAN, 0.0, 0.5]);
        let runs = axes.runs(&[0.0, 1.0, 2.0, 3.0], &curve);
        assert_eq!(runs, [vec![[0.0, 0.0]], vec![[2.0, 1.0], [3.0, 0.5]]]);
    }
}
