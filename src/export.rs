//! `righting export`: a plan in the formats of other programs.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use clap::{Args, ValueEnum};
use jiff::Timestamp;
use jiff::civil::DateTime;
use jiff::tz::Offset;
use righting_maneuver::{Solution, Verified, verify_directory};
use righting_report::{AemOptions, aem, npz, write_whole};

use crate::failure::Failure;
use crate::output;
use crate::output_folder::{AEM_FILE, NPZ_FILE, OutputFolder};

/// Write a plan in the format of other programs.
#[derive(Args)]
pub struct Arguments {
    /// A folder with trajectory.csv and solution.json.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// The format.
    #[arg(long, value_enum)]
    format: Format,
    /// The file; attitude.aem or trajectory.npz in the plan's folder if not given.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// AEM: time of the first node, such as 2027-03-01T12:00:00.
    #[arg(long, value_name = "TIME", default_value = "2000-01-01T12:00:00", value_parser = epoch)]
    epoch: DateTime,
    /// AEM: the time system of the epoch; no leap second is expected within the maneuver.
    #[arg(long, value_name = "NAME", default_value = "UTC")]
    time_system: String,
    /// AEM: the inertial frame that the scenario's inertial axes are.
    #[arg(long, value_name = "NAME", default_value = "EME2000")]
    frame: String,
    /// AEM: name of the spacecraft; the system's if not given.
    #[arg(long, value_name = "NAME")]
    object_name: Option<String>,
    /// AEM: international designator of the spacecraft.
    #[arg(long, value_name = "ID", default_value = "UNKNOWN")]
    object_id: String,
    /// AEM: who sends the message.
    #[arg(long, value_name = "NAME", default_value = "RIGHTING")]
    originator: String,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// CCSDS Attitude Ephemeris Message, version 2.0, keyword = value.
    Aem,
    /// NumPy archive, one array a group of columns.
    Npz,
}

/// Reads, checks, converts and writes.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let plan = verify_directory(&arguments.folder)?;
    let Verified { solution, scenario, trajectory, verification } = plan;
    let solution = Solution { verification, ..solution };
    if let Some(failure) = Failure::of_verification(&solution) {
        return Err(failure);
    }
    let (name, contents) = match arguments.format {
        Format::Npz => (NPZ_FILE, npz(&trajectory)?),
        Format::Aem => {
            let options = message_options(arguments, &scenario.system().name);
            (AEM_FILE, aem(&solution, &trajectory, &options)?.into_bytes())
        }
    };
    let file = arguments.out.clone().unwrap_or_else(|| arguments.folder.join(name));
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = OutputFolder::open(folder.unwrap_or(Path::new(".")))?;
    let name = file.file_name().map(|name| name.to_string_lossy().into_owned());
    let written = write_whole(folder.path(), &name.unwrap_or_default(), &contents)?;
    output::print(&format!("{}\n", written.display()))
}

fn message_options(arguments: &Arguments, system: &str) -> AemOptions {
    let now = Timestamp::try_from(SystemTime::now()).unwrap_or_default();
    AemOptions {
        epoch: arguments.epoch,
        creation_date: Offset::UTC.to_datetime(now),
        originator: arguments.originator.clone(),
        object_name: arguments.object_name.clone().unwrap_or_else(|| system.to_owned()),
        object_id: arguments.object_id.clone(),
        inertial_frame: arguments.frame.clone(),
        time_system: arguments.time_system.clone(),
    }
}

/// A civil time; a closing Z, which the format allows for UTC, is taken.
fn epoch(text: &str) -> Result<DateTime, String> {
    let text = text.strip_suffix('Z').unwrap_or(text);
    text.parse().map_err(|_| "a time such as 2027-03-01T12:00:00 is needed".to_owned())
}
