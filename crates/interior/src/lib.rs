//! A line-search interior-point method for nonlinear programs that are so small, or solved so often,
//! that Ipopt's own bookkeeping would cost more than evaluating and factorising them: of a program
//! with 200 variables three quarters of its time.
//!
//! With w = (x, s), a slack for each inequality, and δ_i(w) the distances to the bounds, it solves
//!
//! ```text
//! min  φ_μ(w) = f(x) − μ Σ ln δ_i(w)   s.t.   c(w) = 0
//! ```
//!
//! for μ → 0, along the search directions of
//!
//! ```text
//! ⎡ W + Σ + δ_w I   Jᵀ     ⎤ ⎡ d_w ⎤      ⎡ ∇φ_μ + Jᵀ y ⎤
//! ⎣ J              −δ_c I  ⎦ ⎣ d_y ⎦  = − ⎣ c            ⎦,      Σ = Σ z_i / δ_i,
//! ```
//!
//! δ_w and δ_c as small as the inertia allows, shortened until a filter accepts the trial point.
//!
//! It takes the problems, options and linear solvers of `righting_nlp` and goes the way that Ipopt
//! goes with `fast_step_computation`, iterate by iterate up to rounding, which the tests hold
//! against Ipopt itself. It has no restoration phase. Where one would begin, and wherever else it
//! does not know how to go on, it ends with an [`InteriorError`], for Ipopt to solve the problem
//! instead.
//!
//! ```
//! use righting_interior::solve;
//! use righting_nlp::*;
//!
//! /// min Σ exp(x_i) − a_i x_i,  x_i ≥ 0
//! struct Separable([f64; 2]);
//!
//! impl Problem for Separable {
//!     fn dimensions(&self) -> Dimensions {
//!         Dimensions { variables: 2, constraints: 0 }
//!     }
//!     fn bounds(&self, bounds: &mut Bounds) {
//!         bounds.x_lower.fill(0.0);
//!     }
//!     fn hessian_structure(&self) -> TripletStructure {
//!         TripletStructure { rows: vec![0, 1], columns: vec![0, 1] }
//!     }
//!     fn objective(&mut self, x: &[f64], _: bool) -> Result<f64, EvaluationError> {
//!         Ok(x.iter().zip(self.0).map(|(x, a)| x.exp() - a * x).sum())
//!     }
//!     fn gradient(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
//!         out.iter_mut().zip(x).zip(self.0).for_each(|((out, x), a)| *out = x.exp() - a);
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
//!         out.iter_mut().zip(x).for_each(|(out, x)| *out = factor * x.exp());
//!         Ok(())
//!     }
//! }
//!
//! let options = Options { fast_step_computation: true, ..Options::default() };
//! let start = Start::at(vec![1.0, 1.0]);
//! let mut linear_solver = BunchKaufman::default();
//! let solution = solve(&mut Separable([0.5, 2.0]), &options, &start, &mut linear_solver, |_| {
//!     Control::Continue
//! })?;
//! assert_eq!(solution.status, Status::Solved);
//! assert!(solution.x[0].abs() < 1e-6);
//! assert!((solution.x[1] - 2.0_f64.ln()).abs() < 1e-6);
//! # Ok::<(), righting_interior::InteriorError>(())
//! ```
//!
//! # Where each part comes from
//!
//! *W&B* is A. Wächter and L. T. Biegler, “On the implementation of an interior-point filter
//! line-search algorithm for large-scale nonlinear programming”, *Mathematical Programming* 106,
//! 2006. An *option* is one of Ipopt's options reference, under that name; constants that are
//! options there and no field of [`Options`](righting_nlp::Options) have their default.
//!
//! | part | source |
//! | --- | --- |
//! | main loop | W&B section 2.5, Algorithm A |
//! | optimality error, termination | W&B eqs. 5 and 6; options of *Termination* |
//! | barrier function, fraction to the boundary, resets of z | W&B section 2.1 and eqs. 15, 16; section 3.4 |
//! | barrier parameter | W&B eqs. 7 and 8; option `mu_allow_fast_monotone_decrease`; its least value is derived in `barrier_parameter.rs` |
//! | augmented system | W&B eqs. 9 to 13; Nocedal & Wright, *Numerical Optimization*, 2nd ed., section 19.3 |
//! | inertia correction | W&B section 3.1, Algorithm IC; Gould, *Mathematical Programming* 32, 1985; what differs is derived in `inertia_correction.rs` |
//! | filter, switching and Armijo condition, least step | W&B section 2.3, eqs. 18 to 23; options of *Line Search* |
//! | second-order corrections | W&B section 2.4, steps A-5.5 to A-5.9 |
//! | watchdog, filter reset | W&B section 3.2; Chamberlain, Powell, Lemaréchal & Pedersen, *Mathematical Programming Studies* 16, 1982 |
//! | bounds that move | W&B section 3.5; option `slack_move`; the distance is derived in `barrier.rs` |
//! | first iterate, least-squares multipliers | W&B section 3.6, eq. 36; options of *Initialization* and *Warm Start* |
//! | damping, scaling, tiny steps | W&B sections 3.7, 3.8 and 3.9 |
//! | second-order sufficiency of a solution | Gould 1985; Nocedal & Wright, theorem 12.6 |
#![forbid(unsafe_code)]

mod algorithm;
mod barrier;
mod barrier_parameter;
mod bound;
mod convergence;
mod error;
mod filter;
mod inertia_correction;
mod initialization;
mod iterate;
mod line_search;
mod linear_system;
mod norm;
mod optimality_error;
mod primal_point;
mod program;
mod scaling;
mod search_direction;
mod second_order_correction;
mod solve;
mod state;
mod watchdog;

pub use error::{FailureReason, InteriorError};
pub use solve::{solve, solve_first_order};
