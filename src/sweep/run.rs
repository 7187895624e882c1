//! `righting sweep run`: a shard of a planned sweep.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::Command;
use std::thread;
use std::time::Duration;

use clap::Args;
use righting_sweep::worker::{Setup, Task};
use righting_sweep::{Pool, Shard, Sweep, SweepError, SweepFolder};

use super::progress::Progress;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output;

/// How much longer than a case's time limit a worker may be silent: it looks at the clock between
/// two iterations of the optimizer, and verifies after the last one.
const GRACE: Duration = Duration::from_secs(30);

/// Run a shard of a planned sweep; what it has recorded before is not done again.
#[derive(Args)]
pub struct Arguments {
    /// The folder of the plan.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Shard i of n.
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE)]
    shard: Shard,
    /// Number of worker processes; one a core by default.
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
}

/// Runs the shard.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = super::planned(&arguments.folder)?;
    let sweep = folder.sweep()?;
    run_shard(&folder, &sweep, arguments.shard, arguments.jobs)
}

/// Does what is missing of a shard.
pub fn run_shard(
    folder: &SweepFolder,
    sweep: &Sweep,
    shard: Shard,
    jobs: Option<NonZeroUsize>,
) -> Result<(), Failure> {
    let interrupt = Interrupt::watch();
    let program = std::env::current_exe()
        .map_err(|error| SweepError::Worker { reason: error.to_string() })?;
    let mut journal = folder.journal(shard)?;
    let done = folder.done(shard)?;
    let missing = || {
        let cases = shard.indices(sweep.len()).map(|index| sweep.case(index));
        cases.filter(|case| !done.contains(&case.id))
    };
    let left = if done.is_empty() { shard.indices(sweep.len()).count() } else { missing().count() };
    if left == 0 {
        return Ok(());
    }
    let cores = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let tasks = missing().map(|case| Task { case_id: case.id, scenario: sweep.scenario(&case) });
    let setup = Setup::of(sweep);
    let pool = Pool {
        command: &|| {
            let mut command = Command::new(&program);
            command.arg("sweep-worker");
            command
        },
        jobs: jobs.unwrap_or(cores).get().min(left),
        setup: &setup,
        patience: Duration::from_secs_f64(sweep.case_time_limit_s()) + GRACE,
        halted: &|| interrupt.is_asked(),
    };
    let mut progress = Progress::start(left, done.len());
    let ran = pool.run(tasks, |record| {
        journal.append(&record)?;
        progress.count(&record);
        Ok(())
    });
    let recorded = progress.finish();
    let synced = journal.sync();
    ran?;
    synced?;
    if recorded < left {
        output::complain(&format!(
            "{} of {left} cases are left: --resume goes on",
            left - recorded
        ));
        return Err(Failure::Interrupted);
    }
    Ok(())
}
