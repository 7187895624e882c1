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
//! A [`Planner`] makes a plan of a scenario and has it verified.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_ocp::Control;
//! use righting_planner::Planner;
//! use righting_scenario::Scenario;
//!
//! let scenario = Scenario::read(Path::new("../../scenarios/slew_2dof.json"))?;
//! let planned = Planner::new().plan(&scenario, &mut |_| Control::Continue)?;
//! assert!(planned.solution.verification.passed);
//! assert!(planned.solution.terminal.attitude_error <= 1e-3);
//! assert_eq!(planned.trajectory.steps(), 600);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod between_nodes;
pub mod delivered;
mod feedback;
mod formulation;
mod hints;
mod initial_guess;
pub mod library;
mod mass_estimate;
mod measured;
mod planned;
pub mod planner;
pub mod reach;
mod remedies;
pub mod replanner;
mod scaling;
mod search;
mod sequence;
pub mod sparsity;
mod spin;
mod symmetry;

pub use feedback::Feedback;
pub use formulation::FormulatedManeuver;
pub use library::PlanLibrary;
pub use mass_estimate::MassEstimate;
pub use measured::{Measured, Measurement};
pub use planned::Planned;
pub use planner::{PlanError, Planner};
pub use reach::{Reach, ReachError, ReachSettings, reach};
pub use replanner::{Replan, Replanner};
