//! A plan as it is written down: `trajectory.csv` and `solution.json`.
//!
//! A [`Trajectory`] holds the motion node by node and what the joints do between the nodes. A
//! [`Solution`] holds the whole resolved scenario, how the optimizer ended, what the end reached and the
//! record of the [`Verification`]. Nothing here plans or verifies.
//!
//! ```
//! use righting_results::{Status, Verification};
//!
//! assert!(Status::Acceptable.is_acceptable());
//! assert!(!Verification::default().passed);
//! ```
#![forbid(unsafe_code)]

mod finite_or_null;
mod outcome;
pub mod solution;
pub mod trajectory;
pub mod trajectory_csv;
pub mod verification;

pub use finite_or_null::FiniteOrNull;
pub use outcome::objective;
pub use solution::{
    AttemptRecord, IterationRecord, OptimalityRecord, RobustnessRecord, Solution, Status, Terminal,
    Timing, UsedOptimizer, Versions, WaypointRecord,
};
pub use trajectory::{ControlInterval, Node, Trajectory};
pub use verification::{Check, LimitRecord, Sense, Verification};

/// Name of the file of the trajectory in a result folder.
pub const TRAJECTORY_FILE: &str = "trajectory.csv";
/// Name of the file of everything else.
pub const SOLUTION_FILE: &str = "solution.json";
