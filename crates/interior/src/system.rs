use std::ops::Range;
use std::time::Instant;

use righting_nlp::{
    Declarations, Factorization, LinearSolver, LinearSolverTiming, Options, Problem,
};

use crate::program::{Program, Row};
use crate::{GivesUp, are_finite};

/// What the pivot tolerance is raised to, of itself.
const TOLERANCE_POWER: f64 = 0.75;
/// Growth of the Hessian's regularisation from the first one tried, and from later ones.
const FIRST_GROWTH: f64 = 100.0;
const GROWTH: f64 = 8.0;
const SHRINKAGE: f64 = 1.0 / 3.0;
/// The constraints are regularised by a multiple of μ to this power.
const JACOBIAN_REGULARIZATION_POWER: f64 = 0.25;

/// The augmented system in the form of [`LinearSolver`], values assembled where they are evaluated:
///
/// ```text
/// values = [ W | diagonal of w | J | −1 of each slack | diagonal of the constraints ]
/// ```
pub(crate) struct System<'s, L: ?Sized> {
    solver: &'s mut L,
    /// Of the primal unknowns.
    primals: usize,
    /// Unknown of each row's multiplier: the equalities come first.
    unknown: Vec<usize>,
    values: Vec<f64>,
    hessian: Range<usize>,
    diagonal: Range<usize>,
    jacobian: Range<usize>,
    constraint_diagonal: Range<usize>,
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
        let (primals, constraints) = (program.primals(), program.rows.len());
        let Declarations { jacobian, hessian, .. } = &program.declared;
        let unknown = program.declared.multiplier_unknowns();
        let (mut rows, mut columns) = (hessian.rows.clone(), hessian.columns.clone());
        let of_hessian = 0..rows.len();
        rows.extend((0..primals).map(|i| i as i32));
        columns.extend((0..primals).map(|i| i as i32));
        let diagonal = of_hessian.end..rows.len();
        rows.extend(jacobian.rows.iter().map(|&row| unknown[row as usize] as i32));
        columns.extend(&jacobian.columns);
        let of_jacobian = diagonal.end..rows.len();
        for (row, unknown) in program.rows.iter().zip(&unknown) {
            if let Row::Slack(index) = *row {
                rows.push(*unknown as i32);
                columns.push(index as i32);
            }
        }
        let constraint_diagonal = rows.len()..rows.len() + constraints;
        rows.extend((primals..primals + constraints).map(|i| i as i32));
        columns.extend((primals..primals + constraints).map(|i| i as i32));

        let mut values = vec![0.0; rows.len()];
        values[of_jacobian.end..constraint_diagonal.start].fill(-1.0);
        let started = Instant::now();
        let analysed = solver.analyse(primals + constraints, &rows, &columns);
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
            primals,
            unknown,
            values,
            hessian: of_hessian,
            diagonal,
            jacobian: of_jacobian,
            constraint_diagonal,
            right_hand_side: vec![0.0; primals + constraints],
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
        &mut self.values[self.hessian.clone()]
    }

    /// Where the Jacobian's values go.
    pub(crate) fn jacobian_mut(&mut self) -> &mut [f64] {
        &mut self.values[self.jacobian.clone()]
    }

    /// The Jacobian's values.
    pub(crate) fn jacobian(&self) -> &[f64] {
        &self.values[self.jacobian.clone()]
    }

    /// Factorises with these barrier terms Σ of w, and whatever regularisation gives one negative
    /// eigenvalue a constraint. Returns what was added to the Hessian's diagonal.
    pub(crate) fn factorise(&mut self, sigma: &[f64], mu: f64) -> Result<f64, GivesUp> {
        let mut shift = Shift::default();
        let mut may_sharpen = true;
        loop {
            let constraints = self.constraint_diagonal.len();
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
        if !self.has_right_inertia(&vec![1.0; self.primals]) {
            return false;
        }
        let zeros = vec![0.0; self.constraint_diagonal.len()];
        self.solve(rhs, &zeros, &mut vec![0.0; self.primals], y);
        are_finite(y)
    }

    /// Factorises without regularisation: whether there is one negative eigenvalue a constraint.
    pub(crate) fn has_right_inertia(&mut self, sigma: &[f64]) -> bool {
        let negative_eigenvalues = self.constraint_diagonal.len();
        let right = Factorization::Regular { negative_eigenvalues };
        self.factorise_once(sigma, Shift::default()) == right
    }

    fn factorise_once(&mut self, sigma: &[f64], shift: Shift) -> Factorization {
        let diagonal = &mut self.values[self.diagonal.clone()];
        diagonal.iter_mut().zip(sigma).for_each(|(value, sigma)| *value = sigma + shift.primal);
        self.values[self.constraint_diagonal.clone()].fill(-shift.constraint);
        let started = Instant::now();
        let outcome = self.solver.factor(&self.values);
        self.timing.factor.add_since(started);
        outcome
    }

    /// Solves with the last factorisation.
    pub(crate) fn solve(&mut self, w: &[f64], c: &[f64], dw: &mut [f64], dy: &mut [f64]) {
        let rhs = &mut self.right_hand_side;
        rhs[..self.primals].copy_from_slice(w);
        for (&unknown, c) in self.unknown.iter().zip(c) {
            rhs[unknown] = *c;
        }
        let started = Instant::now();
        self.solver.solve(rhs);
        self.timing.solve.add_since(started);
        dw.copy_from_slice(&rhs[..self.primals]);
        for (&unknown, dy) in self.unknown.iter().zip(dy) {
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
