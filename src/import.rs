//! `righting import`: a system file from a robot's URDF file.

mod joint_value;

use std::path::{Path, PathBuf};

use clap::{Args, ValueHint};
use righting_scenario::file::SystemOptions;
use righting_scenario::import_urdf;
use righting_scenario::json::{Document, FileKind};

use crate::failure::Failure;
use crate::output::{self, Label};
use crate::output_folder::OutputFolder;
use crate::readable_json::readable_json;
use joint_value::JointValue;

/// Write a system file from the URDF file of a robot.
#[derive(Args)]
pub struct Arguments {
    /// The robot: a URDF file, its macros expanded.
    #[arg(value_name = "URDF", value_hint = ValueHint::FilePath)]
    robot: PathBuf,
    #[command(flatten)]
    root: Root,
    /// Where the robot's root link sits on the base of --on, m.
    #[arg(long, num_args = 3, value_names = ["X", "Y", "Z"], allow_negative_numbers = true)]
    mount_xyz: Option<Vec<f64>>,
    /// How it is turned there: roll, pitch and yaw, deg.
    #[arg(long, num_args = 3, value_names = ["R", "P", "Y"], allow_negative_numbers = true)]
    mount_rpy: Option<Vec<f64>>,
    /// The end of the only arm that moves; joints that are not between the base and this link are held.
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// Hold a joint at an angle in deg, or where it slides a position in m; may be given again.
    #[arg(long, value_name = "JOINT=VALUE")]
    lock: Vec<JointValue>,
    /// Leave out a link with all that hangs on it; may be given again.
    #[arg(long, value_name = "LINK")]
    drop: Vec<String>,
    /// Largest acceleration of joints that turn, deg/s^2; URDF has none.
    #[arg(long, value_name = "A")]
    acceleration_max_deg_s2: Option<f64>,
    /// Largest rate of joints that turn and have no velocity limit, deg/s.
    #[arg(long, value_name = "W")]
    rate_max_deg_s: Option<f64>,
    /// Largest acceleration of joints that slide, m/s^2; URDF has none.
    #[arg(long, value_name = "A")]
    acceleration_max_m_s2: Option<f64>,
    /// Largest speed of joints that slide and have no velocity limit, m/s.
    #[arg(long, value_name = "V")]
    speed_max_m_s: Option<f64>,
    /// Take links that have a mass and no inertia as point masses.
    #[arg(long)]
    point_masses: bool,
    /// Take the nearest inertia that a rigid body can have where the file's is none.
    #[arg(long)]
    project_inertias: bool,
    /// The system file to write.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    out: PathBuf,
}

#[derive(Args)]
#[group(required = true, multiple = false)]
struct Root {
    /// The link that floats: the base.
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// A file with the base that the robot's root link is fixed to, as in a system file.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    on: Option<PathBuf>,
}

/// Reads, puts together, checks and writes.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let imported = import_urdf(&arguments.robot, &arguments.options()?)?;
    let folder = arguments.out.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = OutputFolder::open(folder.unwrap_or(Path::new(".")))?;
    let name = arguments.out.file_name().unwrap_or_default().to_string_lossy();
    folder.write(&name, readable_json(&imported.resolved)?.as_bytes())?;
    for note in &imported.notes {
        output::say(Label::Note, note);
    }
    output::print(&format!("{}\n", arguments.out.display()))
}

impl Arguments {
    /// The same as a scenario's `system_options`.
    fn options(&self) -> Result<SystemOptions, Failure> {
        let on = match &self.root.on {
            Some(file) => Some(Document::read(file, FileKind::Base)?.decode()?),
            None => None,
        };
        let three = |values: &Option<Vec<f64>>| values.as_deref().and_then(|v| v.try_into().ok());
        Ok(SystemOptions {
            base: self.root.base.clone(),
            on,
            mount_position_m: three(&self.mount_xyz),
            mount_rpy_deg: three(&self.mount_rpy),
            tip: self.tip.clone(),
            locked: self.lock.iter().map(|lock| (lock.joint.clone(), lock.value)).collect(),
            dropped: self.drop.clone(),
            acceleration_max_deg_s2: self.acceleration_max_deg_s2,
            rate_max_deg_s: self.rate_max_deg_s,
            acceleration_max_m_s2: self.acceleration_max_m_s2,
            speed_max_m_s: self.speed_max_m_s,
            point_masses: self.point_masses,
            project_inertias: self.project_inertias,
        })
    }
}
