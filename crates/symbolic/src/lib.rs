//! Symbolic expressions, their derivatives, and functions compiled for many points at once.
//!
//! An [`Expr`] is a handle into a graph in which every expression exists once (*hash-consing*) and
//! constants fold on construction. It implements num-dual's `DualNum` and the project's `Scalar`,
//! so model code written for any scalar traces itself. Derivatives are expressions again: for
//! f: Rⁿ → Rᵐ with Jacobian J and a scalar s = λᵀf,
//!
//! ```text
//! gradient(s, x)       reverse sweep           ∂s/∂x = Jᵀλ
//! jacobian(f, x)       forward or reverse      J, structural zeros dropped
//! hessian_lower(s, x)  forward over reverse    lower triangle of ∂²s/∂x²
//! ```
//!
//! A [`Function`] sorts the graph below its outputs into a list of instructions over one register
//! file and evaluates a block of [`LANES`] points side by side, without allocating. On x86-64 it is
//! machine code made when the function is built (AVX-512 or AVX2, whichever the machine has), else
//! an interpreter. Every [`Backend`], one point or a batch, rounds every operation alike: results
//! agree bit for bit.
//!
//! ```
//! use num_dual::DualNum;
//! use righting_symbolic::{Expr, Function, hessian_lower, jacobian, trace};
//!
//! // Rosenbrock's residuals, traced once: values, Jacobian, Hessian of λᵀr.
//! let derivatives = trace(|| {
//!     let x = Expr::symbols("x", 2);
//!     let multipliers = Expr::symbols("lambda", 2);
//!     let residuals = [1.0 - x[0], (x[1] - x[0].powi(2)) * 10.0];
//!     let lagrangian = multipliers[0] * residuals[0] + multipliers[1] * residuals[1];
//!     Function::builder("rosenbrock")
//!         .input("x", &x)
//!         .input("lambda", &multipliers)
//!         .output("residuals", &residuals)
//!         .output_sparse("jacobian", &jacobian(&residuals, &x))
//!         .output_sparse("hessian", &hessian_lower(lagrangian, &x))
//!         .build()
//! })?;
//!
//! let mut workspace = derivatives.workspace();
//! let (mut residuals, mut jacobian, mut hessian) = ([0.0; 2], [0.0; 3], [0.0; 1]);
//! derivatives.evaluate(
//!     &mut workspace,
//!     &[&[2.0, 3.0], &[1.0, 0.5]],
//!     &mut [&mut residuals, &mut jacobian, &mut hessian],
//! );
//! assert_eq!(residuals, [-1.0, -10.0]);
//! assert_eq!(jacobian, [-1.0, -40.0, 10.0]); // (0,0), (1,0), (1,1)
//! assert_eq!(hessian, [-10.0]); // the one entry (0,0) that is not structurally zero
//! # Ok::<(), righting_symbolic::FunctionError>(())
//! ```
//!
//! # Values
//! Constants fold and expressions simplify as in any computer algebra system: 0·x is 0 even where x
//! is infinite, x − x is 0, zeros carry no sign, constant factors are gathered ((2x)·3 is 6x), and
//! negations move outward. Apart from that each operation is evaluated once, as written, and rounds
//! to nearest; products and sums are never fused. A branch ([`righting_scalar::Scalar`]) computes
//! both sides and keeps one: the other reaches neither the value nor any derivative, even if it is
//! infinite.

#![deny(unsafe_code)]

mod adjoint;
mod arithmetic;
mod derivative;
mod dual_num;
mod expr;
mod function;
mod graph;
mod op;
mod partial;
mod simplify;
mod sparsity;
mod subgraph;
mod tangent;
mod trigonometry;

pub use derivative::{gradient, hessian_lower, jacobian};
pub use expr::Expr;
pub use function::{
    Backend, Function, FunctionBuilder, FunctionError, InstructionSet, LANES, Port, Workspace,
};
pub use graph::{Graph, GraphScope, trace};
pub use sparsity::{SparseMatrix, Sparsity};
