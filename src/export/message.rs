//! What attitude files say beyond the plan.

use std::time::SystemTime;

use clap::Args;
use jiff::Timestamp;
use jiff::civil::DateTime;
use jiff::tz::Offset;
use righting_export::AemOptions;

use super::format::Format;
use crate::failure::Failure;

/// Epoch, frames and names.
#[derive(Args, Clone)]
pub struct Message {
    /// AEM: time of the first node, such as 2027-03-01T12:00:00; 2000-01-01T12:00:00 if not
    /// given.
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

impl Message {
    /// Options that the format's file has no place for are no options.
    pub fn refuse_unless_taken(&self, format: Format) -> Result<(), Failure> {
        let is_empty = self.epoch.is_none()
            && self.time_system.is_none()
            && self.frame.is_none()
            && self.object_name.is_none()
            && self.object_id.is_none()
            && self.originator.is_none();
        match is_empty || format == Format::Aem {
            true => Ok(()),
            false => Err(Failure::Usage(
                "this format holds the plan alone, no epoch, frame or names: they go with \
                 --format aem",
            )),
        }
    }

    pub fn of_aem(self, maneuver: String, system: &str) -> AemOptions {
        let now = Timestamp::try_from(SystemTime::now()).unwrap_or_default();
        AemOptions {
            maneuver,
            epoch: self.epoch(),
            creation_date: Offset::UTC.to_datetime(now),
            originator: or(self.originator, "RIGHTING"),
            object_name: or(self.object_name, system),
            object_id: or(self.object_id, "UNKNOWN"),
            inertial_frame: or(self.frame, "EME2000"),
            time_system: or(self.time_system, "UTC"),
        }
    }

    fn epoch(&self) -> DateTime {
        self.epoch.unwrap_or(DateTime::constant(2000, 1, 1, 12, 0, 0, 0))
    }
}

fn or(given: Option<String>, default: &str) -> String {
    given.unwrap_or_else(|| default.to_owned())
}

/// A civil time; a closing Z, which the format allows for UTC, is taken.
fn epoch(text: &str) -> Result<DateTime, String> {
    let text = text.strip_suffix('Z').unwrap_or(text);
    text.parse().map_err(|_| "expected a time such as 2027-03-01T12:00:00".to_owned())
}
