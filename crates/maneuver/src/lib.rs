//! Slews and detumbles of free-floating spacecraft.
//!
//! A base with an arm of j revolute joints floats free: its momentum never changes. Moving the arm
//! turns the base, and the way the arm takes decides by how much. Planned is the cheapest way,
//!
//! ```text
//! min  Σ w_u ‖u_k‖² + ‖e_N‖²_Q        u = q̈ held over each of N intervals
//! s.t. the motion follows from u;  joint angles, rates and accelerations within their limits;
//!      links keep clear of the base and of each other,
//! ```
//!
//! where e_N is what the end misses of the goal: attitude and rest for a slew, rest as far as
//! momentum lets it for a detumble.
//!
//! A [`Scenario`] is read from JSON and cannot be wrong once it exists; [`plan`] makes a
//! [`Trajectory`] of it; [`verify`] integrates that trajectory's controls again with other means and
//! says whether it does what was asked.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_maneuver::{Scenario, Terminal, plan, verify};
//! use righting_ocp::Control;
//!
//! let file = Path::new("../../scenarios/slew_2dof.json");
//! let scenario = Scenario::read(file)?;
//! let plan = plan(&scenario, &mut |_| Control::Continue)?;
//! assert!(verify(&scenario, &plan.trajectory).passed);
//! assert!(Terminal::reached(&scenario, &plan.trajectory).attitude_error <= 1e-3);
//!
//! // A variant is checked like a file.
//! let mut changed = scenario.resolved().clone();
//! changed.horizon.steps = 0.0;
//! let refused = Scenario::from_file(changed, file).unwrap_err();
//! assert!(refused.to_string().ends_with(
//!     "horizon.steps: 0 is not allowed: a whole number from 1 to 100000"
//! ));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

pub mod collision;
pub mod detumble;
mod dormand_prince;
pub mod envelope;
pub mod error;
pub mod file;
pub mod files;
mod finite_or_null;
mod formulation;
mod halton;
pub mod histories;
pub mod hull;
pub mod initial;
pub mod json;
pub mod library;
mod open_ways;
mod outcome;
pub mod planner;
pub mod power;
pub mod reach;
pub mod scenario;
pub mod schema;
mod search;
pub mod solution;
pub mod sparsity;
mod starts;
mod symmetry;
pub mod system_description;
pub mod trajectory;
pub mod trajectory_csv;
pub mod verification;
pub mod verifier;
pub mod wheels;

pub use collision::CollisionModel;
pub use envelope::{Envelope, Envelopes, envelopes};
pub use error::Error;
pub use formulation::FormulatedManeuver;
pub use histories::Histories;
pub use initial::Initial;
pub use library::Library;
pub use outcome::objective;
pub use planner::{Plan, PlanError, PlanTiming, plan, plan_from, plan_with_threads};
pub use power::PowerProfile;
pub use reach::{Reach, ReachError, ReachSettings, reach};
pub use scenario::{Horizon, Maneuver, Scenario, Slew, SolverSettings, Weights};
pub use solution::{IterationRecord, Solution, Status, Terminal, Timing, UsedOptimizer, Versions};
pub use system_description::{JointLimits, SystemDescription};
pub use trajectory::{Interval, Node, Trajectory};
pub use verification::{Check, Sense, Verification};
pub use verifier::{Verified, simulate, verify, verify_directory};
pub use wheels::WheelArray;
