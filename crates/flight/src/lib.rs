//! Plans flown with a plant that is not as planned.
//!
//! A [`Campaign`] is one plan flown many times. Each flight draws its own [`plant`](Plant): the verifier's model
//! of the same spacecraft with other masses, inertias and centers of mass ([`Spreads`]). The joints follow the
//! accelerations that they are told; the base turns as the plant's momentum has it. A flight is flown open
//! loop, and again with what is done about it ([`Control`]): the plan's gains correct every step, or the rest of the
//! maneuver is planned anew every [`period`](Settings::period_s), from what noisy [`Sensors`] measure.
//!
//! Flight i draws from stream i of one generator (ChaCha8), so it is the same whatever the number of flights
//! and cores; only the times that replans take differ.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_flight::{Campaign, Settings};
//! use righting_ocp::Control;
//! use righting_planner::Planner;
//! use righting_scenario::Scenario;
//!
//! let scenario = Scenario::read(Path::new("../../scenarios/slew_2dof.json"))?;
//! let planned = Planner::new().plan(&scenario, &mut |_| Control::Continue)?;
//! let settings = Settings { period_s: 5.0, ..Settings::default() };
//! let flight = Campaign::new(&scenario, &planned.trajectory, settings)?.flight(0);
//! assert!(flight.flown.error_rad < flight.open_loop.unwrap().error_rad);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod campaign;
mod conversation;
mod end;
mod faults;
mod flight;
mod guidance;
mod joint_drives;
mod plant;
mod recording;
mod sensors;
mod settings;
mod spreads;
mod summary;

pub use campaign::Campaign;
pub use conversation::{ConversationError, fly_with};
pub use end::End;
pub use faults::Faults;
pub use flight::Flight;
pub use guidance::{Guidance, Log};
pub use joint_drives::{JointDrives, Stuck};
pub use plant::Plant;
pub use recording::{Recording, RecordingError};
pub use sensors::Sensors;
pub use settings::{Control, Settings};
pub use spreads::Spreads;
pub use summary::{Distribution, Latency, Summary};
