use righting_nlp::{LinearSolver, Options, Problem, ReducedHessian};

use crate::barrier::slope;
use crate::error::FailureReason;
use crate::inertia_correction::InertiaCorrection;
use crate::iterate::Iterate;
use crate::linear_system::{LinearSystem, Regularization};
use crate::norm::{are_finite, max_norm};
use crate::program::Program;

/// A direction (d_w, d_y, d_z) of all unknowns.
#[derive(Debug, Clone)]
pub(crate) struct SearchDirection {
    pub(crate) w: Vec<f64>,
    pub(crate) y: Vec<f64>,
    pub(crate) z: Vec<f64>,
}

impl SearchDirection {
    pub(crate) fn zero(primals: usize, constraints: usize, bounds: usize) -> Self {
        Self { w: vec![0.0; primals], y: vec![0.0; constraints], z: vec![0.0; bounds] }
    }

    pub(crate) fn is_finite(&self) -> bool {
        let Self { w, y, z } = self;
        are_finite(w) && are_finite(y) && are_finite(z)
    }

    /// ∇φᵀ d_w of the barrier function.
    pub(crate) fn slope<P: Problem + ?Sized>(
        &self,
        program: &Program<'_, P>,
        iterate: &Iterate,
        mu: f64,
    ) -> f64 {
        let bounds = program.bounds.iter().zip(&iterate.point.distances);
        let of_bounds: f64 = bounds
            .map(|(bound, distance)| slope(bound, *distance, mu) * self.w[bound.index()])
            .sum();
        of_bounds + iterate.gradient.iter().zip(&self.w).map(|(g, dw)| g * dw).sum::<f64>()
    }
}

/// Newton's method on the primal–dual equations of a barrier problem (W&B eqs. 9 to 13).
pub(crate) struct NewtonSystem<'s, L: ?Sized> {
    pub(crate) linear: LinearSystem<'s, L>,
    correction: InertiaCorrection,
    /// Σ of w, the sum of z/δ over its bounds.
    sigma: Vec<f64>,
    /// ∇φ + Jᵀ y, the right-hand side of w.
    dual_residuals: Vec<f64>,
}

impl<'s, L: LinearSolver + ?Sized> NewtonSystem<'s, L> {
    pub(crate) fn new(linear: LinearSystem<'s, L>, options: &Options) -> Self {
        let primals = linear.matrix.primals();
        Self {
            linear,
            correction: InertiaCorrection::new(options),
            sigma: vec![0.0; primals],
            dual_residuals: vec![0.0; primals],
        }
    }

    /// The direction from an iterate, whose Jacobian and Hessian are in the system already. Returns
    /// the regularisation of the Hessian.
    pub(crate) fn find_direction<P: Problem + ?Sized>(
        &mut self,
        program: &Program<'_, P>,
        iterate: &Iterate,
        mu: f64,
        direction: &mut SearchDirection,
    ) -> Result<f64, FailureReason> {
        self.weigh_bounds(program, iterate);
        self.dual_residuals.copy_from_slice(&iterate.lagrangian_gradient);
        let bounds = program.bounds.iter().zip(&iterate.point.distances);
        for ((bound, distance), z) in bounds.zip(&iterate.z) {
            self.dual_residuals[bound.index()] += bound.sign() * z + slope(bound, *distance, mu);
        }
        let regularization = self.correction.factor(&mut self.linear, &self.sigma, mu)?;
        let residuals = &iterate.point.residuals;
        self.solve(program, iterate, mu, residuals, direction);
        if direction.is_finite() { Ok(regularization) } else { Err(FailureReason::StepComputation) }
    }

    /// The direction with these residuals of the constraints, by the last factorisation.
    pub(crate) fn solve<P: Problem + ?Sized>(
        &mut self,
        program: &Program<'_, P>,
        iterate: &Iterate,
        mu: f64,
        residuals: &[f64],
        direction: &mut SearchDirection,
    ) {
        let SearchDirection { w, y, z: dz } = direction;
        self.linear.solve(&self.dual_residuals, residuals, w, y);
        w.iter_mut().chain(y).for_each(|step| *step = -*step);
        let bounds = program.bounds.iter().zip(&iterate.point.distances);
        for ((dz, z), (bound, distance)) in dz.iter_mut().zip(&iterate.z).zip(bounds) {
            // W&B eq. 12.
            *dz = (mu - z * bound.sign() * w[bound.index()]) / distance - z;
        }
    }

    /// The multipliers y that leave the least gradient of the Lagrangian (W&B eq. 36): the system
    /// with an identity in place of W + Σ. None where it has no solution, or where one of them is
    /// larger than the option `constr_mult_init_max`.
    pub(crate) fn least_squares_multipliers(
        &mut self,
        iterate: &Iterate,
        options: &Options,
    ) -> Option<Vec<f64>> {
        let most = options.constr_mult_init_max;
        if most <= 0.0 || iterate.y.is_empty() {
            return None;
        }
        self.linear.matrix.hessian_mut().fill(0.0);
        self.sigma.fill(1.0);
        let outcome = self.linear.factor(&self.sigma, Regularization::default());
        if !self.linear.has_right_inertia(outcome) {
            return None;
        }
        // With y = 0 the Lagrangian's gradient is what y has to cancel.
        let rhs: Vec<f64> = iterate.lagrangian_gradient.iter().map(|gradient| -gradient).collect();
        let (zeros, mut y) = (vec![0.0; iterate.y.len()], vec![0.0; iterate.y.len()]);
        self.linear.solve(&rhs, &zeros, &mut vec![0.0; rhs.len()], &mut y);
        (are_finite(&y) && max_norm(&y) <= most).then_some(y)
    }

    /// The definiteness of the reduced Hessian at an iterate, whose Jacobian and Hessian are in the
    /// system already.
    pub(crate) fn reduced_hessian<P: Problem + ?Sized>(
        &mut self,
        program: &Program<'_, P>,
        iterate: &Iterate,
    ) -> ReducedHessian {
        self.weigh_bounds(program, iterate);
        let outcome = self.linear.factor(&self.sigma, Regularization::default());
        match self.linear.has_right_inertia(outcome) {
            true => ReducedHessian::PositiveDefinite,
            false => ReducedHessian::NotPositiveDefinite,
        }
    }

    fn weigh_bounds<P: Problem + ?Sized>(&mut self, program: &Program<'_, P>, iterate: &Iterate) {
        self.sigma.fill(0.0);
        let bounds = program.bounds.iter().zip(&iterate.point.distances);
        for ((bound, distance), z) in bounds.zip(&iterate.z) {
            self.sigma[bound.index()] += z / distance;
        }
    }
}
