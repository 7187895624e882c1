//! Direct multiple shooting: an optimal control problem in continuous time becomes a sparse
//! nonlinear program on a grid,
//!
//! ```text
//! min  Σ_{k<N} ℓ(x_k, u_k) + φ(x_N)   s.t.   x_{k+1} = F(x_k, u_k),  bounds, c(x_k), e(x_N)
//! ```
//!
//! with F one classical Runge–Kutta step (Bock & Plitt, *IFAC World Congress* 1984; Betts,
//! *Practical Methods for Optimal Control*, ch. 4). The problem is stated with symbolic states and
//! controls; [`StageFunctions`] traces, differentiates and compiles it once for all grids, and
//! [`MultipleShooting`] evaluates all stages in batches and hands the optimizer exact sparse derivatives.
//!
//! ```
//! use num_dual::DualNum;
//! use righting_ocp::*;
//!
//! // A double integrator from rest at 0 to rest at 1 in one second with the least effort ∫u²:
//! // u(t) = 6 − 12 t, cost 12.
//! let problem = ControlProblem::new(2, 1, |x, u| vec![x[1], u[0]])
//!     .running_cost(|_, u| u[0].powi(2) / 50.0)
//!     .terminal_constraints(Interval::new(vec![1.0, 0.0], vec![1.0, 0.0]), |x| x.to_vec());
//! let functions = StageFunctions::compile(&problem)?;
//! let grid = Grid::new(1.0, 50)?;
//! let mut program = MultipleShooting::new(&functions, grid, &[0.0, 0.0])?;
//! let start = Start::Guess(Guess::constant(&[0.0, 0.0], 1, 50));
//! let solution = program.solve(&start, &Settings::default(), |_| Control::Continue)?;
//! assert_eq!(solution.status, Status::Solved);
//! assert!((solution.objective - 12.0).abs() < 0.01);
//! # Ok::<(), OcpError>(())
//! ```
#![forbid(unsafe_code)]

mod block;
mod curvature;
mod derivative_check;
mod error;
mod grid;
pub mod kkt;
mod layout;
mod matrix;
mod nlp;
mod passive;
mod point;
mod problem;
mod refine;
mod resample;
mod rk4;
mod samples;
mod solution;
mod solve;
mod sparsity;
mod stage;
mod start;
mod step;
mod structure;
mod trajectory;
mod worker;

pub use curvature::Curvature;
pub use derivative_check::DerivativeErrors;
pub use error::OcpError;
pub use grid::Grid;
pub use layout::{Dimensions, Layout};
pub use nlp::MultipleShooting;
pub use point::Point;
pub use problem::{ControlProblem, Interval};
pub use refine::{close_guess_settings, refine};
pub use samples::Samples;
pub use solution::Solution;
pub use solve::{Attempt, AttemptEnd, LinearSolver, Optimizer, Settings, UsedLinearSolver};
pub use sparsity::KktSparsity;
pub use stage::StageFunctions;
pub use start::{Guess, Start};

pub use righting_nlp::{Control, Iteration, Options, Status, Timing};
pub use righting_symbolic::Backend;
