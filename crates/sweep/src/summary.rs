//! What a sweep came to, in few numbers.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::case::CaseId;
use crate::outcome::{CaseStatus, Trouble};
use crate::slews::Slews;
use crate::table::{Row, Table};

/// How many cases of a cause are named.
const NAMED: usize = 5;

/// What a sweep came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Name of the sweep.
    pub sweep: String,
    /// Number of cases planned.
    pub cases: usize,
    /// Of those, with a record.
    pub recorded: usize,
    /// Of those, that do what was asked, verified.
    pub succeeded: usize,
    /// How many ended in which way.
    pub statuses: BTreeMap<String, usize>,
    /// Failures by cause, the most frequent first.
    pub failures: Vec<Failures>,
    /// Over the cases that succeeded; of those flown open loop, over all.
    pub attitude_error: Option<Spread>,
    /// Over the same, deg/s.
    pub final_rate_deg_s: Option<Spread>,
    /// Over the cases that succeeded.
    pub objective: Option<Spread>,
    /// Over the cases that succeeded.
    pub iterations: Option<Spread>,
    /// How far slews go: over the combinations of everything else, the largest angle up to which all
    /// succeed, deg.
    pub slew_limit_deg: Option<Spread>,
    /// Over all recorded cases, s.
    pub solve_s: Option<Spread>,
    /// Time in the workers, all cases together, s.
    pub total_solve_s: f64,
    /// Lines of the records that were damaged; their cases count as not recorded.
    pub damaged_lines: usize,
    /// Records of cases that the sweep does not have.
    pub strangers: usize,
}

/// Failures of one cause.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Failures {
    /// What they have in common.
    pub cause: String,
    /// How many.
    pub count: usize,
    /// The first of them.
    pub case_ids: Vec<CaseId>,
    /// The first one's reason in full.
    pub example: String,
}

/// How a number is spread.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Smallest.
    pub min: f64,
    /// Middle one.
    pub median: f64,
    /// Mean.
    pub mean: f64,
    /// 95 of 100 are no larger.
    pub percentile_95: f64,
    /// Largest.
    pub max: f64,
}

impl Spread {
    /// Of all finite values; none if there are none.
    pub fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        values.sort_unstable_by(f64::total_cmp);
        let last = values.len().checked_sub(1)?;
        // The nearest rank, so that what is printed did occur.
        let rank = |share: f64| {
            values[((share * (last + 1) as f64).ceil() as usize).clamp(1, last + 1) - 1]
        };
        Some(Self {
            min: values[0],
            median: rank(0.5),
            mean: values.iter().sum::<f64>() / (last + 1) as f64,
            percentile_95: rank(0.95),
            max: values[last],
        })
    }
}

impl Summary {
    /// Sums up a table, and how far its slews go.
    pub fn of(table: &Table, slews: Option<&Slews>) -> Self {
        let rows = || table.rows().iter().flatten();
        let won = || rows().filter(|row| row.succeeded());
        let flown = |row: &Row| matches!(row.status, CaseStatus::Flown(_));
        let ended = || rows().filter(|row| row.succeeded() || flown(row));
        let planned = || won().filter(|row| !flown(row));
        let mut statuses = BTreeMap::new();
        for row in rows() {
            *statuses.entry(row.status.to_string()).or_default() += 1;
        }
        Self {
            sweep: table.sweep().name().to_owned(),
            cases: table.rows().len(),
            recorded: rows().count(),
            succeeded: won().count(),
            statuses,
            failures: failures(table),
            attitude_error: Spread::of(ended().map(|row| row.attitude_error)),
            final_rate_deg_s: Spread::of(ended().map(|row| row.final_rate_deg_s)),
            objective: Spread::of(won().map(|row| row.objective)),
            iterations: Spread::of(planned().map(|row| f64::from(row.iterations))),
            slew_limit_deg: slews
                .and_then(|slews| Spread::of(slews.limits.iter().map(|limit| limit.all_up_to_deg))),
            solve_s: Spread::of(rows().map(|row| row.solve_s)),
            total_solve_s: rows().map(|row| row.solve_s).sum(),
            damaged_lines: table.contents.damaged,
            strangers: table.strangers,
        }
    }
}

fn failures(table: &Table) -> Vec<Failures> {
    let mut groups: BTreeMap<String, Failures> = BTreeMap::new();
    for (index, row) in table.rows().iter().enumerate() {
        let Some(row) = row.filter(|row| !row.succeeded()) else { continue };
        let reason = table.reason(&row).unwrap_or_default();
        let cause = cause(&row, reason);
        let group = groups.entry(cause.clone()).or_insert_with(|| Failures {
            cause,
            count: 0,
            case_ids: Vec::new(),
            example: reason.to_owned(),
        });
        group.count += 1;
        if group.case_ids.len() < NAMED {
            group.case_ids.push(table.sweep().case(index).id);
        }
    }
    let mut groups: Vec<Failures> = groups.into_values().collect();
    groups.sort_by_key(|group| std::cmp::Reverse(group.count));
    groups
}

/// What failures of a kind have in common: their reasons without the numbers.
fn cause(row: &Row, reason: &str) -> String {
    let first = reason.split(": ").next().unwrap_or_default();
    match row.status {
        CaseStatus::Optimizer(status) if !status.is_acceptable() => row.status.to_string(),
        CaseStatus::Optimizer(_) | CaseStatus::Flown(_) => format!("not verified: {first}"),
        CaseStatus::Trouble(Trouble::Refused) => format!("refused: {first}"),
        CaseStatus::Trouble(Trouble::Impossible) => {
            let first = reason.split("; ").next().unwrap_or_default();
            format!("{}: {first}", row.status)
        }
        CaseStatus::Trouble(_) => format!("{}: {reason}", row.status),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_is_made_of_values_that_occur() {
        let spread = Spread::of((1..=100).rev().map(f64::from)).unwrap();
        assert_eq!(
            spread,
            Spread { min: 1.0, median: 50.0, mean: 50.5, percentile_95: 95.0, max: 100.0 }
        );
        assert_eq!(Spread::of([f64::NAN].into_iter()), None);
        assert_eq!(Spread::of([3.0].into_iter()).unwrap().percentile_95, 3.0);
    }
}
