//! What attitude files say beyond the plan.

use clap::Args;
use jiff::civil::DateTime;
use righting_export::{AemOptions, CkOptions, StkOptions};

use super::format::Format;
use crate::failure::Failure;

/// Epoch, frames and names.
#[derive(Args, Clone)]
pub struct Message {
    /// AEM, STK, CK: time of the first node, such as 2027-03-01T12:00:00; 2000-01-01T12:00:00 if not
    /// given.
    #[arg(long, value_name = "TIME", value_parser = epoch)]
    epoch: Option<DateTime>,
    /// AEM, CK: the time system of the epoch, UTC if not given; no leap second is expected within the
    /// maneuver. CK takes UTC, TAI, GPS, TT and TDB.
    #[arg(long, value_name = "NAME")]
    time_system: Option<String>,
    /// AEM, STK, CK: the inertial frame that the scenario's inertial axes are; EME2000 if not given.
    #[arg(long, value_name = "NAME")]
    frame: Option<String>,
    /// AEM, CK: name of the spacecraft; the system's if not given.
    #[arg(long, value_name = "NAME")]
    object_name: Option<String>,
    /// AEM: international designator of the spacecraft; UNKNOWN if not given.
    #[arg(long, value_name = "ID")]
    object_id: Option<String>,
    /// AEM: who sends the message; RIGHTING if not given.
    #[arg(long, value_name = "NAME")]
    originator: Option<String>,
    /// CK: NAIF's number of the spacecraft, below zero; -999 if not given.
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true)]
    naif_id: Option<i32>,
}

impl Message {
    /// Options that the format's file has no place for are no options.
    pub fn refuse_unless_taken(&self, format: Format) -> Result<(), Failure> {
        let time_and_frame = self.epoch.is_some() || self.frame.is_some();
        let sender = self.object_id.is_some() || self.originator.is_some();
        let named = self.object_name.is_some();
        let (is_taken, refusal) = match format {
            Format::Aem => (self.naif_id.is_none(), "--format aem: a message has no NAIF ID"),
            Format::Stk => (
                !(named || sender || self.time_system.is_some() || self.naif_id.is_some()),
                "--format stk: an attitude file has an epoch in UTC and a frame, and no names",
            ),
            Format::Ck => (!sender, "--format ck: kernels have no designator and no originator"),
            _ => (
                !(time_and_frame
                    || named
                    || sender
                    || self.time_system.is_some()
                    || self.naif_id.is_some()),
                "this format holds the plan alone, no epoch, frame or names: they go with \
                 --format aem, stk and ck",
            ),
        };
        if is_taken { Ok(()) } else { Err(Failure::Usage(refusal)) }
    }

    pub fn of_aem(self, maneuver: String, system: &str) -> AemOptions {
        let usual = AemOptions::new(maneuver, system);
        AemOptions {
            epoch: self.epoch.unwrap_or(usual.epoch),
            originator: self.originator.unwrap_or(usual.originator),
            object_name: self.object_name.unwrap_or(usual.object_name),
            object_id: self.object_id.unwrap_or(usual.object_id),
            inertial_frame: self.frame.unwrap_or(usual.inertial_frame),
            time_system: self.time_system.unwrap_or(usual.time_system),
            ..usual
        }
    }

    pub fn of_stk(self, maneuver: String) -> StkOptions {
        let usual = StkOptions::new(maneuver);
        StkOptions {
            epoch: self.epoch.unwrap_or(usual.epoch),
            inertial_frame: self.frame.unwrap_or(usual.inertial_frame),
            ..usual
        }
    }

    pub fn of_ck(self, maneuver: String, system: &str) -> CkOptions {
        let usual = CkOptions::new(maneuver, system);
        CkOptions {
            epoch: self.epoch.unwrap_or(usual.epoch),
            time_system: self.time_system.unwrap_or(usual.time_system),
            inertial_frame: self.frame.unwrap_or(usual.inertial_frame),
            object_name: self.object_name.unwrap_or(usual.object_name),
            naif_id: self.naif_id.unwrap_or(usual.naif_id),
            ..usual
        }
    }
}

/// A civil time; a closing Z, which the format allows for UTC, is taken.
fn epoch(text: &str) -> Result<DateTime, String> {
    let text = text.strip_suffix('Z').unwrap_or(text);
    text.parse().map_err(|_| "expected a time such as 2027-03-01T12:00:00".to_owned())
}
