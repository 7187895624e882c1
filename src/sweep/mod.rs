//! `righting sweep`: many maneuvers, on one machine or on many.

mod kept_plans;
mod merge;
mod plan;
mod progress;
mod run;
mod show;
mod slurm;

use std::io;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use righting_sweep::{Shard, SweepFolder, worker};

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::optimizer;
use crate::output_folder::OutputFolder;
use crate::plan_folder;

/// Plan and verify every case of a sweep file.
///
/// Cases run in worker processes; each finished one is recorded at once, so that nothing but the
/// cases in flight is ever lost. A case that fails is a result like any other. In pieces: `plan` the
/// sweep, `run` its shards anywhere, `merge` what they recorded.
#[derive(Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Arguments {
    #[command(flatten)]
    whole: Option<Whole>,
    #[command(subcommand)]
    part: Option<Part>,
}

/// The whole sweep on this machine.
#[derive(Args)]
struct Whole {
    /// The sweep, a JSON file.
    file: PathBuf,
    /// The folder for records and results; made if missing.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Number of worker processes; one a core by default.
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
    /// Go on with the records that the folder has, doing only what is missing.
    #[arg(long)]
    resume: bool,
    /// Keep the plan of every case that is done now, in DIR/plans/CASE_ID with its page (0.8 MB a case);
    /// points of slews.html open it.
    #[arg(long)]
    keep_plans: bool,
    /// Print the summary as one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(Subcommand)]
enum Part {
    Plan(plan::Arguments),
    Run(run::Arguments),
    Merge(merge::Arguments),
    Show(show::Arguments),
    Slurm(slurm::Arguments),
}

impl Arguments {
    /// Whether stdout takes one JSON object.
    pub fn prints_json(&self) -> bool {
        match (&self.part, &self.whole) {
            (Some(Part::Merge(arguments)), _) => arguments.json,
            (Some(Part::Show(arguments)), _) => arguments.json,
            (Some(Part::Plan(_) | Part::Run(_) | Part::Slurm(_)), _) => false,
            (None, whole) => whole.as_ref().is_some_and(|whole| whole.json),
        }
    }
}

/// Does what the arguments say.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    match (&arguments.part, &arguments.whole) {
        (Some(Part::Plan(arguments)), _) => plan::run(arguments),
        (Some(Part::Run(arguments)), _) => run::run(arguments),
        (Some(Part::Merge(arguments)), _) => merge::run(arguments),
        (Some(Part::Show(arguments)), _) => show::run(arguments),
        (Some(Part::Slurm(arguments)), _) => slurm::run(arguments),
        (None, Some(whole)) => run_whole(whole),
        (None, None) => unreachable!("a file is required where there is no part"),
    }
}

/// A folder that should be one of a planned sweep.
fn planned(folder: &Path) -> Result<SweepFolder, Failure> {
    plan_folder::refuse_file(folder, "the folder of a sweep")?;
    Ok(SweepFolder::at(folder))
}

fn run_whole(whole: &Whole) -> Result<(), Failure> {
    let sweep = plan::read(&whole.file)?;
    let folder = SweepFolder::at(OutputFolder::open(&whole.out)?.path());
    folder.begin(&sweep, crate::build::VERSION, whole.resume)?;
    run::run_shard(&folder, &sweep, Shard::WHOLE, whole.jobs, whole.keep_plans)?;
    merge::merge(&folder, whole.json)
}

/// A worker: cases in on stdin, outcomes out on stdout.
pub fn work() -> Result<(), Failure> {
    // A terminal's Ctrl-C reaches every process; it is the parent that ends its workers.
    let _first_is_not_for_us = Interrupt::watch();
    optimizer::load()?;
    worker::serve().map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::Interrupted { has_plan: false },
        _ => Failure::Stdout(error),
    })
}
