//! Slews and detumbles of free-floating spacecraft.
#![forbid(unsafe_code)]

pub mod error;
pub mod file;
mod files;
pub mod solution;
pub mod trajectory;
pub mod trajectory_csv;
pub mod verification;

pub use error::Error;
pub use solution::{IterationRecord, Solution, Status, Terminal, Timing, Versions};
pub use trajectory::{Interval, Node, Trajectory};
pub use verification::{Check, Sense, Verification};
