//! Sparse nonlinear programs
//!
//! ```text
//! min f(x)   s.t.   g_L ≤ g(x) ≤ g_U,   x_L ≤ x ≤ x_U
//! ```
//!
//! with x ∈ Rⁿ, g(x) ∈ Rᵐ and exact derivatives: what an optimizer is given, and what it answers.
//! A stationary point has multipliers λ, z_L ≥ 0 and z_U ≥ 0 with
//!
//! ```text
//! ∇f(x) + ∇g(x)ᵀ λ − z_L + z_U = 0,   z_L · (x − x_L) = 0,   z_U · (x_U − x) = 0
//! ```
//!
//! (Nocedal & Wright, *Numerical Optimization*, 2nd ed., section 12.3). A [`Problem`] declares
//! sizes, bounds and sparsity once and evaluates functions and derivatives in place; [`Options`]
//! say how to solve and a [`Start`] from where; a [`LinearSolver`] factorises the systems of the
//! interior-point iterations. What comes back is an [`NlpSolution`] with its [`Status`].
//!
//! This crate solves nothing. `righting-ipopt` solves with Ipopt, `righting-interior` with a
//! method of its own; both take these types.
//!
//! ```
//! use righting_nlp::*;
//!
//! /// min (1 − x₀)² + 100 (x₁ − x₀²)²,  0 ≤ x₀
//! struct Rosenbrock;
//!
//! impl Problem for Rosenbrock {
//!     fn dimensions(&self) -> Dimensions {
//!         Dimensions { variables: 2, constraints: 0 }
//!     }
//!     fn bounds(&self, bounds: &mut Bounds) {
//!         bounds.x_lower[0] = 0.0;
//!     }
//!     fn hessian_structure(&self) -> TripletStructure {
//!         TripletStructure { rows: vec![0, 1, 1], columns: vec![0, 0, 1] }
//!     }
//!     fn objective(&mut self, x: &[f64], _: bool) -> Result<f64, EvaluationError> {
//!         Ok((1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2))
//!     }
//!     fn gradient(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
//!         let r = x[1] - x[0] * x[0];
//!         out.copy_from_slice(&[2.0 * (x[0] - 1.0) - 400.0 * x[0] * r, 200.0 * r]);
//!         Ok(())
//!     }
//!     fn hessian(
//!         &mut self,
//!         x: &[f64],
//!         _: bool,
//!         factor: f64,
//!         _: &[f64],
//!         _: bool,
//!         out: &mut [f64],
//!     ) -> Result<(), EvaluationError> {
//!         let h = [2.0 - 400.0 * x[1] + 1200.0 * x[0] * x[0], -400.0 * x[0], 200.0];
//!         out.iter_mut().zip(h).for_each(|(out, h)| *out = factor * h);
//!         Ok(())
//!     }
//! }
//!
//! let declared = Declarations::of(&Rosenbrock)?;
//! assert_eq!((declared.variables, declared.hessian.len()), (2, 3));
//! declared.check_start(&Start::at(vec![-1.2, 1.0]))?;
//! assert_eq!(declared.violation(&[-1.2, 1.0], &[]), 1.2);
//!
//! let options = Options { tolerance: 0.0, ..Options::default() };
//! assert!(options.validate().unwrap_err().to_string().contains("tolerance"));
//! # Ok::<(), NlpError>(())
//! ```
#![forbid(unsafe_code)]

mod augmented_system;
mod bounds;
mod bunch_kaufman;
mod declarations;
mod derivative_errors;
mod error;
mod iteration;
mod linear_solver;
mod optimality_residuals;
mod options;
mod problem;
mod reduced_hessian;
mod scaling;
mod solution;
mod start;
mod status;
mod timing;
mod triplet_structure;

pub use augmented_system::AugmentedSystem;
pub use bounds::Bounds;
pub use bunch_kaufman::BunchKaufman;
pub use declarations::Declarations;
pub use derivative_errors::DerivativeErrors;
pub use error::{MatrixName, NlpError, VectorName};
pub use iteration::{Control, Iteration};
pub use linear_solver::{Factorization, LinearSolver, LinearSolverError, PivotTolerances};
pub use optimality_residuals::OptimalityResiduals;
pub use options::{
    FixedVariables, Hessian, MuStrategy, MultiplierInitialization, NlpScaling, OptionRange,
    OptionValue, Options,
};
pub use problem::{Dimensions, EvaluationError, Problem};
pub use reduced_hessian::ReducedHessian;
pub use scaling::Scaling;
pub use solution::NlpSolution;
pub use start::{Multipliers, Start};
pub use status::Status;
pub use timing::{EvaluationTiming, LinearSolverTiming, Tally, Timing};
pub use triplet_structure::TripletStructure;
