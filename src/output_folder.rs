//! The folder that takes results: made and tried before minutes are spent on them.

use std::fs::{File, TryLockError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use righting_results::{SOLUTION_FILE, TRAJECTORY_FILE};
use righting_scenario::file_io;
use serde::Serialize;

use crate::failure::Failure;
use crate::json_path;

/// A folder that was writable when it was opened.
pub struct OutputFolder {
    folder: PathBuf,
    /// Locked against other runs while this one may write, where it asked for that.
    _lock: Option<File>,
}

/// The files of a solve, named as `--json` names them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ResultFiles {
    /// The plan, node by node; where there is one.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "json_path::option")]
    pub trajectory: Option<PathBuf>,
    /// The outcome and everything else about the plan.
    #[serde(serialize_with = "json_path::path")]
    pub solution: PathBuf,
    /// Figure of the base's attitude and rates.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "json_path::option")]
    pub attitude: Option<PathBuf>,
    /// Figure of the joints.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "json_path::option")]
    pub joints: Option<PathBuf>,
    /// The interactive page.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "json_path::option")]
    pub report: Option<PathBuf>,
    /// All figures, in the order a reader wants them.
    #[serde(serialize_with = "json_path::list")]
    pub figures: Vec<PathBuf>,
}

/// The figure of the base.
pub const ATTITUDE_FILE: &str = "attitude.svg";
/// The figure of the joints.
pub const JOINTS_FILE: &str = "joints.svg";
/// The interactive page.
pub const REPORT_FILE: &str = "report.html";
/// The page of plans side by side.
pub const COMPARE_FILE: &str = "compare.html";
/// The figure of the clearances.
pub const CLEARANCES_FILE: &str = "clearances.svg";
/// The figure of loads beside their limits.
pub const LOADS_FILE: &str = "loads.svg";
/// The figure of what reaction wheels store and give.
pub const WHEELS_FILE: &str = "wheels.svg";
/// The figure of where instruments look.
pub const POINTING_FILE: &str = "pointing.svg";
/// The figure of the momentum's conservation.
pub const MOMENTUM_FILE: &str = "momentum.svg";
/// The figure of the optimizer's way.
pub const CONVERGENCE_FILE: &str = "convergence.svg";
/// The figure of the nonlinear program's structure.
pub const SPARSITY_FILE: &str = "sparsity.svg";
/// What the plan's motion costs.
pub const POWER_FILE: &str = "power.json";
/// The figure of it.
pub const POWER_FIGURE_FILE: &str = "power.svg";

/// The plan as an Attitude Ephemeris Message.
pub const AEM_FILE: &str = "attitude.aem";
/// The plan as a NumPy archive.
pub const NPZ_FILE: &str = "trajectory.npz";
/// The plan as a MATLAB file.
pub const MAT_FILE: &str = "trajectory.mat";
/// The system as URDF.
pub const URDF_FILE: &str = "system.urdf";
/// The system as MJCF.
pub const MJCF_FILE: &str = "system.xml";
/// The joints' motion as a message of ROS 2.
pub const JOINT_TRAJECTORY_FILE: &str = "joint_trajectory.yaml";
/// The plan as an attitude file of STK.
pub const STK_FILE: &str = "attitude.a";
/// The plan as a C-kernel of SPICE.
pub const CK_FILE: &str = "attitude.bc";
/// The clock of the C-kernel.
const CLOCK_FILE: &str = "attitude.tsc";
/// The frame of the C-kernel.
const FRAME_FILE: &str = "attitude.tf";
/// The gains about a plan.
pub const GAINS_FILE: &str = "gains.npz";
/// The script that flies the plan in Basilisk.
pub const BASILISK_FILE: &str = "fly_basilisk.py";
/// The script that flies the plan in MuJoCo.
pub const MUJOCO_FILE: &str = "fly_mujoco.py";

/// Everything that belongs to a plan, but for the PNGs beside the figures. What says that the rest is
/// whole comes first: it is the first to be removed.
const ALL: [&str; 27] = [
    SOLUTION_FILE,
    TRAJECTORY_FILE,
    ATTITUDE_FILE,
    JOINTS_FILE,
    REPORT_FILE,
    CLEARANCES_FILE,
    LOADS_FILE,
    WHEELS_FILE,
    POINTING_FILE,
    MOMENTUM_FILE,
    CONVERGENCE_FILE,
    SPARSITY_FILE,
    POWER_FILE,
    POWER_FIGURE_FILE,
    AEM_FILE,
    NPZ_FILE,
    MAT_FILE,
    URDF_FILE,
    MJCF_FILE,
    JOINT_TRAJECTORY_FILE,
    STK_FILE,
    CK_FILE,
    CLOCK_FILE,
    FRAME_FILE,
    BASILISK_FILE,
    MUJOCO_FILE,
    GAINS_FILE,
];

/// Names of everything that belongs to a plan.
fn all() -> impl Iterator<Item = PathBuf> {
    let others = ALL.into_iter().map(PathBuf::from).filter(|name| !is_figure(name));
    others.chain(figures())
}

/// Names of the figures of a plan, as SVG and as PNG.
fn figures() -> impl Iterator<Item = PathBuf> {
    let figures = ALL.into_iter().map(PathBuf::from).filter(|name| is_figure(name));
    figures.flat_map(|name| [name.with_extension("png"), name])
}

fn is_figure(name: &Path) -> bool {
    name.extension() == Some("svg".as_ref())
}

impl ResultFiles {
    /// Of a plan with its figures and its page.
    pub fn of_plan(folder: &OutputFolder, figures: Vec<PathBuf>, report: Option<PathBuf>) -> Self {
        let trajectory = Some(folder.path().join(TRAJECTORY_FILE));
        let drawn = |name| figures.iter().find(|file| file.ends_with(name)).cloned();
        let (attitude, joints) = (drawn(ATTITUDE_FILE), drawn(JOINTS_FILE));
        Self { trajectory, attitude, joints, figures, report, ..Self::without_plan(folder) }
    }

    /// Of a solve that found none.
    pub fn without_plan(folder: &OutputFolder) -> Self {
        let solution = folder.path().join(SOLUTION_FILE);
        Self {
            trajectory: None,
            solution,
            attitude: None,
            joints: None,
            report: None,
            figures: Vec::new(),
        }
    }

    /// Those that there are, in the order they are listed to a reader.
    pub fn paths(&self) -> Vec<PathBuf> {
        let Self { trajectory, solution, figures, report, .. } = self;
        trajectory.iter().chain([solution]).chain(figures).chain(report).cloned().collect()
    }
}

impl OutputFolder {
    /// Makes the folder if there is none, and makes sure that results can be written there.
    pub fn open(folder: &Path) -> Result<Self, Failure> {
        let refuse = |problem: String| Failure::OutputFolder { folder: folder.to_owned(), problem };
        std::fs::create_dir_all(folder).map_err(|error| {
            refuse(match error.kind() {
                ErrorKind::AlreadyExists | ErrorKind::NotADirectory => {
                    "a file is in its place".to_owned()
                }
                _ => plain(&error),
            })
        })?;
        tempfile::NamedTempFile::new_in(folder).map_err(|error| refuse(plain(&error)))?;
        match all().find(|name| folder.join(name).is_dir()) {
            Some(name) => Err(refuse(format!("{} is a directory", name.display()))),
            None => Ok(Self { folder: folder.to_owned(), _lock: None }),
        }
    }

    /// [`open`](Self::open), and no other run may do so until this is dropped: the files of two plans never mix.
    pub fn open_alone(folder: &Path) -> Result<Self, Failure> {
        let opened = Self::open(folder)?;
        let refuse = |problem: String| Failure::OutputFolder { folder: folder.to_owned(), problem };
        // Where folders cannot be opened there are no locks on them: then it is up to the user.
        let Ok(lock) = File::open(folder) else { return Ok(opened) };
        match lock.try_lock() {
            Err(TryLockError::WouldBlock) => Err(refuse("another run is writing there".to_owned())),
            Ok(()) | Err(TryLockError::Error(_)) => Ok(Self { _lock: Some(lock), ..opened }),
        }
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.folder
    }

    /// Writes a file, whole or not at all; its path.
    pub fn write(&self, name: &str, contents: &[u8]) -> Result<PathBuf, Failure> {
        let file = self.folder.join(name);
        file_io::replace(&file, |writer| writer.write_all(contents))?;
        Ok(file)
    }

    /// Removes an earlier plan, so that a solve without one leaves none that looks like its own.
    pub fn remove_earlier_plan(&self) -> Result<(), Failure> {
        self.remove(all())
    }

    /// Removes the figures of an earlier plan: the next one may not have all of them.
    pub fn remove_earlier_figures(&self) -> Result<(), Failure> {
        self.remove(figures())
    }

    fn remove(&self, names: impl Iterator<Item = PathBuf>) -> Result<(), Failure> {
        for name in names {
            file_io::remove(&self.folder.join(name))?;
        }
        Ok(())
    }
}

/// An I/O error in few words, without the system's error number.
fn plain(error: &std::io::Error) -> String {
    match error.kind() {
        ErrorKind::PermissionDenied => "permission denied".to_owned(),
        ErrorKind::ReadOnlyFilesystem => "the file system is read-only".to_owned(),
        ErrorKind::NotFound => "it cannot be made there".to_owned(),
        ErrorKind::StorageFull => "the disk is full".to_owned(),
        _ => {
            // tempfile adds the path, the system its error number.
            let text = error.to_string().to_lowercase();
            let end = [" (os error", " at path"].iter().filter_map(|mark| text.find(mark)).min();
            text[..end.unwrap_or(text.len())].to_owned()
        }
    }
}
