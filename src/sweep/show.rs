//! `righting sweep show`: what a sweep came to, from its records.

use std::path::PathBuf;

use clap::Args;
use righting_report::short;
use righting_sweep::{Slews, Spread, Summary, Table};

use crate::failure::Failure;
use crate::output;

/// Print what a sweep has come to so far, from its records.
#[derive(Args)]
pub struct Arguments {
    /// The folder of the sweep.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    pub json: bool,
}

/// Reads and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let table = Table::read(&super::planned(&arguments.folder)?)?;
    let slews = Slews::of(&table, 0);
    print(&Summary::of(&table, slews.as_ref()), &[], arguments.json)
}

/// Prints a summary and which files hold the rest.
pub fn print(summary: &Summary, files: &[PathBuf], json: bool) -> Result<(), Failure> {
    if json { output::print_json(summary) } else { output::print(&text(summary, files)) }
}

fn text(summary: &Summary, files: &[PathBuf]) -> String {
    let mut text = String::new();
    let mut line = |line: String| {
        text.push_str(&line);
        text.push('\n');
    };
    let Summary { cases, recorded, succeeded, .. } = *summary;
    let share = 100.0 * succeeded as f64 / recorded.max(1) as f64;
    line(format!("{}: {recorded} of {cases} cases recorded", summary.sweep));
    line(format!("  succeeded, verified  {succeeded} ({share:.1} %)"));
    let statuses: Vec<String> =
        summary.statuses.iter().map(|(status, count)| format!("{count} {status}")).collect();
    if !statuses.is_empty() {
        line(format!("  ended as             {}", statuses.join(", ")));
    }
    let spreads = [
        ("attitude error", summary.attitude_error),
        ("final rate, deg/s", summary.final_rate_deg_s),
        ("objective", summary.objective),
        ("iterations", summary.iterations),
        ("time a case, s", summary.solve_s),
    ];
    for (name, spread) in spreads {
        if let Some(Spread { median, percentile_95, max, .. }) = spread {
            let [median, percentile_95, max] = [median, percentile_95, max].map(short);
            line(format!("  {name:<19}  median {median:<9}  95 % {percentile_95:<9}  max {max}"));
        }
    }
    if let Some(Spread { min, median, max, .. }) = summary.slew_limit_deg {
        line(format!("  reach, deg           least {min}  median {median}  most {max}"));
    }
    line(format!("  time in workers      {:.1} s", summary.total_solve_s));
    if summary.damaged_lines > 0 {
        line(format!(
            "  damaged lines        {}: their cases are to be done again",
            summary.damaged_lines
        ));
    }
    if summary.strangers > 0 {
        line(format!("  not of this sweep    {} records", summary.strangers));
    }
    if !summary.failures.is_empty() {
        line("\nFailures".to_owned());
    }
    for group in &summary.failures {
        let ids: Vec<String> = group.case_ids.iter().map(ToString::to_string).collect();
        let more = if group.count > ids.len() { ", …" } else { "" };
        line(format!("  {:>6}  {}\n          {}{more}", group.count, group.cause, ids.join(", ")));
        if !group.example.is_empty() {
            line(format!("          such as {}", group.example));
        }
    }
    if !files.is_empty() {
        line("\nFiles".to_owned());
    }
    for file in files {
        line(format!("  {}", file.display()));
    }
    text
}
