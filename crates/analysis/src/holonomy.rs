//! How an arm without momentum turns its base.
//!
//! With no momentum, the base's rate follows from the joints' alone, so attitudes are carried along paths
//! of the arm as a connection A over joint space carries them:
//!
//! ```text
//! ω = A(q) q̇,        A = −Ĩ⁻¹ ∂H̃/∂q̇
//! F_ij = ∂A_j/∂q_i − ∂A_i/∂q_j + A_i × A_j            its curvature
//! ```
//!
//! A loop that encloses the area α in the plane of joints i and j turns the base by α F_ij, to second
//! order in its size (the area rule: Shapere & Wilczek, *J. Fluid Mech.* 198, 1989).

mod connection;

pub use connection::{Curvature, connection};
