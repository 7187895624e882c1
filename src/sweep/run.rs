//! `righting sweep run`: a shard of a planned sweep.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::Command;

use clap::Args;
use righting_sweep::{Shard, ShardRun, Sweep, SweepError, SweepFolder, Workers};

use super::progress::Progress;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output;

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
    /// Keep the plan of every case that is done now, in DIR/plans.
    #[arg(long)]
    keep_plans: bool,
}

/// Runs the shard.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = super::planned(&arguments.folder)?;
    let sweep = folder.sweep()?;
    run_shard(&folder, &sweep, arguments.shard, arguments.jobs, arguments.keep_plans)
}

/// Does what is missing of a shard.
pub fn run_shard(
    folder: &SweepFolder,
    sweep: &Sweep,
    shard: Shard,
    jobs: Option<NonZeroUsize>,
    keep_plans: bool,
) -> Result<(), Failure> {
    let interrupt = Interrupt::watch();
    let program = std::env::current_exe()
        .map_err(|error| SweepError::Worker { reason: error.to_string() })?;
    let run = ShardRun::open(folder, sweep, shard)?;
    let run = if keep_plans { run.keeping_plans(folder.plans()) } else { run };
    let left = run.left();
    if left == 0 {
        return Ok(());
    }
    let workers = Workers {
        command: &|| {
            let mut command = Command::new(&program);
            command.arg("sweep-worker");
            command
        },
        jobs,
        halted: &|| interrupt.is_asked(),
    };
    let mut progress = Progress::start(left, run.recorded());
    let ran = run.run(&workers, |record| progress.count(record));
    progress.finish();
    let recorded = ran?;
    if recorded < left {
        output::complain(&format!(
            "{} of {left} cases are left: --resume goes on",
            left - recorded
        ));
        return Err(Failure::Interrupted { has_plan: false });
    }
    Ok(())
}
