//! Robots from URDF files, checked and put together as free-floating systems.
//!
//! A file is read twice. [`Robot`] is what it describes: links that joints connect to one tree. A
//! [`System`] is what flies: a base, and the bodies that joints move, with everything that is held
//! together merged into one body.
//!
//! **Any link can be the base.** A joint of the file places its child's frame in its parent's,
//!
//! ```text
//! T(q) = T₀ · M(a, q),    M: turn about the axis a, or move along it
//! ```
//!
//! Passed the other way it places the parent in the child, T(q)⁻¹ = M(−a, q) · T₀⁻¹: a joint in the
//! child's origin about the opposite axis with the same coordinate, which moves a frame in which the
//! parent sits at T₀⁻¹. So limits and names stay, and the parent's mass, shapes and other joints are
//! carried over by T₀⁻¹.
//!
//! **What is held is merged.** Fixed joints, locked ones, those that mimic others and those off the way
//! to a tip leave one body, with the mass, center of mass and inertia of the whole.
//!
//! ```
//! use righting_import::{ReadOptions, Options, Robot};
//!
//! let urdf = r#"<robot name="two">
//!   <link name="bus"><inertial><mass value="100"/>
//!     <inertia ixx="9" iyy="8" izz="7" ixy="0" ixz="0" iyz="0"/></inertial></link>
//!   <link name="boom"><inertial><origin xyz="0 0 1"/><mass value="5"/>
//!     <inertia ixx="2" iyy="2" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
//!   <joint name="hinge" type="revolute"><parent link="bus"/><child link="boom"/>
//!     <origin xyz="0 0 0.5"/><axis xyz="1 0 0"/>
//!     <limit lower="-3" upper="3" velocity="0.5" effort="20"/></joint>
//! </robot>"#;
//! let robot = Robot::from_urdf(urdf, &ReadOptions::default())?;
//! assert_eq!(robot.system(&Options::floating("bus"))?.bodies[0].name, "boom");
//!
//! // The boom floats, and the hinge turns the bus.
//! let system = robot.system(&Options::floating("boom"))?;
//! assert_eq!(system.bodies[0].name, "bus");
//! assert_eq!(system.bodies[0].body.center_of_mass_m.z, -0.5);
//! assert_eq!(system.bodies[0].joint.axis.x, -1.0);
//! # Ok::<(), righting_import::ImportError>(())
//! ```
//!
//! What the file does not say, or says in a way that bodies cannot have, is refused with its line, or
//! taken with an assumption that [`System::notes`] gives.
#![forbid(unsafe_code)]

mod bounding_capsule;
mod document;
mod error;
mod held;
mod mesh;
mod notes;
mod options;
mod outward;
mod robot;
mod shape;
mod system;
mod tree;
mod units;
mod urdf;

pub use error::{ImportError, OptionName, Place};
pub use options::{BaseOption, Options};
pub use robot::Robot;
pub use shape::{Capsule, Cuboid, Shape};
pub use system::{Body, MovingJoint, System};
pub use urdf::ReadOptions;
