//! Attitude Ephemeris Messages: CCSDS 504.0-B-2, version 2.0, keyword = value notation.
//!
//! The quaternion “from frame A to frame B” is that of the rotation whose images of A's basis vectors
//! are B's (annex F2). With the inertial frame as A and the body as B that is the attitude as this
//! project writes it, body → inertial by Hamilton's product, its scalar moved to the end.

use std::fmt::Write;
use std::time::SystemTime;

use jiff::civil::DateTime;
use jiff::tz::Offset;
use jiff::{SignedDuration, Timestamp};
use righting_results::{Node, Solution, Trajectory};

use crate::ExportError;
use crate::attitude::{numbers, plain, value};
use crate::defaults::{DEFAULT_EPOCH, DEFAULT_FRAME, DEFAULT_TIME_SYSTEM};

/// What a message says beyond the trajectory.
#[derive(Clone, Debug, PartialEq)]
pub struct AemOptions {
    /// What the maneuver is, in words.
    pub maneuver: String,
    /// Time of the first node, in the time system.
    pub epoch: DateTime,
    /// When the message is made, UTC.
    pub creation_date: DateTime,
    /// Who makes it.
    pub originator: String,
    /// Name of the spacecraft.
    pub object_name: String,
    /// Its international designator, or UNKNOWN.
    pub object_id: String,
    /// The inertial frame that the plan's inertial axes are.
    pub inertial_frame: String,
    /// The time system of all time tags.
    pub time_system: String,
}

impl AemOptions {
    /// Of a maneuver of a system: in UTC and EME2000 from J2000's noon on, made now by RIGHTING, for a spacecraft
    /// without a designator.
    pub fn new(maneuver: String, system: &str) -> Self {
        let now = Timestamp::try_from(SystemTime::now()).unwrap_or_default();
        Self {
            maneuver,
            epoch: DEFAULT_EPOCH,
            creation_date: Offset::UTC.to_datetime(now),
            originator: "RIGHTING".to_owned(),
            object_name: system.to_owned(),
            object_id: "UNKNOWN".to_owned(),
            inertial_frame: DEFAULT_FRAME.to_owned(),
            time_system: DEFAULT_TIME_SYSTEM.to_owned(),
        }
    }
}

/// Name of the body frame.
const BODY_FRAME: &str = "SC_BODY_1";
const NANOSECONDS: f64 = 1e9;

/// The attitude and the angular rate at every node as a message.
///
/// # Errors
/// [`ExportError::Value`] for a value that a line cannot hold; [`ExportError::TimeTags`] where nodes
/// are less than a nanosecond apart or leave the calendar.
pub fn aem(
    solution: &Solution,
    trajectory: &Trajectory,
    options: &AemOptions,
) -> Result<String, ExportError> {
    let tags = time_tags(trajectory, options.epoch)?;
    let mut text = String::new();
    let mut line = |arguments: std::fmt::Arguments<'_>| {
        text.write_fmt(arguments).expect("a string takes all that is written to it");
        text.push('\n');
    };
    line(format_args!("CCSDS_AEM_VERS = 2.0"));
    line(format_args!(
        "COMMENT {}",
        plain(&format!("Planned by Righting {}", solution.versions.righting))
    ));
    line(format_args!("COMMENT {}", plain(&options.maneuver)));
    line(format_args!("COMMENT scenario SHA-256 {}", plain(&solution.scenario_sha256)));
    line(format_args!("CREATION_DATE = {:.0}", options.creation_date));
    line(format_args!("ORIGINATOR = {}", value("ORIGINATOR", &options.originator)?));
    line(format_args!(""));
    line(format_args!("META_START"));
    line(format_args!("OBJECT_NAME = {}", value("OBJECT_NAME", &options.object_name)?));
    line(format_args!("OBJECT_ID = {}", value("OBJECT_ID", &options.object_id)?));
    line(format_args!("REF_FRAME_A = {}", value("REF_FRAME_A", &options.inertial_frame)?));
    line(format_args!("REF_FRAME_B = {BODY_FRAME}"));
    line(format_args!("TIME_SYSTEM = {}", value("TIME_SYSTEM", &options.time_system)?));
    line(format_args!("START_TIME = {}", tags[0]));
    line(format_args!("STOP_TIME = {}", tags[tags.len() - 1]));
    line(format_args!("ATTITUDE_TYPE = QUATERNION/ANGVEL"));
    line(format_args!("ANGVEL_FRAME = {BODY_FRAME}"));
    line(format_args!("META_STOP"));
    line(format_args!(""));
    line(format_args!("DATA_START"));
    for (tag, node) in tags.iter().zip(trajectory.nodes()) {
        line(format_args!("{tag}{}", numbers(node)));
    }
    line(format_args!("DATA_STOP"));
    Ok(text)
}

/// The nodes' times, with as few of 3, 6 or 9 decimals as tell them to the nanosecond.
fn time_tags(trajectory: &Trajectory, epoch: DateTime) -> Result<Vec<String>, ExportError> {
    let steps_s = trajectory.nodes().windows(2).map(|pair| pair[1].time_s - pair[0].time_s);
    let refused = || ExportError::TimeTags {
        step_s: steps_s.clone().fold(f64::INFINITY, f64::min),
        epoch: epoch.to_string(),
    };
    let at = |node: &Node| {
        let nanoseconds = (node.time_s * NANOSECONDS).round();
        // Within i64 once within the calendar.
        let offset = SignedDuration::from_nanos(nanoseconds as i64);
        (nanoseconds.abs() < 9e18).then(|| epoch.checked_add(offset).ok()).flatten()
    };
    let times: Option<Vec<DateTime>> = trajectory.nodes().iter().map(at).collect();
    let times = times.ok_or_else(refused)?;
    if times.windows(2).any(|pair| pair[1] <= pair[0]) {
        return Err(refused());
    }
    let multiple_of = |unit: i32| times.iter().all(|time| time.subsec_nanosecond() % unit == 0);
    let decimals = match (multiple_of(1_000_000), multiple_of(1_000)) {
        (true, _) => 3,
        (_, true) => 6,
        _ => 9,
    };
    Ok(times.into_iter().map(|time| format!("{time:.decimals$}")).collect())
}
