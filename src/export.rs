//! `righting export`: a plan in the formats of other programs.

mod format;
mod message;

use std::path::{Path, PathBuf};

use clap::Args;
use righting_export::{
    JointTrajectory, PlannedGains, SpiceKernels, aem, basilisk, ck, mat, mjcf, mujoco, npz, stk,
    urdf,
};
use righting_planner::Feedback;
use righting_report::maneuver_phrase;
use righting_verifier::Verified;

use crate::failure::Failure;
use crate::output_folder::OutputFolder;
use crate::{output, plan_folder};
use format::Format;
use message::Message;

/// Write a plan, or its system, in the format of other programs.
#[derive(Args)]
pub struct Arguments {
    /// A folder with trajectory.csv and solution.json.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// The format.
    #[arg(long, value_enum)]
    format: Format,
    /// The file; in the plan's folder, under the name above, if not given.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    #[command(flatten)]
    message: Message,
}

/// Reads, checks, converts and writes.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let format = arguments.format;
    let message = arguments.message.clone();
    message.refuse_unless_taken(format)?;
    let plan = plan_folder::read(&arguments.folder)?;
    if let Some(failure) = Failure::of_verification(&plan.solution) {
        return Err(failure);
    }
    let file = arguments.out.clone().unwrap_or_else(|| arguments.folder.join(format.file()));
    let files = exported(&plan, format, &file, message)?;
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = OutputFolder::open(folder.unwrap_or(Path::new(".")))?;
    let mut written = String::new();
    for (file, contents) in files {
        let name = file.file_name().map(|name| name.to_string_lossy().into_owned());
        let path = folder.write(&name.unwrap_or_default(), &contents)?;
        written.push_str(&format!("{}\n", path.display()));
    }
    output::print(&written)
}

/// Every file with its contents, the one that is asked for first.
fn exported(
    plan: &Verified,
    format: Format,
    file: &Path,
    message: Message,
) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
    let Verified { solution, scenario, trajectory } = plan;
    let system = scenario.system();
    let maneuver = maneuver_phrase(solution);
    let contents = match format {
        Format::Aem => {
            let options = message.of_aem(maneuver, &system.name);
            aem(solution, trajectory, &options)?.into_bytes()
        }
        Format::Stk => stk(solution, trajectory, &message.of_stk(maneuver))?.into_bytes(),
        Format::Ck => {
            let options = message.of_ck(maneuver, &system.name);
            return spice_files(file, ck(solution, trajectory, &options)?);
        }
        Format::Npz => npz(trajectory)?,
        Format::Mat => mat(trajectory),
        Format::Urdf => urdf(system).into_bytes(),
        Format::Mjcf => mjcf(system, trajectory).into_bytes(),
        Format::JointTrajectory => {
            let motion = JointTrajectory::new(scenario, trajectory)?;
            let is_json = file.extension().is_some_and(|extension| extension == "json");
            if is_json { motion.to_json() } else { motion.to_yaml() }.into_bytes()
        }
        Format::Gains => {
            let gains = Feedback::new(scenario, trajectory)?.gains();
            let gains = PlannedGains { trajectory, gains: &gains };
            let is_table = file.extension().is_some_and(|extension| extension == "csv");
            if is_table { gains.to_csv().into_bytes() } else { gains.to_npz()? }
        }
        Format::Mujoco => mujoco(scenario, solution, trajectory, &maneuver)?,
        Format::Basilisk => basilisk(scenario, solution, trajectory, &maneuver)?,
    };
    Ok(vec![(file.to_owned(), contents)])
}

/// The C-kernel, and its clock and frame beside it.
fn spice_files(file: &Path, kernels: SpiceKernels) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
    let SpiceKernels { ck, clock, frame } = kernels;
    let [clock_file, frame_file] = ["tsc", "tf"].map(|extension| file.with_extension(extension));
    if file == clock_file || file == frame_file {
        return Err(Failure::Usage(
            "--out ends in .tsc or .tf, the names of the kernels beside the C-kernel: give it \
             another ending, such as .bc",
        ));
    }
    Ok(vec![
        (file.to_owned(), ck),
        (clock_file, clock.into_bytes()),
        (frame_file, frame.into_bytes()),
    ])
}
