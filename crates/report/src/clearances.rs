//! `clearances.svg`: how near links come to the base and to each other.

use righting_analysis::Histories;
use righting_analysis::histories::ClearanceHistory;
use righting_results::{Solution, Trajectory};
use righting_scenario::bodies::{ArmPart, Piece};
use righting_scenario::collision::Between;

use crate::figure::{Figure, heading};
use crate::number::drawn;
use crate::panel::{Curve, Panel, Rule, RuleKind};
use crate::style;

const PANEL_SIZE: [f64; 2] = [620.0, 170.0];
/// Below this height a curve counts as constant.
const LEAST_SPAN_M: f64 = 1e-6;
/// Curves of one panel; the nearest ones, where there are more.
const MOST_CURVES: usize = 7;

/// The figure of all distances that are kept, as an SVG document: links from the base's center with
/// the keep-out radius, from the shapes of the base and from each other with the clearance; none where none
/// is kept.
pub fn clearances_svg(
    solution: &Solution,
    trajectory: &Trajectory,
    histories: &Histories,
) -> Option<String> {
    if histories.clearances.is_empty() {
        return None;
    }
    let of = |is_one: fn(&Between) -> bool| -> Vec<&ClearanceHistory> {
        histories.clearances.iter().filter(|history| is_one(&history.between)).collect()
    };
    let panels = [
        ("Links from the base's center", of(|between| matches!(between, Between::Body(_)))),
        ("Links from base shapes", of(|between| matches!(between, Between::KeepOut(..)))),
        ("Links from each other", of(|between| matches!(between, Between::Pieces(..)))),
    ];
    let panels = panels
        .into_iter()
        .filter(|(_, histories)| !histories.is_empty())
        .map(|(heading, histories)| panel(heading, histories))
        .collect();
    let (title, subtitle) = heading(solution);
    let times = trajectory.nodes().iter().map(|node| node.time_s).collect();
    let figure = Figure {
        title,
        subtitle,
        places: times,
        panel_size: PANEL_SIZE,
        panels,
        ..Figure::default()
    };
    Some(figure.render())
}

fn panel(heading: &str, mut histories: Vec<&ClearanceHistory>) -> Panel {
    let margin = |history: &ClearanceHistory| {
        history.distances_m.iter().copied().fold(f64::INFINITY, f64::min) - history.least_m
    };
    histories.sort_by(|a, b| margin(a).total_cmp(&margin(b)));
    let left_out = histories.len().saturating_sub(MOST_CURVES);
    histories.truncate(MOST_CURVES);
    let curve = |(i, history): (usize, &&ClearanceHistory)| Curve {
        name: short_name(history.between),
        ..Curve::plain(style::SERIES[i], history.distances_m.clone())
    };
    let more = if left_out > 0 { format!(" ({left_out} farther)") } else { String::new() };
    Panel {
        heading: format!("{heading}{more}"),
        axis_label: "Distance [m]",
        note: format!(
            "least margin {} m",
            drawn(histories.first().map_or(f64::NAN, |h| margin(h)))
        ),
        curves: histories.iter().enumerate().map(curve).collect(),
        rules: histories
            .first()
            .map(|history| Rule { kind: RuleKind::Limit, value: history.least_m })
            .into_iter()
            .collect(),
        least_span: LEAST_SPAN_M,
        ..Panel::default()
    }
}

/// Such as "2", "2–4" for links, "2–1" for link 2 and shape 1 of the base; "2.1" is a shape of link 2, "P" the
/// payload.
fn short_name(between: Between) -> String {
    let short = |piece: Piece| {
        let part = match piece.part {
            ArmPart::Link(place) | ArmPart::Body(place) => (place + 1).to_string(),
            ArmPart::Payload => "P".to_owned(),
        };
        piece.shape.map_or(part.clone(), |shape| format!("{part}.{}", shape + 1))
    };
    match between {
        Between::Body(piece) => piece.to_string(),
        Between::KeepOut(piece, k) => format!("{}\u{2013}{}", short(piece), k + 1),
        Between::Pieces(a, b) => format!("{}\u{2013}{}", short(a), short(b)),
    }
}
