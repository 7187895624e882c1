use std::error::Error;

use thiserror::Error;

/// A solver of the symmetric indefinite systems of the interior-point method.
///
/// Unknowns and triplets are those of an [`AugmentedSystem`](crate::AugmentedSystem), in any order
/// of the triplets; fixed variables are left out unless
/// [`Options::fixed_variables`](crate::Options::fixed_variables) says otherwise. All triplets are
/// in the lower triangle, and the whole diagonal is among them. D_x and D_s hold the barrier terms
/// and the regularisation, D_c and D_d are zero unless the constraints are regularised.
///
/// The matrix must have as many negative eigenvalues as there are constraints, or the optimizer adds
/// to the diagonal and factors again. One iteration is one factorisation, or a few, and with iterative
/// refinement a few solutions. At a cold start there is one more, of the system that gives
/// least-squares multipliers: an identity in place of W + D_x and D_s.
///
/// All calls come from the thread that solves.
pub trait LinearSolver {
    /// Takes the structure: triplets of one triangle that count from zero, an entry given twice is
    /// a sum. Called before the first `factor`; the structure stays the same throughout a solve,
    /// restoration phase included.
    fn analyse(
        &mut self,
        order: usize,
        rows: &[i32],
        columns: &[i32],
    ) -> Result<(), LinearSolverError>;

    /// Factors the matrix of these values, in the order of the structure.
    fn factor(&mut self, values: &[f64]) -> Factorization;

    /// Solves with the last factorisation, in place; several right-hand sides follow one another.
    fn solve(&mut self, right_hand_sides: &mut [f64]);

    /// The range of pivot tolerances, for a solver that can trade sparsity for accuracy. With
    /// `None` the optimizer regularises at once when a solution is not accurate enough.
    fn pivot_tolerances(&self) -> Option<PivotTolerances> {
        None
    }

    /// The pivot tolerance of the next `factor`; called only if there is a range of them.
    fn set_pivot_tolerance(&mut self, _tolerance: f64) {}
}

/// Pivot tolerances u, with 0 < initial ≤ largest < 1: each time that a solution is not accurate
/// enough the optimizer raises u to u^¾, up to the largest, and factors the same matrix again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PivotTolerances {
    /// The first one.
    pub initial: f64,
    /// The last one.
    pub largest: f64,
}

/// How a factorisation went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Factorization {
    /// The matrix is regular.
    Regular {
        /// How many of its eigenvalues are negative.
        negative_eigenvalues: usize,
    },
    /// The matrix is singular; the optimizer regularises it.
    Singular,
    /// It could not be factored at all. The optimizer tries its restoration phase, and ends with
    /// [`Status::LinearSolverFailed`](crate::Status::LinearSolverFailed) if that fails too.
    Failed,
}

/// Why a [`LinearSolver`] does not take a system.
#[derive(Debug, Error)]
#[error(transparent)]
pub struct LinearSolverError(Box<dyn Error + Send + Sync>);

impl LinearSolverError {
    /// Wraps the solver's own error.
    pub fn new(error: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self(error.into())
    }
}
