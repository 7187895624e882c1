//! What an arm can do, before and after a plan.
//!
//! - [`envelope`]: all momenta and torques that the arm can give, beside reaction wheels;
//! - [`detumble`]: the least angular rate that momentum leaves with the arm at rest;
//! - [`holonomy`]: how the arm turns the base when there is no momentum;
//! - [`power`]: torques of a plan's joints, and the power they draw;
//! - [`histories`]: momentum and clearances along a plan.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_analysis::detumble::rate_bound_rad_s;
//! use righting_scenario::Scenario;
//!
//! let scenario = Scenario::read(Path::new("../../scenarios/detumble_2dof.json"))?;
//! let bound_deg_s = rate_bound_rad_s(&scenario).to_degrees();
//! assert!((bound_deg_s - 11.1).abs() < 0.1);
//! # Ok::<(), righting_scenario::Error>(())
//! ```
#![forbid(unsafe_code)]

pub mod detumble;
pub mod envelope;
pub mod histories;
pub mod holonomy;
pub mod hull;
pub mod power;
pub mod zonotope;

pub use envelope::{Envelope, Envelopes, envelopes};
pub use histories::Histories;
pub use power::PowerProfile;
pub use zonotope::Zonotope;
