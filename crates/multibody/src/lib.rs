//! Free-floating base and chain of revolute joints.
#![forbid(unsafe_code)]

mod chain;
mod error;
mod inertia;
mod system;

pub use error::{ModelError, Part};
pub use system::{Base, DhConvention, Link, Mount, Payload, System};
