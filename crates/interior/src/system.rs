use std::time::Instant;

use righting_nlp::{
    AugmentedSystem, Factorization, LinearSolver, LinearSolverTiming, Options, Problem,
};

use crate::program::Program;
use crate::{GivesUp, are_finite};

/// What the pivot tolerance is raised to, of itself.
const TOLERANCE_POWER: f64 = 0.75;
/// Growth of the Hessian's regularisation from the first one tried, and from later ones.
const FIRST_GROWTH: f64 = 100.0;
const GROWTH: f64 = 8.0;
const SHRINKAGE: f64 = 1.0 / 3.0;
/// The constraints are regularised by a multiple of μ to this power.
const JACOBIAN_REGULARIZATION_POWER: f64 = 0.25;

/// The augmented system, its solver and its regularisation.
pub(crate) struct System<'s, L: ?Sized> {
    solver: &'s mut L,
    matrix: AugmentedSystem,
    right_hand_side: Vec<f64>,
    regularization: Regularization,
    pivot_tolerance: Option<f64>,
    pub(crate) timing: LinearSolverTiming,
}

/// What is added to the diagonal of w, and taken from that of the constraints.
#[derive(Debug, Clone, Copy, Default)]
struct Shift {
    primal: f64,
    constraint: f64,
}

/// The last regularisation of the Hessian that was needed, and what bounds the next.
struct Regularization {
    first: f64,
    least: f64,
    most: f64,
    constraint: f64,
    last: f64,
    /// Whether some matrix was regular with no constraint regularised.
    is_settled: bool,
}

impl<'s, L: LinearSolver + ?Sized> System<'s, L> {
    pub(crate) fn new<P: Problem + ?Sized>(
        solver: &'s mut L,
        program: &Program<'_, P>,
        options: &Options,
    ) -> Result<Self, GivesUp> {
        let matrix = AugmentedSystem::new(&program.declared);
        let started = Instant::now();
        let analysed = solver.analyse(matrix.order(), matrix.rows(), matrix.columns());
        let mut timing = LinearSolverTiming::default();
        timing.analyse.add_since(started);
        analysed.map_err(GivesUp::LinearSolver)?;
        let tolerances = solver.pivot_tolerances();
        if let Some(tolerances) = tolerances {
            solver.set_pivot_tolerance(tolerances.initial);
        }
        Ok(Self {
            pivot_tolerance: tolerances.map(|tolerances| tolerances.initial),
            solver,
            right_hand_side: vec![0.0; matrix.order()],
            matrix,
            regularization: Regularization {
                first: options.first_hessian_perturbation,
                least: options.min_hessian_perturbation,
                most: options.max_hessian_perturbation,
                constraint: options.jacobian_regularization_value,
                last: 0.0,
                is_settled: false,
            },
            timing,
        })
    }

    /// Where the Hessian's values go.
    pub(crate) fn hessian_mut(&mut self) -> &mut [f64] {
        self.matrix.hessian_mut()
    }

    /// Where the Jacobian's values go.
    pub(crate) fn jacobian_mut(&mut self) -> &mut [f64] {
        self.matrix.jacobian_mut()
    }

    /// The Jacobian's values.
    pub(crate) fn jacobian(&self) -> &[f64] {
        self.matrix.jacobian()
    }

    /// Factorises with these barrier terms Σ of w, and whatever regularisation gives one negative
    /// eigenvalue a constraint. Returns what was added to the Hessian's diagonal.
    pub(crate) fn factorise(&mut self, sigma: &[f64], mu: f64) -> Result<f64, GivesUp> {
        let mut shift = Shift::default();
        let mut may_sharpen = true;
        loop {
            let constraints = self.matrix.constraints();
            match self.factorise_once(sigma, shift) {
                Factorization::Regular { negative_eigenvalues: n } if n == constraints => break,
                Factorization::Failed => return Err(GivesUp::NoStep),
                Factorization::Regular { negative_eigenvalues: n } if n < constraints => {
                    if may_sharpen && self.sharpen() {
                        may_sharpen = false;
                        continue;
                    }
                    shift = self.regularization.of_singular(shift, mu)?;
                }
                Factorization::Singular if constraints > 0 => {
                    shift = self.regularization.of_singular(shift, mu)?;
                }
                Factorization::Regular { .. } | Factorization::Singular => {
                    self.regularization.is_settled = true;
                    shift.primal = self.regularization.larger(shift.primal)?;
                }
            }
        }
        self.regularization.is_settled = true;
        if shift.primal > 0.0 {
            self.regularization.last = shift.primal;
        }
        Ok(shift.primal)
    }

    /// Least-squares multipliers: the system with an identity in place of W + Σ, solved for these
    /// right-hand sides of w. False where it has no solution.
    pub(crate) fn least_squares(&mut self, rhs: &[f64], y: &mut [f64]) -> bool {
        self.hessian_mut().fill(0.0);
        if !self.has_right_inertia(&vec![1.0; self.matrix.primals()]) {
            return false;
        }
        let zeros = vec![0.0; self.matrix.constraints()];
        self.solve(rhs, &zeros, &mut vec![0.0; self.matrix.primals()], y);
        are_finite(y)
    }

    /// Factorises without regularisation: whether there is one negative eigenvalue a constraint.
    pub(crate) fn has_right_inertia(&mut self, sigma: &[f64]) -> bool {
        let negative_eigenvalues = self.matrix.constraints();
        let right = Factorization::Regular { negative_eigenvalues };
        self.factorise_once(sigma, Shift::default()) == right
    }

    fn factorise_once(&mut self, sigma: &[f64], shift: Shift) -> Factorization {
        let diagonal = self.matrix.diagonal_mut();
        diagonal.iter_mut().zip(sigma).for_each(|(value, sigma)| *value = sigma + shift.primal);
        self.matrix.constraint_diagonal_mut().fill(-shift.constraint);
        let started = Instant::now();
        let outcome = self.solver.factor(self.matrix.values());
        self.timing.factor.add_since(started);
        outcome
    }

    /// Solves with the last factorisation.
    pub(crate) fn solve(&mut self, w: &[f64], c: &[f64], dw: &mut [f64], dy: &mut [f64]) {
        let rhs = &mut self.right_hand_side;
        rhs[..self.matrix.primals()].copy_from_slice(w);
        for (&unknown, c) in self.matrix.multipliers().iter().zip(c) {
            rhs[unknown] = *c;
        }
        let started = Instant::now();
        self.solver.solve(rhs);
        self.timing.solve.add_since(started);
        dw.copy_from_slice(&rhs[..self.matrix.primals()]);
        for (&unknown, dy) in self.matrix.multipliers().iter().zip(dy) {
            *dy = rhs[unknown];
        }
    }

    /// Raises the pivot tolerance if it may still rise.
    fn sharpen(&mut self) -> bool {
        let (Some(tolerance), Some(range)) = (self.pivot_tolerance, self.solver.pivot_tolerances())
        else {
            return false;
        };
        let raised = tolerance.powf(TOLERANCE_POWER).min(range.largest);
        if raised <= tolerance {
            return false;
        }
        self.pivot_tolerance = Some(raised);
        self.solver.set_pivot_tolerance(raised);
        true
    }
}

impl Regularization {
    /// The next one after a singular matrix, or one with too few negative eigenvalues. Whether a
    /// problem is degenerate from the start is for Ipopt to find out.
    fn of_singular(&self, shift: Shift, mu: f64) -> Result<Shift, GivesUp> {
        if !self.is_settled {
            return Err(GivesUp::NoStep);
        }
        let constraint = self.constraint * mu.powf(JACOBIAN_REGULARIZATION_POWER);
        if constraint > shift.constraint {
            return Ok(Shift { constraint, ..shift });
        }
        Ok(Shift { primal: self.larger(shift.primal)?, ..shift })
    }

    /// The next regularisation of the Hessian after one that was too small.
    fn larger(&self, shift: f64) -> Result<f64, GivesUp> {
        let larger = if shift == 0.0 {
            if self.last == 0.0 { self.first } else { self.least.max(SHRINKAGE * self.last) }
        } else if self.last == 0.0 || 1e5 * self.last < shift {
            FIRST_GROWTH * shift
        } else {
            GROWTH * shift
        };
        if larger > self.most { Err(GivesUp::NoStep) } else { Ok(larger) }
    }
}
