//! Free-floating base and chain of revolute joints.
#![forbid(unsafe_code)]

mod algebra;
mod attitude;
mod chain;
mod clearance;
mod composite;
mod coupling;
mod distance;
mod dynamics;
mod error;
mod inertia;
mod inverse_dynamics;
mod kinematics;
mod momentum;
mod momentum_map;
mod state;
mod sweep;
mod symmetric;
mod system;
mod turn;

pub use attitude::Quaternion;
pub use distance::Segment;
pub use dynamics::BaseAcceleration;
pub use error::{ModelError, Part};
pub use inverse_dynamics::InverseDynamics;
pub use kinematics::{Frame, Kinematics};
pub use momentum_map::MomentumMap;
pub use state::State;
pub use system::{Base, DhConvention, Link, Mount, Payload, System};
