//! Which rotations of its base an arm can make, and how fast.
//!
//! With no momentum, the base's rate follows from the joints' alone,
//!
//! ```text
//! ω = A(q) q̇,        A = −Ĩ⁻¹ ∂H̃/∂q̇,        Ṙ = R [ω]×
//! ```
//!
//! so a path of the arm carries the base's attitude along as a connection over joint space carries it. What
//! is possible follows from A alone, which is a pure number, radians of the base a radian of a joint:
//! nothing here depends on units, and with other body axes every vector just turns along.
//!
//! **About which axes** ([`TurnableAxes`]). Along any path R is a product of small rotations about the
//! columns A_i(q). It stays in the group whose Lie algebra those columns and their brackets (in so(3): cross
//! products) span over all postures. so(3) has no subalgebra of two dimensions, so there are three cases:
//!
//! - all A_i vanish: the arm turns nothing;
//! - all A_i are parallel to one fixed axis: the base turns about that axis only. An arm with parallel
//!   joints, moving in the base's plane of symmetry, is one;
//! - they span two dimensions or more, and with their cross products all three.
//!
//! In the third case closed loops decide. They turn the base by the holonomy of the connection, whose
//! algebra the curvature spans, carried along from every posture (Ambrose & Singer, *Trans. AMS* 75, 1953):
//!
//! ```text
//! F_ij = ∂A_j/∂q_i − ∂A_i/∂q_j + A_i × A_j
//! ```
//!
//! A loop that encloses the area α in the plane of joints i and j turns the base by α F_ij, to second order
//! in its size (the area rule: Shapere & Wilczek, *J. Fluid Mech.* 198, 1989).
//!
//! **One joint** encloses no area: its attitudes are a curve, which [`SingleJoint`] follows from end to end.
//!
//! **How fast** ([`TurnRates`]). Some loops, the same every time, are followed; the singular values of their
//! rotation vectors say how far a loop turns the base about three principal axes. Timed at the joints'
//! limits they give degrees per second, and with some straight motions, since a slew's arm may end
//! anywhere, a first estimate of the time that an angle takes.
//!
//! ```
//! use std::path::Path;
//!
//! use righting_analysis::holonomy::{TurnRates, TurnableAxes};
//! use righting_scenario::Scenario;
//!
//! let scenario = Scenario::read(Path::new("../../scenarios/slew_4dof.json"))?;
//! let axes = TurnableAxes::new(scenario.system());
//! assert_eq!(axes.rank(), 3);
//! let rates = TurnRates::new(scenario.system(), &scenario.initial().joint_angles_rad);
//! assert!(rates.rates_rad_s[0] >= rates.rates_rad_s[2]);
//! # Ok::<(), righting_scenario::Error>(())
//! ```

mod connection;
mod motions;
mod single_joint;
mod transport;
mod turn_rates;
mod turnable;

pub use connection::{Curvature, connection};
pub use single_joint::SingleJoint;
pub use turn_rates::TurnRates;
pub use turnable::TurnableAxes;
pub(crate) use turnable::off_axis_rad;
