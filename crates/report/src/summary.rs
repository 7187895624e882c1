//! What a person reads after a solve: asked, reached, proven, where.

use std::fmt::Write;
use std::path::PathBuf;

use righting_results::{Check, RobustnessRecord, Sense, Solution, Status};
use righting_scenario::file::{Formulation, ManeuverType, SystemReference};

use crate::asked;
use crate::facts::joints_at_end;
use crate::number::short;
use crate::table::aligned;

/// The text summary of a solve, ready to print.
///
/// `files` are the files written, listed at the end as given.
pub fn summary(solution: &Solution, files: &[PathBuf]) -> String {
    let mut text = String::new();
    let mut line = |arguments: std::fmt::Arguments<'_>| {
        text.write_fmt(arguments).expect("a string takes all that is written to it");
        text.push('\n');
    };
    let scenario = &solution.scenario;
    let steps = scenario.horizon.steps;
    line(format_args!("{}: {}, {steps} steps", scenario.name, asked::phrase(scenario)));
    if let SystemReference::Inline(system) = &scenario.system {
        let form = match scenario.solver.formulation.unwrap_or_default() {
            Formulation::Full => "full",
            Formulation::Reduced => "reduced",
        };
        line(format_args!(
            "  system   {}, {} joints, {form} form",
            system.name,
            system.joints().len()
        ));
    }
    line(format_args!(
        "  solver   {} after {} iterations and {} s in all: objective {:.6e}",
        status_phrase(solution.status),
        solution.iterations,
        short(solution.timing_s.total),
        solution.objective,
    ));
    if let Some(duration_s) = solution.duration_s {
        line(format_args!("  chose    a duration of {duration_s:.4} s"));
    }
    line(format_args!("  reached  {}", reached(solution)));
    for note in &solution.notes {
        line(format_args!("  note     {note}"));
    }
    line(format_args!(""));
    line(format_args!("{}", verdict(solution)));
    for row in table(&solution.verification.checks) {
        line(format_args!("  {row}"));
    }
    if !files.is_empty() {
        line(format_args!(""));
        line(format_args!("Files"));
        for file in files {
            line(format_args!("  {}", file.display()));
        }
    }
    text
}

/// What the result of a check says, with the checks it rests on: the summary of `verify`.
pub fn verification_summary(solution: &Solution) -> String {
    let mut text = format!(
        "{}: {}\n{}\n",
        solution.scenario.name,
        asked::planned_phrase(solution),
        verdict(solution)
    );
    for row in table(&solution.verification.checks) {
        text.push_str("  ");
        text.push_str(&row);
        text.push('\n');
    }
    text
}

/// How the optimizer ended, in words.
pub fn status_phrase(status: Status) -> &'static str {
    match status {
        Status::Solved => "solved",
        Status::Acceptable => "solved to the acceptable tolerance",
        Status::Unconfirmed => "stopped at a point that is no optimum by its own residuals",
        Status::Infeasible => "stopped at a point of least infeasibility",
        Status::IterationLimit => "stopped at the iteration limit",
        Status::TimeLimit => "stopped at the time limit",
        Status::Stalled => "given up: it made no progress any more",
        Status::Interrupted => "interrupted",
        Status::SearchDirectionTooSmall => "stopped, the search direction became too small",
        Status::Diverging => "stopped, the iterates diverge",
        Status::RestorationFailed => "stopped, the restoration phase failed",
        Status::EvaluationError => "stopped, a function could not be evaluated",
        Status::InternalError => "stopped by an internal error of the optimizer",
        _ => "stopped",
    }
}

/// What masses do to the end.
fn spread(robustness: &RobustnessRecord) -> String {
    let RobustnessRecord { deviation_deg, without_deg, cost_ratio } = robustness;
    format!(
        "\n  masses   turn the end by {}° (standard deviation) instead of {}°, at {} times the cost",
        short(*deviation_deg),
        short(*without_deg),
        short(*cost_ratio),
    )
}

fn reached(solution: &Solution) -> String {
    let terminal = &solution.terminal;
    let rate = short(terminal.angular_rate_deg_s);
    let joints = joints_at_end(terminal);
    match solution.scenario.maneuver.kind {
        ManeuverType::Slew => format!(
            "attitude error {} ({}°), base {rate} °/s, joints {joints}{}",
            short(terminal.attitude_error),
            short(terminal.attitude_error_deg),
            solution.robustness.as_ref().map(spread).unwrap_or_default(),
        ),
        ManeuverType::Detumble => {
            let joint_rates = solution.scenario.initial.joint_rates_deg_s.iter().flatten();
            let than = match solution.stopped_deg_s {
                Some(stopped) if joint_rates.clone().any(|rate| *rate != 0.0) => {
                    format!(" than the {} °/s that stopping the arm leaves", short(stopped))
                }
                _ => String::new(),
            };
            let reduction = solution
                .reduction_percent
                .map(|percent| format!(", {} % less{than}", short(percent)))
                .unwrap_or_default();
            let bound = solution
                .bound_deg_s
                .map(|bound| format!(" (at least {} °/s with the arm at rest)", short(bound)))
                .unwrap_or_default();
            format!("base {rate} °/s{reduction}{bound}, joints {joints}")
        }
    }
}

/// Whether the plan is proven, in one line.
pub(crate) fn verdict(solution: &Solution) -> String {
    let verification = &solution.verification;
    let failed = verification.failures().count();
    match (verification.passed, verification.checks.len()) {
        (true, 1..) if !solution.status.is_acceptable() => {
            "Verified, but not optimal: an independent integration agrees and every limit holds"
                .to_owned()
        }
        (_, 0) => "Not verified: there was no plan to check".to_owned(),
        (true, _) => "Verified: an independent integration agrees and every limit holds".to_owned(),
        (false, all) => format!("NOT VERIFIED: {failed} of {all} checks failed"),
    }
}

/// The cells of a table of checks, its head first; none without checks.
pub(crate) fn check_rows(checks: &[Check]) -> Vec<[String; 6]> {
    if checks.is_empty() {
        return Vec::new();
    }
    let head = ["", "check", "worst", "allowed", "margin", "where"].map(str::to_owned);
    std::iter::once(head).chain(checks.iter().map(check_cells)).collect()
}

/// One aligned row a check, headed.
fn table(checks: &[Check]) -> Vec<String> {
    aligned(&check_rows(checks), &[false, false, true, true, true, false])
}

fn check_cells(check: &Check) -> [String; 6] {
    let (unit, scale) = in_degrees(&check.unit);
    let [value, limit] = [check.value, check.limit].map(|number| scale * number);
    let (sign, margin) = match check.sense {
        Sense::AtMost => ("\u{2264}", limit - value),
        Sense::AtLeast => ("\u{2265}", value - limit),
    };
    let gap = if unit.is_empty() { "" } else { " " };
    let tolerated = match check.passed && margin < 0.0 {
        true => format!(" (\u{b1} {} is tolerated)", short(scale * check.tolerance)),
        false => String::new(),
    };
    [
        match (check.passed, margin < 0.0) {
            (true, false) => "ok",
            (true, true) => "in tolerance",
            (false, _) => "FAILED",
        }
        .to_owned(),
        check.name.clone(),
        short(value),
        format!("{sign} {}{gap}{unit}", short(limit)),
        short(margin),
        place(check) + &tolerated,
    ]
}

/// Where a check is closest to failing: "joint 2 at 12.3 s".
pub(crate) fn place(check: &Check) -> String {
    let time = check.time_s.map(|time_s| format!("{} s", short(time_s)));
    let place: Vec<String> = check.subject.iter().cloned().chain(time).collect();
    place.join(" at ")
}

/// The unit that people think in, and how many of it make one of `unit`.
pub(crate) fn in_degrees(unit: &str) -> (String, f64) {
    match unit.strip_prefix("rad") {
        Some(rest) => (format!("deg{rest}"), 1f64.to_degrees()),
        None => (unit.to_owned(), 1.0),
    }
}
