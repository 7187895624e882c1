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
    /// SPICE kernels of attitude, clock and frame: attitude.bc, .tsc and .tf.
    Ck,
    /// STK attitude file: attitude.a.
    Stk,
    /// CCSDS Attitude Ephemeris Message, version 2.0, keyword = value: attitude.aem.
    Aem,
    /// NumPy archive, one array a group of columns: trajectory.npz.
    Npz,
    /// MATLAB file of level 5, one matrix a group of columns: trajectory.mat.
    Mat,
    /// The plan of a slew with gains that correct it on the way, NumPy archive, or a table where FILE ends in .csv:
    /// gains.npz.
    Gains,
    /// Python script that flies the plan in Basilisk by its torques alone: fly_basilisk.py.
    Basilisk,
    /// Python script that flies the plan in MuJoCo by its torques alone: fly_mujoco.py.
    Mujoco,
}

impl Format {
    /// Name of the usual file.
    pub fn file(self) -> &'static str {
        match self {
            Self::Urdf => files::URDF_FILE,
            Self::Mjcf => files::MJCF_FILE,
            Self::JointTrajectory => files::JOINT_TRAJECTORY_FILE,
            Self::Ck => files::CK_FILE,
            Self::Stk => files::STK_FILE,
            Self::Aem => files::AEM_FILE,
            Self::Npz => files::NPZ_FILE,
            Self::Mat => files::MAT_FILE,
            Self::Gains => files::GAINS_FILE,
            Self::Basilisk => files::BASILISK_FILE,
            Self::Mujoco => files::MUJOCO_FILE,
        }
    }
}
