//! Attitude files of STK (`.a`): quaternions and angular rates.

use std::fmt::Write;

use jiff::civil::DateTime;
use righting_results::{Solution, Trajectory};

use crate::ExportError;
use crate::attitude::{numbers, plain, value};
use crate::defaults::{DEFAULT_EPOCH, DEFAULT_FRAME};

/// What an attitude file says beyond the trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct StkOptions {
    /// What the maneuver is, in words.
    pub maneuver: String,
    /// Time of the first node, UTC.
    pub epoch: DateTime,
    /// The inertial frame that the plan's inertial axes are; EME2000 is called J2000 in the file.
    pub inertial_frame: String,
}

impl StkOptions {
    /// Of a maneuver: in EME2000 from J2000's noon on.
    pub fn new(maneuver: String) -> Self {
        Self { maneuver, epoch: DEFAULT_EPOCH, inertial_frame: DEFAULT_FRAME.to_owned() }
    }
}

/// The attitude and the angular rate at every node as an STK attitude file.
///
/// The quaternion is that of an Attitude Ephemeris Message: from the inertial axes to the body's,
/// scalar last. Rates are in body axes, deg/s.
///
/// # Errors
/// [`ExportError::Value`] for a frame that a line cannot hold.
pub fn stk(
    solution: &Solution,
    trajectory: &Trajectory,
    options: &StkOptions,
) -> Result<String, ExportError> {
    let axes = match value("CoordinateAxes", &options.inertial_frame)?.as_str() {
        "EME2000" => "J2000".to_owned(),
        axes => axes.to_owned(),
    };
    let mut text = String::new();
    let mut line = |arguments: std::fmt::Arguments<'_>| {
        text.write_fmt(arguments).expect("a string takes all that is written to it");
        text.push('\n');
    };
    line(format_args!("stk.v.11.0"));
    line(format_args!("# Planned by Righting {}", plain(&solution.versions.righting)));
    line(format_args!("# {}", plain(&options.maneuver)));
    line(format_args!("# scenario SHA-256 {}", plain(&solution.scenario_sha256)));
    line(format_args!("BEGIN Attitude"));
    line(format_args!("NumberOfAttitudePoints {}", trajectory.nodes().len()));
    line(format_args!("ScenarioEpoch {}", options.epoch.strftime("%-d %b %Y %H:%M:%S.%9f")));
    line(format_args!("CentralBody Earth"));
    line(format_args!("CoordinateAxes {axes}"));
    line(format_args!("AttitudeTimeQuatAngVels"));
    for node in trajectory.nodes() {
        line(format_args!("{:.15e}{}", node.time_s, numbers(node)));
    }
    line(format_args!("END Attitude"));
    Ok(text)
}
