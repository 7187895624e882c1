use std::time::Instant;

use righting_nlp::{
    AugmentedSystem, Declarations, Factorization, LinearSolver, LinearSolverTiming,
};

use crate::error::FailureReason;

/// What the pivot tolerance u is raised to: it nears one by a quarter of its logarithm each time,
/// which takes MA57's range of 1e-8 to 1e-4 (options `ma57_pivtol`, `ma57_pivtolmax`) in three
/// steps.
const PIVOT_TOLERANCE_POWER: f64 = 0.75;

/// What is added to the diagonal of w, δ_w, and taken from that of the constraints, δ_c (W&B
/// eq. 13).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Regularization {
    pub(crate) primal: f64,
    pub(crate) constraint: f64,
}

/// The augmented system (W&B eq. 13) and what solves it.
pub(crate) struct LinearSystem<'s, L: ?Sized> {
    solver: &'s mut L,
    pub(crate) matrix: AugmentedSystem,
    right_hand_side: Vec<f64>,
    pivot_tolerance: Option<f64>,
    pub(crate) timing: LinearSolverTiming,
}

impl<'s, L: LinearSolver + ?Sized> LinearSystem<'s, L> {
    pub(crate) fn new(solver: &'s mut L, declared: &Declarations) -> Result<Self, FailureReason> {
        let matrix = AugmentedSystem::new(declared);
        let started = Instant::now();
        let analysed = solver.analyse(matrix.order(), matrix.rows(), matrix.columns());
        let mut timing = LinearSolverTiming::default();
        timing.analyse.add_since(started);
        analysed.map_err(FailureReason::LinearSolver)?;
        let tolerances = solver.pivot_tolerances();
        if let Some(tolerances) = tolerances {
            solver.set_pivot_tolerance(tolerances.initial);
        }
        Ok(Self {
            pivot_tolerance: tolerances.map(|tolerances| tolerances.initial),
            solver,
            right_hand_side: vec![0.0; matrix.order()],
            matrix,
            timing,
        })
    }

    /// Factorises with these barrier terms Σ of w.
    pub(crate) fn factor(&mut self, sigma: &[f64], added: Regularization) -> Factorization {
        let diagonal = self.matrix.diagonal_mut();
        diagonal.iter_mut().zip(sigma).for_each(|(value, sigma)| *value = sigma + added.primal);
        self.matrix.constraint_diagonal_mut().fill(-added.constraint);
        let started = Instant::now();
        let outcome = self.solver.factor(self.matrix.values());
        self.timing.factor.add_since(started);
        outcome
    }

    /// Whether a factorisation found one negative eigenvalue a constraint and none that is zero:
    /// then the reduced Hessian is positive definite (Gould, *Mathematical Programming* 32, 1985).
    pub(crate) fn has_right_inertia(&self, outcome: Factorization) -> bool {
        let negative_eigenvalues = self.matrix.constraints();
        outcome == Factorization::Regular { negative_eigenvalues }
    }

    /// Solves with the last factorisation.
    pub(crate) fn solve(&mut self, w: &[f64], c: &[f64], dw: &mut [f64], dy: &mut [f64]) {
        let rhs = &mut self.right_hand_side;
        let primals = self.matrix.primals();
        rhs[..primals].copy_from_slice(w);
        for (&unknown, c) in self.matrix.multipliers().iter().zip(c) {
            rhs[unknown] = *c;
        }
        let started = Instant::now();
        self.solver.solve(rhs);
        self.timing.solve.add_since(started);
        dw.copy_from_slice(&rhs[..primals]);
        for (&unknown, dy) in self.matrix.multipliers().iter().zip(dy) {
            *dy = rhs[unknown];
        }
    }

    /// Raises the pivot tolerance if it may still rise.
    pub(crate) fn raise_pivot_tolerance(&mut self) -> bool {
        let (Some(tolerance), Some(range)) = (self.pivot_tolerance, self.solver.pivot_tolerances())
        else {
            return false;
        };
        let raised = tolerance.powf(PIVOT_TOLERANCE_POWER).min(range.largest);
        if raised <= tolerance {
            return false;
        }
        self.pivot_tolerance = Some(raised);
        self.solver.set_pivot_tolerance(raised);
        true
    }
}
