//! `flights.svg` and its table: how flights end, with replans and without.

use std::fmt::Write;
use std::path::PathBuf;

use righting_flight::{Control, Distribution, Flight, Latency, Summary};
use righting_scenario::file::{ManeuverType, Scenario};

use crate::asked;
use crate::axis::Range;
use crate::chart::{Chart, Labels};
use crate::number::{drawn, short};
use crate::shares::{sorted, stairs};
use crate::style;
use crate::svg::Stroke;

/// Many flights of one maneuver.
#[derive(Clone, Copy, Debug)]
pub struct FlightsFigure<'a> {
    /// The maneuver.
    pub scenario: &'a Scenario,
    /// The flights.
    pub flights: &'a [Flight],
    /// What was done about their being off.
    pub control: Control,
}

/// What was done, as a reader calls it.
fn phrase(control: Control) -> &'static str {
    match control {
        Control::OpenLoop => "open loop",
        Control::Feedback => "with feedback",
        Control::Replan => "replanned",
        Control::Both => "replanned, with feedback",
    }
}

/// What stands along the figure.
#[derive(Clone, Copy)]
enum Axis {
    /// The value.
    Linear,
    /// Its decimal logarithm, from this one on.
    Decades(f64),
}

impl Axis {
    fn place(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Decades(least) => value.log10().max(least),
        }
    }
}

/// The figure of how flights end, as an SVG document: the share of them (percent) that end within an angle from
/// the target, or of a detumble with a rate, with what is done about it and open loop. None if none came to its end.
pub fn flights_svg(figure: FlightsFigure<'_>) -> Option<String> {
    let FlightsFigure { scenario, flights, control } = figure;
    let how = phrase(control);
    let is_slew = scenario.maneuver.kind == ManeuverType::Slew;
    let value = |end: &righting_flight::End| match is_slew {
        true => end.error_rad.to_degrees(),
        false => end.rate_rad_s.to_degrees(),
    };
    let flown = sorted(flights.iter().map(|flight| value(&flight.flown)));
    let open_loop =
        sorted(flights.iter().filter_map(|flight| flight.open_loop.as_ref().map(value)));
    let (x, unit) = match is_slew {
        true => ("Attitude error at the end [deg]", "\u{b0}"),
        false => ("Angular rate at the end [deg/s]", " \u{b0}/s"),
    };
    let of =
        |values: &[f64]| drawn(Distribution::of(values.iter().copied()).p95.unwrap_or(f64::NAN));
    let subtitle = format!(
        "{}: 95 % of {} flights within {}{unit} {how} (solid), {}{unit} open loop (dashed)",
        asked::phrase_drawn(scenario),
        flights.len(),
        of(&flown),
        of(&open_loop),
    );
    let labels = Labels { title: &scenario.name, subtitle: &subtitle, x, y: "Flights within [%]" };
    // Errors with and without what is done about them are decades apart; rates are not.
    let percent = Range { low: 0.0, high: 104.0 };
    let (axis, mut chart) = match is_slew {
        true => {
            let decades = flown.iter().chain(&open_loop).map(|error| error.log10());
            let range = Range::of(decades)?.padded(0.5);
            (Axis::Decades(range.low), Chart::over_decades(&labels, range, percent))
        }
        false => {
            let high = flown.last()?.max(*open_loop.last()?);
            let range = Range { low: 0.0, high }.padded(1e-9);
            (Axis::Linear, Chart::new(&labels, Range { low: 0.0, ..range }, percent))
        }
    };
    let placed = |values: &[f64]| -> Vec<[f64; 2]> {
        stairs(values).into_iter().map(|[value, share]| [axis.place(value), share]).collect()
    };
    let dash = style::LIMIT_DASH;
    let width = style::CURVE_WIDTH;
    chart.curve(&placed(&open_loop), Stroke { color: style::FAINT_INK, width, dash });
    chart.curve(&placed(&flown), Stroke { color: style::Z, width, dash: "" });
    Some(chart.svg.finish())
}

/// How flights end, as a table for people.
pub fn flights_table(
    scenario: &Scenario,
    control: Control,
    summary: &Summary,
    files: &[PathBuf],
) -> String {
    let how = phrase(control);
    let mut text = String::new();
    let mut line = |arguments: std::fmt::Arguments<'_>| {
        text.write_fmt(arguments).expect("a string takes all that is written to it");
        text.push('\n');
    };
    let Summary { flights, completed, missed_replans, lost_measurements, .. } = summary;
    line(format_args!("{}: {}", scenario.name, asked::phrase(scenario)));
    let mut events = String::new();
    if control.has_replans() {
        events += &format!(", {missed_replans} replans missed");
    }
    if *lost_measurements > 0 {
        events += &format!(", {lost_measurements} measurements lost");
    }
    line(format_args!("  {flights} flights, {completed} completed{events}"));
    line(format_args!("  {:<48}{:>12}{:>12}{:>12}", "", "median", "95 %", "most"));
    let number = |value: Option<f64>| value.map_or("-".to_owned(), short);
    let mut row = |name: &str, values: [Option<f64>; 3]| {
        if values[0].is_none() {
            return;
        }
        let [median, p95, most] = values.map(number);
        line(format_args!("  {name:<48}{median:>12}{p95:>12}{most:>12}"));
    };
    let values = |of: Distribution| [of.median, of.p95, of.max];
    if scenario.maneuver.kind == ManeuverType::Slew {
        row(&format!("attitude error, {how} [deg]"), values(summary.flown.final_error_deg));
        row("attitude error, open loop [deg]", values(summary.open_loop.final_error_deg));
    }
    row(&format!("angular rate, {how} [deg/s]"), values(summary.flown.final_rate_deg_s));
    row("angular rate, open loop [deg/s]", values(summary.open_loop.final_rate_deg_s));
    if let Latency { median: Some(median), p999: Some(p999), max: Some(max) } = summary.replan_ms {
        let [median, p999, max] = [median, p999, max].map(short);
        line(format_args!(
            "  a replan takes {median} ms (median), {p999} ms (99.9 %), {max} ms (most)"
        ));
    }
    line(format_args!(""));
    line(format_args!("Files"));
    for file in files {
        line(format_args!("  {}", file.display()));
    }
    text
}
