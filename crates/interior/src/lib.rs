//! Ipopt's line-search interior-point method (Wächter & Biegler, *Mathematical Programming* 106,
//! 2006) for programs so small, or solved so often, that Ipopt's own bookkeeping would cost more
//! than evaluating and factorising them: of a program with 200 variables three quarters of its time.
//!
//! With w = (x, s), a slack for each inequality, and δ_i(w) the distances to the bounds, it solves
//!
//! ```text
//! min  f(x) − μ Σ ln δ_i(w)   s.t.   c(w) = 0
//! ```
//!
//! for μ → 0, by steps of
//!
//! ```text
//! ⎡ W + Σ + κI   Jᵀ ⎤ ⎡ dw ⎤      ⎡ ∇f − Σ μ ∇δ_i / δ_i + Jᵀ y ⎤
//! ⎣ J           −ηI ⎦ ⎣ dy ⎦  = − ⎣ c                          ⎦,      Σ = Σ z_i / δ_i,
//! ```
//!
//! κ and η as small as the inertia allows, shortened until they are acceptable to a filter.
//!
//! It takes [problems](righting_nlp::Problem), [options](righting_nlp::Options) and [linear
//! solvers](righting_nlp::LinearSolver) of `righting_nlp` and goes the way that Ipopt goes with
//! `fast_step_computation`, iterate by iterate up to rounding: monotone barrier parameter, filter,
//! second-order corrections, watchdog, regularisation. It has no restoration phase. Where Ipopt would
//! enter one, and wherever else it does not know how to go on, it [gives up](GivesUp), for Ipopt to
//! solve the problem instead.
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
//!     fn jacobian_structure(&self) -> TripletStructure {
//!         TripletStructure::default()
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
//!     fn constraints(&mut self, _: &[f64], _: bool, _: &mut [f64]) -> Result<(), EvaluationError> {
//!         Ok(())
//!     }
//!     fn jacobian(&mut self, _: &[f64], _: bool, _: &mut [f64]) -> Result<(), EvaluationError> {
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
//! /// Without constraints between the variables the system is diagonal.
//! #[derive(Default)]
//! struct Diagonal {
//!     rows: Vec<i32>,
//!     diagonal: Vec<f64>,
//! }
//!
//! impl LinearSolver for Diagonal {
//!     fn analyse(&mut self, n: usize, rows: &[i32], _: &[i32]) -> Result<(), LinearSolverError> {
//!         (self.rows, self.diagonal) = (rows.to_vec(), vec![0.0; n]);
//!         Ok(())
//!     }
//!     fn factor(&mut self, values: &[f64]) -> Factorization {
//!         self.diagonal.fill(0.0);
//!         self.rows.iter().zip(values).for_each(|(&i, value)| self.diagonal[i as usize] += value);
//!         let negative_eigenvalues = self.diagonal.iter().filter(|d| **d < 0.0).count();
//!         Factorization::Regular { negative_eigenvalues }
//!     }
//!     fn solve(&mut self, right_hand_sides: &mut [f64]) {
//!         right_hand_sides.iter_mut().zip(&self.diagonal).for_each(|(b, d)| *b /= d);
//!     }
//! }
//!
//! let options = Options { fast_step_computation: true, ..Options::default() };
//! let start = Start::at(vec![1.0, 1.0]);
//! let mut linear_solver = Diagonal::default();
//! let solved = solve(&mut Separable([0.5, 2.0]), &options, &start, &mut linear_solver, |_| {
//!     Control::Continue
//! })?;
//! assert_eq!(solved.solution.status, Status::Solved);
//! assert!(solved.solution.x[0].abs() < 1e-6);
//! assert!((solved.solution.x[1] - 2.0_f64.ln()).abs() < 1e-6);
//! # Ok::<(), righting_interior::GivesUp>(())
//! ```
#![forbid(unsafe_code)]

mod barrier;
mod convergence;
mod filter;
mod line_search;
mod method;
mod point;
mod program;
mod start;
mod system;

pub use method::{Solved, solve};

use righting_nlp::{LinearSolverError, NlpError};

/// Why a solve ended without an answer. None of it says anything about the problem: Ipopt may well
/// solve it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GivesUp {
    /// An option asks for something that the method does not have.
    #[error("{0} is not supported")]
    Unsupported(&'static str),
    /// A variable has equal bounds.
    #[error("variable {index} is fixed")]
    FixedVariable {
        /// Which.
        index: usize,
    },
    /// The problem, the start or an option is not what it has to be.
    #[error(transparent)]
    Invalid(#[from] NlpError),
    /// A function or derivative is not defined where a step cannot be shortened.
    #[error("a function is not defined at the start, or a derivative at an accepted point")]
    Undefined,
    /// The linear solver does not take the system.
    #[error("the linear solver refuses the system")]
    LinearSolver(#[source] LinearSolverError),
    /// No regularisation gave a step.
    #[error("no step could be computed")]
    NoStep,
    /// No step length was acceptable: Ipopt would enter its restoration phase.
    #[error("no point along the step is acceptable")]
    NeedsRestoration,
    /// Two steps in a row were as small as rounding errors.
    #[error("steps have become as small as rounding errors")]
    TinySteps,
}

/// Whether every entry is a number, and finite.
pub(crate) fn are_finite(values: &[f64]) -> bool {
    // Without an early exit, so that it compiles to vector code.
    values.iter().fold(true, |finite, value| finite & value.is_finite())
}

/// Numbers compared at a time: a chain of single comparisons would wait for each.
const LANES: usize = 8;

/// The maximum norm; not a number if an entry is not.
pub(crate) fn largest(values: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (chunks, rest) = values.as_chunks::<LANES>();
    for chunk in chunks {
        for (lane, value) in lanes.iter_mut().zip(chunk) {
            *lane = larger(*lane, value.abs());
        }
    }
    rest.iter().map(|value| value.abs()).chain(lanes).fold(0.0, larger)
}

/// The larger size; not a number if one is not.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}
