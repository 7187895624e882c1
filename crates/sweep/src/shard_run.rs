//! What is missing of a shard, done by worker processes and recorded as it comes.

use std::collections::HashSet;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::Command;
use std::thread;
use std::time::Duration;

use crate::case::{Case, CaseId};
use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::journal::Journal;
use crate::pool::Pool;
use crate::record::Record;
use crate::shard::Shard;
use crate::sweep::Sweep;
use crate::worker::{Setup, Task};

/// How much longer than a case's time limit a worker may be silent: it looks at the clock between
/// two iterations of the optimizer, and verifies after the last one.
const GRACE: Duration = Duration::from_secs(30);

/// A shard of a planned sweep, its records open to take more.
#[derive(Debug)]
pub struct ShardRun<'a> {
    sweep: &'a Sweep,
    shard: Shard,
    journal: Journal,
    done: HashSet<CaseId>,
    left: usize,
    plans: Option<PathBuf>,
}

/// Who works.
pub struct Workers<'a> {
    /// Makes the command of a worker: a program that does as [`worker`](crate::worker) says.
    pub command: &'a (dyn Fn() -> Command + Sync),
    /// How many; one a core if it is not said.
    pub jobs: Option<NonZeroUsize>,
    /// Whether to stop now, asked many times a second.
    pub halted: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> ShardRun<'a> {
    /// Opens the records of a shard.
    ///
    /// # Errors
    /// Those of [`SweepFolder::journal`] and [`SweepFolder::done`].
    pub fn open(folder: &SweepFolder, sweep: &'a Sweep, shard: Shard) -> Result<Self, SweepError> {
        let (journal, done) = (folder.journal(shard)?, folder.done(shard)?);
        let mut run = Self { sweep, shard, journal, done, left: 0, plans: None };
        run.left = match run.done.is_empty() {
            true => shard.indices(sweep.len()).count(),
            false => run.missing().count(),
        };
        Ok(run)
    }

    /// Keeps the plans of the cases that are left in a folder, such as [`SweepFolder::plans`].
    pub fn keeping_plans(self, plans: PathBuf) -> Self {
        Self { plans: Some(plans), ..self }
    }

    /// How many cases were recorded before.
    pub fn recorded(&self) -> usize {
        self.done.len()
    }

    /// How many are left to do.
    pub fn left(&self) -> usize {
        self.left
    }

    /// Has the rest done; `on_record` sees every record once it is written. Returns how many were recorded:
    /// fewer than were [left](Self::left) when the workers were halted.
    ///
    /// # Errors
    /// Those of [`Pool::run`] and of writing records.
    pub fn run(
        mut self,
        workers: &Workers<'_>,
        mut on_record: impl FnMut(&Record),
    ) -> Result<usize, SweepError> {
        if self.left == 0 {
            return Ok(0);
        }
        let cores = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        let setup = Setup { plans: self.plans.clone(), ..Setup::of(self.sweep) };
        let pool = Pool {
            command: workers.command,
            jobs: workers.jobs.unwrap_or(cores).get().min(self.left),
            setup: &setup,
            patience: Duration::from_secs_f64(self.sweep.case_time_limit_s()) + GRACE,
            halted: workers.halted,
        };
        let Self { sweep, shard, journal, done, .. } = &mut self;
        let tasks = missing(sweep, *shard, done)
            .map(|case| Task { case_id: case.id, scenario: sweep.scenario(&case) });
        let mut recorded = 0;
        let ran = pool.run(tasks, |record| {
            journal.append(&record)?;
            recorded += 1;
            on_record(&record);
            Ok(())
        });
        let synced = journal.sync();
        ran?;
        synced?;
        Ok(recorded)
    }

    fn missing(&self) -> impl Iterator<Item = Case> {
        missing(self.sweep, self.shard, &self.done)
    }
}

/// The cases of a shard that have no record.
fn missing(sweep: &Sweep, shard: Shard, done: &HashSet<CaseId>) -> impl Iterator<Item = Case> {
    let cases = shard.indices(sweep.len()).map(|index| sweep.case(index));
    cases.filter(|case| !done.contains(&case.id))
}
