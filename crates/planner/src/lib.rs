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
//! [`plan`] makes a trajectory of a scenario; `righting-verifier` checks it by other means.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_ocp::Control;
//! use righting_planner::plan;
//! use righting_results::Terminal;
//! use righting_scenario::Scenario;
//! use righting_verifier::verify;
//!
//! let scenario = Scenario::read(Path::new("../../scenarios/slew_2dof.json"))?;
//! let plan = plan(&scenario, &mut |_| Control::Continue)?;
//! assert!(verify(&scenario, &plan.trajectory).passed);
//! assert!(Terminal::reached(&scenario, &plan.trajectory).attitude_error <= 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

mod formulation;
pub mod library;
mod open_ways;
pub mod planner;
pub mod reach;
mod search;
pub mod sparsity;
mod starts;
mod symmetry;

pub use formulation::FormulatedManeuver;
pub use library::Library;
pub use planner::{Plan, PlanError, PlanTiming, plan, plan_from, plan_with_threads};
pub use reach::{Reach, ReachError, ReachSettings, reach};
