//! `righting sweep slurm`: a planned sweep as a Slurm job array.

use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use clap::Args;
use righting_scenario::file_io;
use righting_sweep::{Sweep, SweepError};

use crate::failure::Failure;
use crate::output;

const SCRIPT: &str = "sweep.sbatch";
const LOGS: &str = "logs";

/// Write the job array that runs a planned sweep on a Slurm cluster.
///
/// Each task of the array runs one shard. Tasks may be run again at any time: what a shard has
/// recorded it does not do again.
#[derive(Args)]
pub struct Arguments {
    /// The folder of the plan, on a file system that every node sees.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Number of shards: tasks of the array.
    #[arg(long, value_name = "N")]
    shards: NonZeroUsize,
    /// Worker processes, and cores, of a task.
    #[arg(long, value_name = "N", default_value = "1")]
    jobs: NonZeroUsize,
    /// Time limit of a task, as sbatch takes it.
    #[arg(long, value_name = "TIME", default_value = "24:00:00", value_parser = word)]
    time: String,
    /// Memory of a core, as sbatch takes it.
    #[arg(long, value_name = "MEMORY", default_value = "512M", value_parser = word)]
    memory: String,
    /// Partition; the cluster's default if not given.
    #[arg(long, value_name = "NAME", value_parser = word)]
    partition: Option<String>,
}

/// Writes the script and says how to submit it.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let sweep = super::planned(&arguments.folder)?.sweep()?;
    let absolute = |path: &Path| {
        std::fs::canonicalize(path)
            .map_err(|source| SweepError::Read { path: path.to_owned(), source })
    };
    let folder = absolute(&arguments.folder)?;
    let program = std::env::current_exe()
        .map_err(|source| SweepError::Read { path: "righting".into(), source })?;
    let logs = folder.join(LOGS);
    std::fs::create_dir_all(&logs).map_err(|source| SweepError::Write { path: logs, source })?;
    let script = folder.join(SCRIPT);
    let text = script_of(arguments, &sweep, &program, &folder);
    file_io::replace(&script, |writer| writer.write_all(text.as_bytes()))?;
    let (script, program) = (quoted(&script), quoted(&program));
    let folder = quoted(&folder);
    output::print(&format!(
        "{} cases in {} shards. Submit, and merge when all have ended:\n  \
         id=$(sbatch --parsable {script})\n  \
         sbatch --dependency=afterany:$id --output={LOGS}-merge.txt --wrap \"{program} sweep merge {folder}\"\n",
        sweep.len(),
        arguments.shards,
    ))
}

fn script_of(arguments: &Arguments, sweep: &Sweep, program: &Path, folder: &Path) -> String {
    let Arguments { shards, jobs, time, memory, partition, .. } = arguments;
    let mut options = vec![
        "job-name=righting-sweep".to_owned(),
        format!("array=1-{shards}"),
        "ntasks=1".to_owned(),
        format!("cpus-per-task={jobs}"),
        format!("mem-per-cpu={memory}"),
        format!("time={time}"),
        format!("output={}/%a.log", quoted(&folder.join(LOGS))),
        "open-mode=append".to_owned(),
        "requeue".to_owned(),
        // To the program itself, a minute before the end: it stops cleanly.
        "signal=B:TERM@60".to_owned(),
    ];
    options.extend(partition.as_ref().map(|name| format!("partition={name}")));
    let mut text = "#!/bin/bash\n".to_owned();
    let mut line = |line: String| {
        text.write_str(&line).expect("a string takes all that is written to it");
        text.push('\n');
    };
    for option in options {
        line(format!("#SBATCH --{option}"));
    }
    // A name may hold anything.
    let name: String = sweep.name().chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    line(format!(
        "# {} cases of the sweep {name}. A task that is run again does what is missing.",
        sweep.len()
    ));
    line(format!(
        "exec {} sweep run {} --shard \"$SLURM_ARRAY_TASK_ID/{shards}\" --jobs {jobs}",
        quoted(program),
        quoted(folder)
    ));
    text
}

/// A path as one word of a shell.
fn quoted(path: &Path) -> String {
    let text = path.to_string_lossy();
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=:,@".contains(c);
    if text.chars().all(plain) {
        text.into_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

/// An option's value that cannot end its line or start another option.
fn word(text: &str) -> Result<String, String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-:,".contains(c);
    match !text.is_empty() && text.chars().all(plain) {
        true => Ok(text.to_owned()),
        false => Err("expected letters, digits and . _ - : , only".to_owned()),
    }
}
