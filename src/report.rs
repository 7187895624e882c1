//! `righting report`: the page of a plan again, from its files alone.

use std::path::{Path, PathBuf};

use clap::Args;
use righting_report::report_html;
use righting_verifier::Verified;
use serde::Serialize;

use crate::failure::Failure;
use crate::output_folder::{OutputFolder, REPORT_FILE};
use crate::{json_path, output, plan_folder};

/// Check the plan in a folder again and write its interactive page, report.html.
#[derive(Args)]
pub struct Arguments {
    /// The folder with trajectory.csv and solution.json; takes the page too.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    pub json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Printed<'a> {
    #[serde(serialize_with = "json_path::path")]
    report: &'a Path,
}

/// Reads, checks, writes and prints. The page shows what is found now, failures too.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Verified { solution, scenario, trajectory } = plan_folder::read(&arguments.folder)?;
    let page = report_html(&scenario, &solution, &trajectory);
    let report = OutputFolder::open(&arguments.folder)?.write(REPORT_FILE, page.as_bytes())?;
    if arguments.json {
        output::print_json(&Printed { report: &report })?;
    } else {
        output::print(&format!("{}\n", report.display()))?;
    }
    Failure::of_verification(&solution).map_or(Ok(()), Err)
}
