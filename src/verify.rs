//! `righting verify`: check the plan in a folder again, from its files alone.

use std::path::{Path, PathBuf};

use clap::Args;
use righting_report::verification_summary;
use righting_results::{TRAJECTORY_FILE, Verification};
use righting_verifier::Verified;
use serde::Serialize;

use crate::failure::Failure;
use crate::{json_path, output, plan_folder};

/// Check the plan in a folder again, from its files alone.
#[derive(Args)]
pub struct Arguments {
    /// The folder with trajectory.csv and solution.json.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    pub json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Printed<'a> {
    scenario: &'a str,
    #[serde(serialize_with = "json_path::path")]
    trajectory: &'a Path,
    verification: &'a Verification,
}

/// Reads, checks and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Verified { solution, scenario, .. } = plan_folder::read(&arguments.folder)?;
    if arguments.json {
        output::print_json(&Printed {
            scenario: scenario.name(),
            trajectory: &arguments.folder.join(TRAJECTORY_FILE),
            verification: &solution.verification,
        })?;
    } else {
        output::print(&verification_summary(&solution))?;
    }
    Failure::of_verification(&solution).map_or(Ok(()), Err)
}
