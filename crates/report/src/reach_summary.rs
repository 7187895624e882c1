//! What a person reads after a search for what is possible.

use std::fmt::Write;
use std::path::PathBuf;

use righting_planner::reach::{Quantity, Reach, StartedFrom, Try};
use righting_scenario::file::Scenario;

use crate::asked;
use crate::number::short;
use crate::table::aligned;

/// The text summary of a search, ready to print: the answer, how sure it is, and everything tried
/// by size. `files` are listed at the end as given.
pub fn reach_summary(scenario: &Scenario, reach: &Reach, files: &[PathBuf]) -> String {
    let mut text = String::new();
    let mut line = |line: String| {
        text.push_str(&line);
        text.push('\n');
    };
    let steps = scenario.horizon.steps;
    line(format!("{}: {}, {steps} steps", scenario.name, asked::phrase(scenario)));
    line(format!("  reach    {}", answer(reach)));
    if let Some(bound) = reach.bound_deg_s {
        let closest = match reach.closest_to_bound_percent() {
            None => String::new(),
            Some(percent) if percent >= 0.0 => format!(", closest plan {} % above", short(percent)),
            Some(percent) => {
                format!(", a plan {} % below it: its joints still creep", short(-percent))
            }
        };
        line(format!("  bound    {} °/s with the arm at rest{closest}", short(bound)));
    }
    for note in &reach.notes {
        line(format!("  note     {note}"));
    }
    line(String::new());
    for row in table(reach) {
        line(format!("  {row}"));
    }
    if !files.is_empty() {
        text.push_str("\nFiles\n");
        for file in files {
            writeln!(text, "  {}", file.display()).expect("a string takes all that is written");
        }
    }
    text
}

fn answer(reach: &Reach) -> String {
    let (name, unit, further) = match reach.quantity {
        Quantity::Duration => ("shortest duration", " s", "shorter"),
        Quantity::Angle => ("largest angle", "\u{b0}", "larger"),
    };
    let so_far = if reach.is_interrupted { " so far, interrupted" } else { "" };
    match (reach.first_succeeding, reach.last_failing) {
        (Some(pass), Some(fail)) => format!("{name} {pass}{unit}{so_far}; {fail}{unit} fails"),
        (Some(pass), None) => format!("{name} {pass}{unit}{so_far}; nothing {further} was tried"),
        (None, Some(fail)) => format!("no {name}{so_far}; {fail}{unit} fails"),
        (None, None) => format!("nothing tried{so_far}"),
    }
}

fn table(reach: &Reach) -> Vec<String> {
    let (value, missed) = match (reach.quantity, reach.bound_deg_s) {
        (Quantity::Angle, _) => ("angle [°]", "error"),
        (Quantity::Duration, None) => ("duration [s]", "error"),
        (Quantity::Duration, Some(_)) => ("duration [s]", "above bound"),
    };
    let (base, joints) = ("base [°/s]", "joints [°/s]");
    let heads = [value, "", missed, base, joints, "objective", "iterations", "start", "shortfall"];
    let mut tries: Vec<&Try> = reach.tries.iter().collect();
    tries.sort_by(|a, b| a.value(reach.quantity).total_cmp(&b.value(reach.quantity)));
    let rows = tries.into_iter().map(|tried| {
        let missed = match reach.bound_deg_s {
            None => short(tried.terminal.attitude_error),
            Some(bound) => {
                let excess = 100.0 * (tried.terminal.angular_rate_deg_s / bound - 1.0);
                format!("{} %", short(excess))
            }
        };
        [
            tried.value(reach.quantity).to_string(),
            if tried.succeeded { "succeeds" } else { "fails" }.to_owned(),
            missed,
            short(tried.terminal.angular_rate_deg_s),
            short(tried.terminal.joint_rate_deg_s),
            format!("{:.4e}", tried.objective),
            tried.iterations.to_string(),
            start(tried),
            tried.shortfall.clone().unwrap_or_default(),
        ]
    });
    let rows: Vec<[String; 9]> = std::iter::once(heads.map(str::to_owned)).chain(rows).collect();
    aligned(&rows, &[true, false, true, true, true, true, true, false, false])
}

fn start(tried: &Try) -> String {
    match (tried.start, tried.neighbor) {
        (StartedFrom::Neighbor, Some(neighbor)) => format!("plan of {neighbor}"),
        (StartedFrom::Fastest, _) => "fastest plan".to_owned(),
        (StartedFrom::LowDiscrepancy, _) => "random".to_owned(),
        _ => "cold".to_owned(),
    }
}
