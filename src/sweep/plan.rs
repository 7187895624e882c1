//! `righting sweep plan`: what is to be done, written down for any machine.

use std::path::{Path, PathBuf};

use clap::Args;
use righting_sweep::{Sweep, SweepError, SweepFolder};

use crate::failure::Failure;
use crate::output;
use crate::output_folder::OutputFolder;

/// Check a sweep file and write its plan to a folder, for `run` to work on.
#[derive(Args)]
pub struct Arguments {
    /// The sweep, a JSON file.
    file: PathBuf,
    /// The folder for the plan, the records and the results; made if missing.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Plans. A folder that is planned already keeps its records: a case is known by what it sets.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let sweep = read(&arguments.file)?;
    let folder = SweepFolder::at(OutputFolder::open(&arguments.out)?.path());
    folder.plan(&sweep, crate::build::VERSION)?;
    let out = arguments.out.display();
    output::print(&format!(
        "{}: {} cases planned in {out}\n  run them with `righting sweep run {out} --shard i/n`\n",
        sweep.name(),
        sweep.len()
    ))
}

/// Reads a sweep file.
pub fn read(file: &Path) -> Result<Sweep, Failure> {
    Sweep::read(file).map_err(|error| SweepError::Input(error).into())
}
