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
mod error;
mod joint_trajectory;
mod mjcf;
mod npz;
mod urdf;
mod xml;

pub use aem::{AemOptions, aem};
pub use error::ExportError;
pub use joint_trajectory::JointTrajectory;
pub use mjcf::mjcf;
pub use npz::npz;
pub use urdf::urdf;
