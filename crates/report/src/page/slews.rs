//! `slews.html`: the slews of a sweep to turn and to ask, in the shape that `page/src/slew-data.ts`
//! mirrors.

use righting_sweep::{Column, SlewPoint, Slews};
use serde::Serialize;

use super::{escaped, fill, in_script};
use crate::number::drawn;
use crate::slews::{costs, sample, subtitle};
use crate::style;

pub(super) const SCRIPT: &str = include_str!("../../page/dist/slews.js");
pub(super) const STYLE: &str = include_str!("../../page/dist/slews.css");
const TEMPLATE: &str = include_str!("../../page/slews.html");
/// Colours of the ramp, ends included.
const COLORS: usize = 65;

/// The reachability page of a sweep over slew axes and angles, as an HTML document that opens from
/// disk and loads nothing: the points of [`slews_svg`](crate::slews_svg) in three dimensions, each
/// of which says on a touch which case it is and what came of it.
pub fn slews_html(name: &str, slews: &Slews) -> String {
    let data = in_script(&Data::new(name, slews));
    let title = escaped(name);
    fill(TEMPLATE, &[("title", &title), ("style", STYLE), ("data", &data), ("script", SCRIPT)])
}

#[derive(Debug, Serialize)]
struct Data<'a> {
    name: &'a str,
    subtitle: String,
    /// Names of what varies beside axis and angle.
    columns: Vec<&'a str>,
    points: Vec<Point<'a>>,
    ramp: Vec<String>,
    objective: Scale,
}

/// Decimal logarithms.
#[derive(Debug, Serialize)]
struct Scale {
    low: f64,
    high: f64,
    ticks: Vec<Tick>,
}

#[derive(Debug, Serialize)]
struct Tick {
    share: f64,
    label: String,
}

/// Numbers that are not finite become null.
#[derive(Debug, Serialize)]
struct Point<'a> {
    case_id: String,
    /// One a column, as tables show them.
    settings: Vec<String>,
    axis: [f64; 3],
    angle_deg: f64,
    status: String,
    succeeded: bool,
    attitude_error_deg: f64,
    objective: f64,
    plan_page: Option<&'a str>,
}

impl<'a> Data<'a> {
    fn new(name: &'a str, slews: &'a Slews) -> Self {
        let columns: Vec<(usize, &Column)> = slews
            .columns
            .iter()
            .enumerate()
            .filter(|(_, column)| !Slews::is_axis(column))
            .collect();
        let costs = costs(slews);
        let ticks = costs.ticks(5.0).into_iter().map(|(value, _)| Tick {
            share: (value - costs.low) / costs.span(),
            label: drawn(10f64.powf(value)),
        });
        Self {
            name,
            subtitle: match sample(slews) {
                Some(sample) => format!("{}; {sample}", subtitle(slews)),
                None => subtitle(slews),
            },
            columns: columns.iter().map(|(_, column)| column.name.as_str()).collect(),
            points: slews.points.iter().map(|slew| Point::of(slew, &columns)).collect(),
            ramp: (0..COLORS).map(|i| style::ramp(i as f64 / (COLORS - 1) as f64)).collect(),
            objective: Scale { low: costs.low, high: costs.high, ticks: ticks.collect() },
        }
    }
}

impl<'a> Point<'a> {
    fn of(slew: &'a SlewPoint, columns: &[(usize, &Column)]) -> Self {
        let settings = columns.iter().map(|&(at, column)| column.shown(&slew.settings[at]));
        Self {
            case_id: slew.case_id.to_string(),
            settings: settings.collect(),
            axis: slew.axis,
            angle_deg: slew.angle_deg,
            status: slew.status.to_string(),
            succeeded: slew.succeeded,
            // The error is the sine of half the angle.
            attitude_error_deg: 2.0 * slew.attitude_error.asin().to_degrees(),
            objective: slew.objective,
            plan_page: slew.plan_page.as_deref(),
        }
    }
}
