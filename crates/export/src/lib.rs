//! Plans and systems in the formats of other programs.
//!
//! Every function takes what a plan's folder holds and returns the text or the bytes of one file;
//! nothing here writes any.
//!
//! ```no_run
//! use std::path::Path;
//!
//! let folder = Path::new("out/demo");
//! let trajectory = righting_results::Trajectory::read_csv(&folder.join("trajectory.csv"))?;
//! std::fs::write("demo.npz", righting_export::npz(&trajectory)?)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod aem;
mod arm;
mod attitude;
mod ck;
mod columns;
mod daf;
mod defaults;
mod error;
mod flight;
mod gains;
mod joint_trajectory;
mod mat;
mod mjcf;
mod npz;
mod stk;
mod time_scales;
mod urdf;
mod xml;

pub use aem::{AemOptions, aem};
pub use ck::{CkOptions, SpiceKernels, ck};
pub use error::ExportError;
pub use flight::{basilisk, mujoco};
pub use gains::PlannedGains;
pub use joint_trajectory::JointTrajectory;
pub use mat::mat;
pub use mjcf::mjcf;
pub use npz::npz;
pub use stk::{StkOptions, stk};
pub use urdf::urdf;
