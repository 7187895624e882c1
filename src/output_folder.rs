//! The folder that takes results: made and tried before minutes are spent on them.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use righting_maneuver::verifier::{SOLUTION_FILE, TRAJECTORY_FILE};
use serde::Serialize;

use crate::failure::Failure;

/// A folder that was writable when it was opened.
pub struct OutputFolder {
    folder: PathBuf,
}

/// The files of a solve, named as `--json` names them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ResultFiles {
    /// The plan, node by node; where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trajectory: Option<PathBuf>,
    /// The outcome and everything else about the plan.
    pub solution: PathBuf,
    /// Figure of the base's attitude and rates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub attitude: Option<PathBuf>,
    /// Figure of the joints.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joints: Option<PathBuf>,
    /// The interactive page.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub report: Option<PathBuf>,
}

/// The figure of the base.
pub const ATTITUDE_FILE: &str = "attitude.svg";
/// The figure of the joints.
pub const JOINTS_FILE: &str = "joints.svg";
/// The interactive page.
pub const REPORT_FILE: &str = "report.html";
/// What the plan's motion costs.
pub const POWER_FILE: &str = "power.json";
/// The figure of it.
pub const POWER_FIGURE_FILE: &str = "power.svg";

/// Everything that belongs to a plan.
const ALL: [&str; 7] = [
    TRAJECTORY_FILE,
    SOLUTION_FILE,
    ATTITUDE_FILE,
    JOINTS_FILE,
    REPORT_FILE,
    POWER_FILE,
    POWER_FIGURE_FILE,
];

impl ResultFiles {
    /// Those that there are, in the order they are listed to a reader.
    pub fn paths(&self) -> Vec<PathBuf> {
        let Self { trajectory, solution, attitude, joints, report } = self;
        let figures = [attitude, joints, report].map(Option::as_ref);
        let files = [trajectory.as_ref(), Some(solution)].into_iter().chain(figures);
        files.flatten().cloned().collect()
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
        match ALL.into_iter().find(|name| folder.join(name).is_dir()) {
            Some(name) => Err(refuse(format!("{name} is a directory"))),
            None => Ok(Self { folder: folder.to_owned() }),
        }
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.folder
    }

    /// Removes an earlier plan, so that a solve without one leaves none that looks like its own.
    pub fn remove_earlier_plan(&self) -> Result<(), Failure> {
        for name in ALL {
            match std::fs::remove_file(self.folder.join(name)) {
                Err(error) if error.kind() != ErrorKind::NotFound => {
                    let problem = format!("{name} cannot be replaced: {}", plain(&error));
                    return Err(Failure::OutputFolder { folder: self.folder.clone(), problem });
                }
                _ => {}
            }
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
