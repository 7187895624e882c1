//! What an arm can do, before and after a plan.
//!
//! - [`abilities`]: about which axes it turns the base, how fast, and how much a detumble gains;
//! - [`explanation`]: the same in numbers, as explain.json holds it, and whether a maneuver is possible;
//! - [`envelope`]: all momenta and torques that the arm can give, beside reaction wheels;
//! - [`detumble`]: the least angular rate that momentum leaves with the arm at rest;
//! - [`holonomy`]: which rotations of the base the arm can make, and how fast;
//! - [`impossible`]: maneuvers that no motion of the arm makes;
//! - [`power`]: torques of a plan's joints, and the power they draw;
//! - [`limited_loads`](mod@limited_loads): torques and loads beside their limits;
//! - [`motors`]: what the motors of a plan's joints draw;
//! - [`wheel_motors`]: what the motors of reaction wheels do along a plan;
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

pub mod abilities;
pub mod detumble;
pub mod envelope;
pub mod explanation;
pub mod histories;
pub mod holonomy;
pub mod hull;
pub mod impossible;
pub mod limited_loads;
pub mod motors;
pub mod power;
pub mod wheel_motors;
pub mod zonotope;

pub use abilities::Abilities;
pub use envelope::{Envelope, Envelopes, envelopes};
pub use explanation::Explanation;
pub use histories::Histories;
pub use impossible::Impossible;
pub use limited_loads::limited_loads;
pub use motors::Motors;
pub use power::PowerProfile;
pub use wheel_motors::WheelMotors;
pub use zonotope::Zonotope;
