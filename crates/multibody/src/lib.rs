//! Free-floating base and the tree of joints on it, which turn or slide.
//!
//! A base body 0 carries bodies on joints q ∈ R^j, revolute or prismatic; no force acts from outside. With r_i,
//! r_CM the centres of mass of bodies and system from the body-frame origin, in body axes, and a
//! prime for the derivative seen from the body frame, the angular momentum about the system's centre
//! of mass is (Bhundiya, Soval, Albee 2026, equations 2 to 4)
//!
//! ```text
//! H  = Ĩ ω + H̃
//! Ĩ  = Σ I_i − Σ m_i [r_i − r_CM]× [r_i]×
//! H̃  = Σ I_i ω_{i/B} + Σ m_i (r_i − r_CM) × r'_i
//! ```
//!
//! and both momenta are conserved: M R̈_CM = 0, dH/dt + ω × H = 0. Two forms of the motion follow.
//!
//! | form | state | this crate |
//! | --- | --- | --- |
//! | full | x = [r, q_BN, ṙ, ω, q, q̇] ∈ R^{13+2j}, u = q̈ | [`System::state_derivative`] |
//! | reduced | [q_BN, q, q̇] ∈ R^{4+2j}: h₀ = C(q_BN) H is known, so ω = Ĩ⁻¹(C(q_BN)ᵀ h₀ − H̃) | [`System::reduced_angular_rate`], [`Quaternion::rate`] |
//!
//! Beside them: momenta and centre of mass, [`System::joint_torques`], kinetic energy, where every
//! link is ([`System::kinematics`]), and how far links are from each other and from the base.
//!
//! ```
//! use nalgebra::Vector3;
//! use righting_multibody::{Base, DhConvention, Link, Mount, Quaternion, System};
//! use std::f64::consts::FRAC_PI_2;
//!
//! // A 1 m rod on a pan-tilt joint, on top of a 300 kg cube.
//! let arm = System::new(
//!     Base::uniform_cube(300.0, 0.5)?,
//!     Mount::at(Vector3::new(0.0, 0.0, 0.25)),
//!     DhConvention::Standard,
//!     vec![
//!         Link::rod(0.0, 0.0, -FRAC_PI_2, 0.0, 0.0),
//!         Link::rod(25.0, 1.0, 0.0, 0.0, -FRAC_PI_2),
//!     ],
//!     None,
//! )?;
//!
//! // At rest as a whole, the base turns against the arm.
//! let (q, qdot) = ([0.0, 0.0], [0.0, 0.2]);
//! let omega = arm.reduced_angular_rate(&q, &qdot, &Vector3::zeros());
//! assert!(omega.y < 0.0);
//! let momentum = arm.angular_momentum(&omega, &q, &qdot);
//! assert!(momentum.norm() < 1e-15);
//! let attitude_rate = Quaternion::identity().rate(&omega);
//! assert_eq!(attitude_rate.vector, omega * 0.5);
//! # Ok::<(), righting_multibody::ModelError>(())
//! ```
//!
//! # Conventions
//! SI units and radians: of a joint that slides, everything that is said of angles and torques holds for
//! its travel (m) and force (N). The body frame's origin is wherever the base's centre of mass is given from, by
//! default that itself. Quaternions are
//! scalar first, multiply by Hamilton's rule and turn body vectors into inertial ones; ω is in body
//! axes, r and ṙ are inertial. See [`DhConvention`] for rows of parameters, [`JointedBody`] for trees. Everything is generic over
//! [`Scalar`](righting_scalar::Scalar): numbers, dual numbers and expressions run the same code,
//! which therefore never compares what depends on a coordinate.
//!
//! # Operations
//! A planner evaluates these functions and their derivatives thousands of times an iteration, so
//! their operations were counted as traced expressions, constants folded and common parts shared:
//! value alone, and value with Jacobian and Hessian, of the seven-joint arm with Craig's parameters.
//!
//! | choice | for | operations |
//! | --- | --- | --- |
//! | moments gathered tip to base in link axes, where bodies are constants | Ĩ ω + H̃ | 228, 2 194 |
//! | the same in body axes | | 431, 6 213 |
//! | L D Lᵀ for Ĩ⁻¹ | ω | 242, 4 632 |
//! | the adjugate | | 255, 5 083 |
//! | sweep ended at the first joint where the base is symmetric about it | ω | 227, 4 131 |
//! | neighbours with parallel axes turned one by one, not as a group | | 255, 4 798 |
//! | Newton-Euler on barycentric moments | ω̇ | 465, 9 055 |
//! | momentum differentiated along the motion | | 608, 13 313 |
//! | links seen from the outer link | all distances | 270, 3 201 |
//! | links in body axes | | 464, 13 601 |
//!
//! What is built now: ω 222 and 3 998, q̇_BN 283 and 6 009, ω̇ 460 and 9 029, distances 256 and 2 962.
#![forbid(unsafe_code)]

mod algebra;
mod attitude;
mod bodies;
mod branches;
mod clearance;
mod composite;
mod core;
mod coupling;
mod cuboid;
mod distance;
mod dynamics;
mod error;
mod external;
mod inertia;
mod inverse_dynamics;
mod jointed_body;
mod kinematics;
mod mass_factors;
mod momentum;
mod momentum_map;
mod nearest_inertia;
mod parts;
mod roll_pitch_yaw;
mod rows;
mod slide;
mod state;
mod sweep;
mod symmetric;
mod system;
mod tree;
mod tree_of_bodies;
mod turn;
mod units;

pub use attitude::Quaternion;
pub use bodies::{HingedBody, Placement, RigidBody};
pub use core::Core;
pub use cuboid::Cuboid;
pub use distance::Segment;
pub use dynamics::BaseAcceleration;
pub use error::{ModelError, Part};
pub use external::{External, GravityGradient};
pub use inverse_dynamics::InverseDynamics;
pub use jointed_body::{BodyJoint, JointKind, JointedBody};
pub use kinematics::{Frame, Kinematics};
pub use mass_factors::MassFactors;
pub use momentum_map::MomentumMap;
pub use nearest_inertia::nearest_inertia;
pub use parts::{Base, DhConvention, InertialFrame, Link, Mount, Payload};
pub use rows::Rows;
pub use state::State;
pub use system::System;
pub use units::Units;
