//! A linear solver that keeps account of its calls.

use righting_ipopt::{BunchKaufman, Factorization, LinearSolver, LinearSolverError};

/// The dense solver, which shares nothing with MUMPS.
#[derive(Default)]
pub struct Counting {
    solver: BunchKaufman,
    pub analyses: usize,
    pub factorizations: usize,
}

impl LinearSolver for Counting {
    fn analyse(&mut self, n: usize, r: &[i32], c: &[i32]) -> Result<(), LinearSolverError> {
        self.analyses += 1;
        self.solver.analyse(n, r, c)
    }

    fn factor(&mut self, values: &[f64]) -> Factorization {
        self.factorizations += 1;
        self.solver.factor(values)
    }

    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        self.solver.solve(right_hand_sides);
    }
}
