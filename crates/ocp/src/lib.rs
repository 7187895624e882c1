//! Direct multiple shooting: an optimal control problem in continuous time becomes a sparse
//! nonlinear program on a grid,
//!
//! ```text
//! min  Σ_{k<N} ℓ(x_k, u_k) + φ(x_N)   s.t.   x_{k+1} = F(x_k, u_k),  bounds,
//!                                             c(x_k), s(x_k, u_k, Δt), e(x_N)
//! ```
//!
//! with F one classical Runge–Kutta step (Bock & Plitt, *IFAC World Congress* 1984; Betts,
//! *Practical Methods for Optimal Control*, ch. 4). The problem is stated with symbolic states and
//! controls; [`StageFunctions`] traces, differentiates and compiles it once for all grids, and
//! [`MultipleShooting`] evaluates all stages in batches and hands the optimizer exact sparse derivatives.
//!
//! ```
//! use righting_ocp::*;
//!
//! // A double integrator from rest at 0 to rest at 1 in one second with the least effort ∫u²:
//! // u(t) = 6 − 12 t, cost 12.
//! let problem = ControlProblem::new(2, 1, |x, u| vec![x[1], u[0]])
//!     .running_cost(|_, u, _| u[0].powi(2) / 50.0)
//!     .terminal_constraints(ComponentBounds::new(vec![1.0, 0.0], vec![1.0, 0.0]), |x| x.to_vec());
//! let functions = StageFunctions::compile(&problem)?;
//! let grid = Grid::new(1.0, 50)?;
//! let mut program = MultipleShooting::new(&functions, grid, &[0.0, 0.0])?;
//! let start = OcpStart::Guess(InitialGuess::constant(&[0.0, 0.0], 1, 50));
//! let solution = program.solve(&start, &Settings::default(), |_| Control::Continue)?;
//! assert_eq!(solution.status, Status::Solved);
//! assert!((solution.objective - 12.0).abs() < 0.01);
//! # Ok::<(), OcpError>(())
//! ```
#![forbid(unsafe_code)]

mod attempt;
mod block;
mod component_bounds;
mod control_problem;
mod decision_layout;
mod error;
mod evaluation;
mod evaluator;
mod expr_matrix;
mod grid;
mod initial_guess;
pub mod kkt;
mod matrix_output;
mod mesh_refinement;
mod motion;
mod multiple_shooting;
mod node_function;
mod ocp_solution;
mod ocp_start;
mod passive;
mod primal_dual_point;
mod resample;
mod rk4;
mod samples;
mod second_order;
mod settings;
mod shooting_workspace;
mod solve;
mod sparsity;
mod stage_functions;
mod stage_store;
mod step_derivatives;
mod step_errors;
mod step_functions;
mod structure;
mod trajectory;
mod verdict;

pub use attempt::{Attempt, AttemptEnd, UsedLinearSolver};
pub use component_bounds::ComponentBounds;
pub use control_problem::{ControlProblem, StepTime};
pub use decision_layout::{DecisionLayout, ShootingDimensions};
pub use error::OcpError;
pub use grid::Grid;
pub use initial_guess::InitialGuess;
pub use mesh_refinement::{MeshRefinement, close_guess_settings, warm_start_settings};
pub use motion::MotionOutcome;
pub use multiple_shooting::MultipleShooting;
pub use ocp_solution::OcpSolution;
pub use ocp_start::OcpStart;
pub use primal_dual_point::PrimalDualPoint;
pub use rk4::{RungeKutta4, StagePoint};
pub use samples::Samples;
pub use second_order::Curvature;
pub use settings::{LinearSolverChoice, Optimizer, Settings};
pub use shooting_workspace::ShootingWorkspace;
pub use sparsity::KktSparsity;
pub use stage_functions::StageFunctions;

pub use num_dual::DualNum;
pub use righting_nlp::{
    Control, DerivativeErrors, Iteration, MultiplierInitialization, NlpScaling,
    OptimalityResiduals, Options, ReducedHessian, Status, Timing,
};
pub use righting_scalar::Scalar;
pub use righting_symbolic::{Backend, Expr};
