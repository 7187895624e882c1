//! Free-floating base and chain of revolute joints.
#![forbid(unsafe_code)]

mod algebra;
mod attitude;
mod chain;
mod distance;
mod dynamics;
mod error;
mod inertia;
mod inverse_dynamics;
mod kinematics;
mod momentum;
mod state;
mod symmetric;
mod system;

pub use attitude::Quaternion;
pub use distance::Segment;
pub use dynamics::BaseAcceleration;
pub use error::{ModelError, Part};
pub use inverse_dynamics::InverseDynamics;
pub use kinematics::{Frame, Kinematics};
pub use momentum::MomentumMap;
pub use state::State;
pub use system::{Base, DhConvention, Link, Mount, Payload, System};
