//! `slew_limits.svg`: how far slews go as something else than their axis varies.

use righting_sweep::{Kind, SlewLimit, Slews};
use serde_json::{Value, json};

use crate::axis::Range;
use crate::chart::{Chart, Labels};
use crate::number::drawn;
use crate::style;
use crate::svg::Stroke;

/// More values than these are averaged over instead.
const MOST_CURVES: usize = COLORS.len();
/// Of more values on the horizontal axis, neighbours are drawn as one.
const MOST_PLACES: usize = 100;
/// Colours of the curves.
const COLORS: [&str; 5] = [style::MAGNITUDE, style::Z, style::Y, style::X, style::W];

/// The figure of a sweep over slew angles and one or two numbers more, as an SVG document: the largest
/// angle up to which all succeed, over the number that varies last, one curve a system, or a value of the number
/// before. Curves are means over everything else (such as axes), bars the least and the most; of more than 100
/// values that vary last, such as random ones, neighbours are put together. None if no number varies.
pub fn slew_limits_svg(name: &str, slews: &Slews) -> Option<String> {
    let varying = |&(i, _): &(usize, _)| !distinct(slews, i).is_empty();
    let numbers: Vec<(usize, &righting_sweep::Column)> = slews
        .columns
        .iter()
        .enumerate()
        .filter(|(_, column)| column.kind == Kind::Number)
        .filter(varying)
        .collect();
    let (&(x_at, x_column), rest) = numbers.split_last()?;
    let series = curves(slews, rest.last().map(|&(at, _)| at));
    let all_xs = distinct(slews, x_at);
    let together = all_xs.len().div_ceil(MOST_PLACES);
    let xs = Range::of(all_xs.iter().copied())?.padded(1e-9);
    let highest = slews.limits.iter().map(|limit| limit.all_up_to_deg).fold(1.0, f64::max);
    let mut subtitle =
        "Largest angle up to which all slews succeed: mean, least and most over the rest"
            .to_owned();
    if together > 1 {
        subtitle += &format!(" and {together} values next to each other");
    }
    let labels = Labels { title: name, subtitle: &subtitle, x: &x_column.name, y: "Angle [deg]" };
    let mut chart = Chart::new(&labels, xs, Range { low: 0.0, high: 1.06 * highest });
    let mut named = 0.0;
    for (i, curve) in series.iter().enumerate().rev() {
        let color = COLORS[i % COLORS.len()];
        let shift = xs.span() * 0.006 * (i as f64 - 0.5 * (series.len() - 1) as f64);
        let mut reached: Vec<[f64; 2]> = slews
            .limits
            .iter()
            .filter(|limit| curve.includes(limit))
            .map(|limit| [number(limit, x_at), limit.all_up_to_deg])
            .collect();
        reached.sort_by(|[a, _], [b, _]| a.total_cmp(b));
        let mut points = Vec::new();
        for place in all_xs.chunks(together) {
            let (from, to) = (place[0], place[place.len() - 1]);
            let x = 0.5 * (from + to);
            let first = reached.partition_point(|[x, _]| *x < from);
            let end = reached.partition_point(|[x, _]| *x <= to);
            let angles = reached[first..end].iter().map(|[_, angle]| *angle);
            let Some(range) = Range::of(angles.clone()) else { continue };
            points.push([x + shift, angles.sum::<f64>() / (end - first) as f64]);
            let bar = Stroke { color: style::FRAME, width: style::HAIR_WIDTH, dash: "" };
            chart.curve(&[[x + shift, range.low], [x + shift, range.high]], bar);
        }
        for &point in &points {
            let at = chart.place(point);
            chart.svg.dot(at, 3.5, color, Stroke { color: style::PAPER, width: 0.5, dash: "" });
        }
        chart.curve(&points, Stroke { color, width: style::CURVE_WIDTH, dash: "" });
        if let (Some(&[_, last]), Some(_)) = (points.last(), curve.column) {
            named = chart.name(last, named, color, &curve.name);
        }
    }
    Some(chart.svg.finish())
}

/// A curve: the slews with one setting of a column, or all of them.
struct Curve {
    column: Option<usize>,
    setting: Value,
    name: String,
}

impl Curve {
    fn includes(&self, limit: &SlewLimit) -> bool {
        let Some(at) = self.column else { return true };
        match self.setting.as_f64() {
            Some(value) => number(limit, at) == value,
            None => limit.settings[at] == self.setting,
        }
    }
}

/// One curve a system, where systems vary, or a value of the column `number`; one for all where there are too
/// many of either.
fn curves(slews: &Slews, number: Option<usize>) -> Vec<Curve> {
    let named = slews.columns.iter().position(|column| column.kind == Kind::Named);
    let of_named = named.map(|at| {
        let mut curves: Vec<Curve> = Vec::new();
        for limit in &slews.limits {
            let setting = &limit.settings[at];
            if curves.iter().all(|curve| curve.setting != *setting) {
                let name = setting["name"].as_str().unwrap_or_default().to_owned();
                curves.push(Curve { column: Some(at), setting: setting.clone(), name });
            }
        }
        curves
    });
    let of_number = number.map(|at| {
        let values = distinct(slews, at).into_iter();
        let name = |value| format!("{} {}", slews.columns[at].name, drawn(value));
        values
            .map(|value| Curve { column: Some(at), setting: json!(value), name: name(value) })
            .collect()
    });
    let few = |curves: &Vec<Curve>| (2..=MOST_CURVES).contains(&curves.len());
    of_named
        .filter(few)
        .or(of_number.filter(few))
        .unwrap_or_else(|| vec![Curve { column: None, setting: Value::Null, name: String::new() }])
}

fn number(limit: &SlewLimit, column: usize) -> f64 {
    limit.settings[column].as_f64().unwrap_or(f64::NAN)
}

/// The values of a column, in order; none if there is only one.
fn distinct(slews: &Slews, column: usize) -> Vec<f64> {
    let mut values: Vec<f64> = slews.limits.iter().map(|limit| number(limit, column)).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    if values.len() > 1 { values } else { Vec::new() }
}
