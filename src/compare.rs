//! `righting compare`: plans side by side.

use std::path::{Path, PathBuf};

use clap::Args;
use righting_analysis::PowerProfile;
use righting_report::{ComparedNumbers, ComparedPlan, compare_html, comparison_table};
use righting_scenario::Error;
use righting_verifier::Verified;
use serde::Serialize;

use crate::failure::Failure;
use crate::output_folder::{COMPARE_FILE, OutputFolder};
use crate::{output, plan_folder};

/// Compare plans side by side: effort, duration, torque, power, how near they come to their limits.
#[derive(Args)]
pub struct Arguments {
    /// Folders with trajectory.csv and solution.json, each checked again.
    #[arg(value_name = "DIR", num_args = 2..=MOST_PLANS, required = true)]
    folders: Vec<PathBuf>,
    /// The folder for compare.html, the plans on one clock with overlaid plots; none is written if not given.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    pub json: bool,
}

/// More scenes than these a browser does not draw at a time.
const MOST_PLANS: usize = 12;

/// What `--json` prints.
#[derive(Serialize)]
struct Printed<'a> {
    schema: &'static str,
    plans: Vec<PrintedPlan<'a>>,
    /// The page; absent where none was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    page: Option<PathBuf>,
}

#[derive(Serialize)]
struct PrintedPlan<'a> {
    folder: &'a Path,
    #[serde(flatten)]
    numbers: ComparedNumbers<'a>,
}

/// Reads, checks, compares, writes and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let folder = arguments.out.as_deref().map(OutputFolder::open).transpose()?;
    let read = arguments.folders.iter().map(|folder| plan_folder::read(folder));
    let verified = read.collect::<Result<Vec<Verified>, Failure>>()?;
    let profiles = verified.iter().map(|plan| PowerProfile::new(&plan.scenario, &plan.trajectory));
    let profiles = profiles.collect::<Result<Vec<_>, _>>().map_err(Error::from)?;
    let names = names(&arguments.folders);
    let plans: Vec<ComparedPlan<'_>> = names
        .iter()
        .zip(verified.iter().zip(&profiles))
        .map(|(name, (plan, profile))| ComparedPlan::new(name, plan, profile))
        .collect();
    let page = match &folder {
        Some(folder) => Some(folder.write(COMPARE_FILE, compare_html(&plans).as_bytes())?),
        None => None,
    };
    if arguments.json {
        let numbered = arguments.folders.iter().zip(&plans);
        let plans = numbered
            .map(|(folder, plan)| PrintedPlan { folder, numbers: ComparedNumbers::of(plan) })
            .collect();
        output::print_json(&Printed { schema: "righting.compare/1", plans, page })?;
    } else {
        let page = page.map(|page| format!("\n{}\n", page.display())).unwrap_or_default();
        output::print(&(comparison_table(&plans) + &page))?;
    }
    let failed = verified.iter().find_map(|plan| Failure::of_verification(&plan.solution));
    failed.map_or(Ok(()), Err)
}

/// The last parts of the folders, or, where two would be the same, all of their paths.
fn names(folders: &[PathBuf]) -> Vec<String> {
    let short: Vec<String> = folders
        .iter()
        .filter_map(|folder| Some(folder.file_name()?.to_string_lossy().into_owned()))
        .collect();
    let mut distinct = short.clone();
    distinct.sort_unstable();
    distinct.dedup();
    match distinct.len() == folders.len() {
        true => short,
        false => folders.iter().map(|folder| folder.display().to_string()).collect(),
    }
}
