//! Factorisation of Ipopt's augmented system of a multiple-shooting problem, node by node.
//!
//! For the decision vector `z = [x_0, u_0, x_1, u_1, …, x_N, u_N]` (the initial state is left out
//! where it is data), defects `x_{k+1} − F(x_k, u_k) = 0` and constraints of one node each, Ipopt's
//! system
//!
//! ```text
//! ⎡ W + D_x         J_cᵀ   J_dᵀ ⎤   W couples x_k and u_k of one node only;
//! ⎢         D_s            −I   ⎥   a defect's row holds −A_k, −B_k at x_k, u_k and the identity
//! ⎢ J_c            −D_c         ⎥   (or any diagonal) at x_{k+1};
//! ⎣ J_d     −I            −D_d  ⎦   other rows belong to one node.
//! ```
//!
//! is eliminated from the last node to the first. Everything behind node k is a quadratic cost to
//! go in x_{k+1} with Hessian P_{k+1}, so at node k
//!
//! ```text
//! ⎡ M_uu  M_ux ⎤
//! ⎣ M_xu  M_xx ⎦ = W_k + [B A]ᵀ P_{k+1} [B A] + J_kᵀ (σ / (e² + σδ)) J_k ,
//!
//! P_k = M_xx − M_xu M_uu⁻¹ M_ux
//! ```
//!
//! the Riccati recursion (Rao, Wright & Rawlings, *JOTA* 99, 1998), where the last term comes from
//! slacks and multipliers of the inequalities, eliminated in place. The pair of x_{k+1} and its
//! defect multiplier is the pivot `[[P, I], [I, 0]]`, with as many negative eigenvalues as the
//! defect has rows; the inertia of all pivots together is that of the matrix.
//!
//! * M_uu takes plain pivots where that is stable, as it is whenever Ipopt accepts the matrix.
//!   Elsewhere it takes 1×1 and 2×2 threshold pivots; unknowns without an acceptable pivot wait and
//!   become unknowns of the node before, so that any regular matrix is factorised. Multipliers of
//!   one node's equalities are no special case: they are unknowns without a pivot of their own.
//! * Regularised defects, `[[P, I], [I, −Δ]]`, are exact too: P is replaced by `P (I + ΔP)⁻¹`.
//! * The rows of `[B A]` are as sparse as they are found: a joint's double integrator costs
//!   two or three multiplications a column where a dense row costs the row's length.
//! * All rows are padded to whole SIMD vectors; the lanes are chosen at run time. Results do
//!   not depend on them beyond rounding.

mod assembly;
mod defect_regularization;
mod delayed;
mod dims;
mod elimination;
mod factor;
mod gather;
mod hessian;
mod jacobian;
mod lanes;
mod node;
mod packed;
mod pattern;
mod shape;
mod solve;
mod solver;
mod structure;

pub use dims::{NodeDims, StageDims};
pub use solver::StageKkt;
pub use structure::KktStructureError;
