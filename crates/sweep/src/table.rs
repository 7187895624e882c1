//! All results of a sweep in the order of its plan.

use std::collections::HashMap;

use crate::case::CaseId;
use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::journal::JournalContents;
use crate::outcome::{CaseStatus, Outcome};
use crate::record::{Record, RunFacts};
use crate::sweep::Sweep;

/// Heads of the columns that are not a sweep's own: `case_id` before those, the others after. The
/// last two are another in every run.
pub(crate) const RESULT_COLUMNS: [&str; 11] = [
    "case_id",
    "status",
    "verified",
    "attitude_error",
    "final_rate_deg_s",
    "joint_rate_deg_s",
    "objective",
    "iterations",
    "reason",
    "solve_s",
    "attempts",
];

/// The results of a sweep, those that there are.
#[derive(Debug)]
pub struct Table {
    sweep: Sweep,
    /// One a case, in the order of the plan.
    rows: Vec<Option<Row>>,
    /// Reasons of failures, each once: a million failures have few.
    reasons: Vec<String>,
    /// What the files of records held.
    pub contents: JournalContents,
    /// Records of cases that the sweep does not have (any longer).
    pub strangers: usize,
}

/// What one case came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// How it ended.
    pub status: CaseStatus,
    /// Whether the independent check passed.
    pub verified: bool,
    /// Norm of the vector part of the attitude error quaternion.
    pub attitude_error: f64,
    /// Norm of the base's angular rate at the end, deg/s.
    pub final_rate_deg_s: f64,
    /// Norm of the joint rates at the end, deg/s.
    pub joint_rate_deg_s: f64,
    /// Value of the objective.
    pub objective: f64,
    /// Iterations of the last solve.
    pub iterations: u32,
    /// Time in the worker, s.
    pub solve_s: f64,
    /// How many workers took it on.
    pub attempts: u32,
    reason: Option<u32>,
    succeeded: bool,
}

impl Table {
    /// Joins all records of a folder. Of several records of a case the first that did not end in
    /// trouble stands.
    ///
    /// # Errors
    /// [`SweepError::Read`], and those of [`SweepFolder::sweep`].
    pub fn read(folder: &SweepFolder) -> Result<Self, SweepError> {
        let sweep = folder.sweep()?;
        let places: HashMap<CaseId, u32> =
            (0..sweep.len()).map(|index| (sweep.case(index).id, index as u32)).collect();
        let mut rows: Vec<Option<Row>> = vec![None; sweep.len()];
        let mut reasons = Reasons::default();
        let mut strangers = 0;
        let contents = folder.read_records(|record| match places.get(&record.case_id) {
            None => strangers += 1,
            Some(&index) => {
                let row = &mut rows[index as usize];
                let settled = row.is_some_and(|row| !is_trouble(row.status));
                if !settled && (row.is_none() || !is_trouble(record.outcome.status)) {
                    *row = Some(reasons.row(record));
                }
            }
        })?;
        Ok(Self { sweep, rows, reasons: reasons.list, contents, strangers })
    }

    /// The sweep.
    pub fn sweep(&self) -> &Sweep {
        &self.sweep
    }

    /// The results, one a case in the order of the plan; none where there is no record.
    pub fn rows(&self) -> &[Option<Row>] {
        &self.rows
    }

    /// Why a case failed, if it did.
    pub fn reason(&self, row: &Row) -> Option<&str> {
        row.reason.map(|index| self.reasons[index as usize].as_str())
    }
}

impl Row {
    /// Whether the case does what was asked.
    pub fn succeeded(&self) -> bool {
        self.succeeded
    }
}

fn is_trouble(status: CaseStatus) -> bool {
    matches!(status, CaseStatus::Trouble(_))
}

/// Reasons, each once.
#[derive(Default)]
struct Reasons {
    list: Vec<String>,
    known: HashMap<String, u32>,
}

impl Reasons {
    fn row(&mut self, record: Record) -> Row {
        let succeeded = record.outcome.succeeded();
        let Outcome {
            status,
            verified,
            attitude_error,
            final_rate_deg_s,
            joint_rate_deg_s,
            objective,
            iterations,
            reason,
        } = record.outcome;
        let RunFacts { solve_s, attempts } = record.run;
        Row {
            status,
            verified,
            attitude_error,
            final_rate_deg_s,
            joint_rate_deg_s,
            objective,
            iterations: u32::try_from(iterations).unwrap_or(u32::MAX),
            solve_s,
            attempts,
            reason: reason.map(|reason| self.number(reason)),
            succeeded,
        }
    }

    fn number(&mut self, reason: String) -> u32 {
        let next = self.list.len() as u32;
        *self.known.entry(reason).or_insert_with_key(|reason| {
            self.list.push(reason.clone());
            next
        })
    }
}
