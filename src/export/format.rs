//! The formats of `righting export`.

use clap::ValueEnum;

use crate::output_folder as files;

/// What a plan is written as. `--help` lists these with their usual files.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// The system as URDF, its root link the base: system.urdf.
    Urdf,
    /// The system as MJCF for MuJoCo, the base on a free joint, the plan's ends as key frames:
    /// system.xml.
    Mjcf,
    /// The joints' motion as ROS 2's trajectory_msgs/JointTrajectory: joint_trajectory.yaml, or JSON
    /// where FILE ends in .json.
    JointTrajectory,
    /// CCSDS Attitude Ephemeris Message, version 2.0, keyword = value: attitude.aem.
    Aem,
    /// NumPy archive, one array a group of columns: trajectory.npz.
    Npz,
}

impl Format {
    /// Name of the usual file.
    pub fn file(self) -> &'static str {
        match self {
            Self::Urdf => files::URDF_FILE,
            Self::Mjcf => files::MJCF_FILE,
            Self::JointTrajectory => files::JOINT_TRAJECTORY_FILE,
            Self::Aem => files::AEM_FILE,
            Self::Npz => files::NPZ_FILE,
        }
    }
}
