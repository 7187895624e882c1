//! `righting export`: a plan in the formats of other programs.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use clap::{Args, ValueEnum};
use jiff::Timestamp;
use jiff::civil::DateTime;
use jiff::tz::Offset;
use righting_export::{AemOptions, aem, npz};
use righting_report::maneuver_phrase;
use righting_results::Solution;
use righting_verifier::Verified;

use crate::failure::Failure;
use crate::output_folder::{AEM_FILE, NPZ_FILE, OutputFolder};
use crate::{output, plan_folder};

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
    #[command(flatten)]
    message: Option<Message>,
}

/// What a message says beyond the plan.
#[derive(Args, Clone, Default)]
struct Message {
    /// AEM: time of the first node, such as 2027-03-01T12:00:00; 2000-01-01T12:00:00 if not given.
    #[arg(long, value_name = "TIME", value_parser = epoch)]
    epoch: Option<DateTime>,
    /// AEM: the time system of the epoch, UTC if not given; no leap second is expected within the
    /// maneuver.
    #[arg(long, value_name = "NAME")]
    time_system: Option<String>,
    /// AEM: the inertial frame that the scenario's inertial axes are; EME2000 if not given.
    #[arg(long, value_name = "NAME")]
    frame: Option<String>,
    /// AEM: name of the spacecraft; the system's if not given.
    #[arg(long, value_name = "NAME")]
    object_name: Option<String>,
    /// AEM: international designator of the spacecraft; UNKNOWN if not given.
    #[arg(long, value_name = "ID")]
    object_id: Option<String>,
    /// AEM: who sends the message; RIGHTING if not given.
    #[arg(long, value_name = "NAME")]
    originator: Option<String>,
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
    if let (Format::Npz, Some(_)) = (arguments.format, &arguments.message) {
        return Err(Failure::Usage(
            "--format npz: an archive holds the plan alone, no epoch, frame or names",
        ));
    }
    let Verified { solution, scenario, trajectory } = plan_folder::read(&arguments.folder)?;
    if let Some(failure) = Failure::of_verification(&solution) {
        return Err(failure);
    }
    let (name, contents) = match arguments.format {
        Format::Npz => (NPZ_FILE, npz(&trajectory)?),
        Format::Aem => {
            let message = arguments.message.clone().unwrap_or_default();
            let options = message.options(&solution, &scenario.system().name);
            (AEM_FILE, aem(&solution, &trajectory, &options)?.into_bytes())
        }
    };
    let file = arguments.out.clone().unwrap_or_else(|| arguments.folder.join(name));
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = OutputFolder::open(folder.unwrap_or(Path::new(".")))?;
    let name = file.file_name().map(|name| name.to_string_lossy().into_owned());
    let written = folder.write(&name.unwrap_or_default(), &contents)?;
    output::print(&format!("{}\n", written.display()))
}

impl Message {
    fn options(self, solution: &Solution, system: &str) -> AemOptions {
        let now = Timestamp::try_from(SystemTime::now()).unwrap_or_default();
        let or = |given: Option<String>, default: &str| given.unwrap_or_else(|| default.to_owned());
        AemOptions {
            maneuver: maneuver_phrase(&solution.scenario),
            epoch: self.epoch.unwrap_or(DateTime::constant(2000, 1, 1, 12, 0, 0, 0)),
            creation_date: Offset::UTC.to_datetime(now),
            originator: or(self.originator, "RIGHTING"),
            object_name: or(self.object_name, system),
            object_id: or(self.object_id, "UNKNOWN"),
            inertial_frame: or(self.frame, "EME2000"),
            time_system: or(self.time_system, "UTC"),
        }
    }
}

/// A civil time; a closing Z, which the format allows for UTC, is taken.
fn epoch(text: &str) -> Result<DateTime, String> {
    let text = text.strip_suffix('Z').unwrap_or(text);
    text.parse().map_err(|_| "expected a time such as 2027-03-01T12:00:00".to_owned())
}
