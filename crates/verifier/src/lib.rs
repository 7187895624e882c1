//! The independent check of a trajectory.
//!
//! Nothing here comes from the planner. What a plan is measured by is read from the resolved scenario
//! file; masses, momenta, motion, torques and distances come from a [second model](model) that shares
//! no equation with the planner's; the motion is followed by an integrator with its own error control
//! (Dormand and Prince's, to 1e-11) in all 13 + 2j states, with only the first node and the controls
//! of the trajectory as its input. What that second integration finds is compared with every node,
//! and it, not the nodes, decides whether the maneuver does what was asked. Limits are looked at on
//! the nodes and, on the second integration, between them.
//!
//! Shared with the planner are the file's types and the check of its values, the horizon's times, and
//! the trajectory itself.
//!
//! Tolerances are part of every [`Check`](righting_results::Check) and so of every report:
//!
//! - limits hold to 1e-6 (rad, rad/s, rad/s², rad/s³, m) at the nodes; between nodes joint angles and
//!   clearances to 1e-3. Clearances are looked at as closely as the motion asks for: nothing is
//!   missed between two places, however fast two links pass each other;
//! - boresights stay on their side of their cones to 1e-4 rad at the nodes, as far as the attitude may be off,
//!   and to 1e-3 rad between them, whatever the base may do there at the rate at which it turns;
//! - the plan's own integration error, one step of a fourth-order method an interval, may reach
//!   1e-4 rad in attitude, a twentieth of what a slew may miss its target by. In momentum that is
//!   1e-4 of its size, in the quaternion's length 1e-5. A plan that fails here needs more steps;
//! - where a joint's jerk is limited, accelerations jump by no more than 1e-6 rad/s² from one interval to the
//!   next, and begin and end within that of zero;
//! - joints follow from the controls exactly, so they may differ by what a solver leaves of its
//!   equations: 1e-6 rad and rad/s. Where the posture at the end is given, they end there to 1e-4 rad.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_results::{ControlInterval, Node, Trajectory};
//! use righting_scenario::Scenario;
//! use righting_verifier::verify;
//!
//! // To do nothing is a motion by the laws of mechanics, and no slew.
//! let scenario = Scenario::read(Path::new("../../scenarios/slew_2dof.json"))?;
//! let steps = scenario.horizon().steps;
//! let node = |k| Node {
//!     time_s: scenario.horizon().time_s(k),
//!     position_m: [0.0; 3],
//!     attitude: [1.0, 0.0, 0.0, 0.0],
//!     velocity_m_s: [0.0; 3],
//!     angular_rate_rad_s: [0.0; 3],
//!     joint_angles_rad: vec![0.0; 2],
//!     joint_rates_rad_s: vec![0.0; 2],
//!     power_w: 0.0,
//!     wheel_momenta_n_m_s: Vec::new(),
//! };
//! let idle = ControlInterval {
//!     joint_accelerations_rad_s2: vec![0.0; 2],
//!     joint_jerks_rad_s3: Vec::new(),
//!     joint_torques_n_m: vec![0.0; 2],
//!     wheel_torques_n_m: Vec::new(),
//! };
//! let trajectory = Trajectory::new((0..=steps).map(node).collect(), vec![idle; steps])?;
//! let verification = verify(&scenario, &trajectory);
//! let failed: Vec<&str> = verification.failures().map(|check| check.name.as_str()).collect();
//! assert_eq!(failed, ["attitude error at the end"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]

mod bodies;
mod clearances;
mod closest_approach;
mod directory;
mod dormand_prince;
mod goal;
mod jerk;
mod joints;
mod ledger;
mod limits;
mod lineage;
mod loads;
pub mod model;
mod momentum;
mod motion_bound;
mod pointing;
mod posture;
mod requirements;
mod simulation;
mod tolerances;
mod verify;
mod waypoints;
mod wheels;
mod worst_of_joints;

pub use directory::{Verified, verify_directory};
pub use dormand_prince::DormandPrince;
pub use tolerances::at_rest_deg_s;
pub use verify::{
    ATTITUDE_ERROR, DETUMBLE_AT_REST, SLEW_AT_REST_DEG_S, TRADED_DETUMBLE_AT_REST, simulate, verify,
};
