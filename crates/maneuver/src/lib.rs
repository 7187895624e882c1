//! Slews and detumbles of free-floating spacecraft.
#![forbid(unsafe_code)]

pub mod collision;
pub mod detumble;
pub mod error;
pub mod file;
mod files;
mod formulation;
mod halton;
pub mod initial;
mod json;
mod outcome;
pub mod planner;
pub mod scenario;
pub mod schema;
pub mod solution;
mod starts;
pub mod system_description;
pub mod trajectory;
pub mod trajectory_csv;
pub mod verification;
pub mod verifier;

pub use collision::CollisionModel;
pub use error::Error;
pub use initial::Initial;
pub use outcome::objective;
pub use planner::{Plan, PlanError, PlanTiming, plan};
pub use scenario::{Horizon, Maneuver, Scenario, Slew, SolverSettings, Weights};
pub use solution::{IterationRecord, Solution, Status, Terminal, Timing, Versions};
pub use system_description::{JointLimits, SystemDescription};
pub use trajectory::{Interval, Node, Trajectory};
pub use verification::{Check, Sense, Verification};
pub use verifier::{Verified, verify, verify_directory};
