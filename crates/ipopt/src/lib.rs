//! Ipopt, the interior-point solver for large sparse nonlinear programs
//!
//! ```text
//! min f(x)   s.t.   g_L ≤ g(x) ≤ g_U,   x_L ≤ x ≤ x_U
//! ```
//!
//! (Wächter & Biegler, *Mathematical Programming* 106, 2006), behind a safe interface: a
//! [`Problem`] with its sparsity declared once, typed [`Options`], every outcome a [`Status`].
//!
//! ```
//! use righting_ipopt::*;
//!
//! /// min (1 − x₀)² + 100 (x₁ − x₀²)²,  within the unit disc
//! struct Rosenbrock;
//!
//! impl Problem for Rosenbrock {
//!     fn dimensions(&self) -> Dimensions {
//!         Dimensions { variables: 2, constraints: 1 }
//!     }
//!     fn bounds(&self, bounds: &mut Bounds) {
//!         bounds.g_upper[0] = 1.0;
//!     }
//!     fn jacobian_structure(&self) -> TripletStructure {
//!         TripletStructure { rows: vec![0, 0], columns: vec![0, 1] }
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
//!     fn constraints(&mut self, x: &[f64], _: bool, g: &mut [f64]) -> Result<(), EvaluationError> {
//!         g[0] = x[0] * x[0] + x[1] * x[1];
//!         Ok(())
//!     }
//!     fn jacobian(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
//!         out.copy_from_slice(&[2.0 * x[0], 2.0 * x[1]]);
//!         Ok(())
//!     }
//!     fn hessian(
//!         &mut self,
//!         x: &[f64],
//!         _: bool,
//!         s: f64,
//!         m: &[f64],
//!         _: bool,
//!         out: &mut [f64],
//!     ) -> Result<(), EvaluationError> {
//!         out.copy_from_slice(&[
//!             s * (2.0 - 400.0 * x[1] + 1200.0 * x[0] * x[0]) + 2.0 * m[0],
//!             s * -400.0 * x[0],
//!             s * 200.0 + 2.0 * m[0],
//!         ]);
//!         Ok(())
//!     }
//! }
//!
//! let start = Start::at(vec![0.0, 0.0]);
//! let solution = solve(&mut Rosenbrock, &Options::default(), &start, |_| Control::Continue)?;
//! assert_eq!(solution.status, Status::Solved);
//! assert!((solution.x[0] - 0.786_415).abs() < 1e-5);
//! # Ok::<(), SolveError>(())
//! ```
//!
//! # Linear solvers
//!
//! [`solve`] lets Ipopt use MUMPS. [`solve_with`] plugs in a [`LinearSolver`] of the caller's, which
//! may know the structure of the problem. To Ipopt it is MA57: up to 3.13 it calls MA57 through
//! function pointers that a program may set, from 3.14 on through a shared library that its option
//! `hsllib` names, here a page of memory that passes the calls on.
//!
//! # Loading
//!
//! With the feature `dlopen`, which is on by default, Ipopt's library is opened by the first solve:
//! a program that does not solve runs without it, and does not wait for it. Where it is missing,
//! every solve is [`SolveError::NotLoaded`].
//!
//! # Threads
//!
//! MUMPS keeps state of the whole process, so [`solve`] holds a process-wide lock from start to
//! end: solves with MUMPS in several threads are correct, one after the other. Ipopt itself
//! shares nothing between threads that matters: every solve has its own application object,
//! journalist and options, and the tags of its caches count in thread-local storage (checked for
//! 3.11.9, source and Debian's binary); what is shared is the flag that the banner was printed
//! and the origin of the wall clock. So solves with [`solve_with`] run in parallel, each with its
//! own solver. Two of Ipopt's clocks count the whole process: `max_cpu_time` and its printed
//! timings include the other threads.
//!
//! A threaded BLAS makes MUMPS slower on the small fronts of these problems and its rounding
//! depends on the number of threads: a program calls [`use_one_blas_thread`] before it solves.
//!
//! # Panics and nesting
//!
//! A panic in a [`Problem`], a [`LinearSolver`] or the iteration callback never crosses Ipopt's
//! frames: it is kept, the solve is stopped, and it goes on once Ipopt has returned. A solve that
//! is started from within a solve on the same thread is refused.

mod callbacks;
mod diagnosis;
mod error;
mod handle;
mod iterate;
mod libraries;
mod memory;
mod options;
mod slot;
mod solve;
mod status;
mod trap;

pub use diagnosis::{Diagnosis, LinearSolverSlot, Mumps, diagnose};
pub use error::SolveError;
pub use iterate::{Iterate, Violations, current_iterate, current_violations};
pub use libraries::{LoadedLibrary, Versions, versions};
pub use memory::{keep_freed_memory, prefer_huge_pages};
pub use righting_ipopt_sys::hsl::SlotError;
pub use righting_ipopt_sys::{LoadError, STARTS_MPI, use_one_blas_thread};
pub use solve::{solve, solve_with};

pub use righting_nlp::{
    AugmentedSystem, Bounds, BunchKaufman, Control, Declarations, Dimensions, EvaluationError,
    EvaluationTiming, Factorization, FixedVariables, Hessian, Iteration, LinearSolver,
    LinearSolverError, LinearSolverTiming, MatrixName, MuStrategy, MultiplierInitialization,
    Multipliers, NlpError, NlpScaling, NlpSolution, OptionRange, OptionValue, Options,
    PivotTolerances, Problem, ReducedHessian, Scaling, Start, Status, Tally, Timing,
    TripletStructure, VectorName,
};
