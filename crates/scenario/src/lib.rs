//! Scenario, system and wheel files: read, checked, and turned into types that cannot be wrong.
//!
//! A file is parsed twice. [`mod@file`] mirrors the JSON; [`Scenario`], [`SystemDescription`] and
//! [`WheelArray`] are what it means, in SI units and radians, every default filled in. An error names
//! the file, the field, what stands there and what is expected there. What is accepted with an
//! assumption, such as a number that is off by the rounding of printed digits, is said in
//! [`Scenario::notes`], and the resolved file holds what was taken instead.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_scenario::{Maneuver, Scenario};
//!
//! let file = Path::new("../../scenarios/slew_2dof.json");
//! let scenario = Scenario::read(file)?;
//! let Maneuver::Slew(slew) = scenario.maneuver() else { panic!("a slew") };
//! assert!((slew.angle_rad - 20_f64.to_radians()).abs() < 1e-12);
//! assert_eq!(scenario.system().joint_count(), 2);
//!
//! // A variant is checked like a file.
//! let mut changed = scenario.resolved().clone();
//! changed.horizon.steps = 0.0;
//! let refused = Scenario::from_file(changed, file).unwrap_err();
//! assert!(refused.to_string().ends_with(
//!     "horizon.steps: found 0, expected a whole number from 1 to 100000"
//! ));
//! # Ok::<(), righting_scenario::Error>(())
//! ```
#![forbid(unsafe_code)]

pub mod bodies;
pub mod collision;
pub mod drive;
mod end;
pub mod environment;
pub mod error;
pub mod file;
pub mod file_io;
pub mod file_kind;
pub mod halton;
mod horizon;
pub mod ignored_pairs;
mod inertias;
pub mod initial;
pub mod joint_limits;
mod jointed_bodies;
pub mod json;
mod load_limits;
mod maneuver;
mod model_error;
pub mod names;
pub mod pointing;
mod robustness;
mod rounding;
mod rows;
pub mod scenario;
pub mod schema;
mod solver_settings;
mod start_clearance;
mod start_limits;
mod start_loads;
pub mod system_description;
mod system_file;
pub mod system_or_scenario;
mod system_reference;
mod units;
mod urdf;
mod waypoints;
mod weights;
pub mod wheels;

pub use collision::CollisionModel;
pub use drive::Drive;
pub use environment::Environment;
pub use error::Error;
pub use file_kind::FileKind;
pub use initial::Initial;
pub use joint_limits::JointLimits;
pub use load_limits::LoadLimits;
pub use names::Names;
pub use pointing::{ConeSide, Direction, Pointing};
pub use robustness::Robustness;
pub use scenario::{Horizon, Maneuver, Scenario, Slew, SolverSettings, Weights};
pub use system_description::SystemDescription;
pub use system_file::SystemFile;
pub use system_or_scenario::SystemOrScenario;
pub use urdf::import_urdf;
pub use waypoints::{Leg, Waypoint};
pub use wheels::WheelArray;
