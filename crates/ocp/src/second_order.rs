//! The second-order conditions at the end of a solve.

use righting_ipopt::SolveError;
use righting_nlp::{AugmentedSystem, Declarations, Factorization, LinearSolver, NlpError, Problem};

use crate::error::OcpError;
use crate::kkt::StageKkt;
use crate::multiple_shooting::MultipleShooting;
use crate::primal_dual_point::PrimalDualPoint;
use crate::samples::Samples;

/// By how much Ipopt relaxes bounds, relative to their size (`bound_relax_factor`).
const RELAXED: f64 = 1e-8;
/// What is first added to the diagonal to find a direction of negative curvature.
const FIRST_SHIFT: f64 = 1e-6;
/// How much more each time that it is not enough.
const SHIFT_GROWTH: f64 = 2.0;
/// Shifts tried: up to 1e12.
const SHIFTS: usize = 60;
/// Inverse iterations; the shift is less than twice the curvature sought.
const INVERSE_ITERATIONS: usize = 20;

/// How the Lagrangian curves along the constraints, those in force held.
///
/// With Σ the barrier terms of bounds and inequalities, the matrix
///
/// ```text
/// ⎡ W + Σ_x          J_cᵀ   J_dᵀ ⎤
/// ⎢          Σ_s            −I   ⎥
/// ⎢ J_c                          ⎥
/// ⎣ J_d     −I                   ⎦
/// ```
///
/// has one negative eigenvalue a constraint, and none that is zero, exactly where the reduced
/// Hessian of the barrier problem is positive definite (Gould, *Mathematical Programming* 32, 1985).
/// Ipopt looks at the matrix of every step it takes, but not at that of the point it returns;
/// [`OcpSolution::reduced_hessian`](crate::OcpSolution::reduced_hessian) has what an optimizer that
/// does look found.
#[derive(Debug, Clone, PartialEq)]
pub enum Curvature {
    /// Positive in every direction: a first-order point is a strict local minimum (Nocedal & Wright,
    /// *Numerical Optimization*, 2nd ed., theorem 12.6).
    Positive,
    /// Negative in some direction: a first-order point is a saddle or a maximum.
    Negative {
        /// The direction of most negative curvature, as changes of the controls, one row a step. Its
        /// sign means nothing, its largest entry is one.
        direction: Samples,
    },
    /// Zero in some direction, as far as the numbers tell.
    Zero,
}

impl MultipleShooting<'_> {
    /// How the Lagrangian curves at `point`: one evaluation of the second derivatives and one
    /// factorisation by stages, and a few more where the curvature is not positive.
    ///
    /// # Errors
    /// [`OcpError::Dimension`] when the point belongs to another problem or grid,
    /// [`OcpError::Solve`] when the stage solver refuses the system.
    pub fn curvature(&mut self, point: &PrimalDualPoint) -> Result<Curvature, OcpError> {
        if point.layout != self.layout() {
            return Err(OcpError::Dimension {
                what: "point",
                expected: self.layout().variables(),
                found: point.z.len(),
            });
        }
        let mut system = BarrierSystem::at(self, point).map_err(SolveError::Invalid)?;
        let constraints = self.layout().constraints();
        let positive = Factorization::Regular { negative_eigenvalues: constraints };
        let mut stages = StageKkt::new(&self.stage_dims()).stop_at_excess();
        stages
            .analyse(system.matrix.order(), system.matrix.rows(), system.matrix.columns())
            .map_err(SolveError::LinearSolver)?;
        if stages.factor(system.matrix.values()) == positive {
            return Ok(Curvature::Positive);
        }
        let mut shift = FIRST_SHIFT;
        for _ in 0..SHIFTS {
            if stages.factor(system.shifted(shift)) == positive {
                system.shifted(0.0);
                return Ok(self.negative_curvature(&system.matrix, &mut stages));
            }
            shift *= SHIFT_GROWTH;
        }
        Ok(Curvature::Zero)
    }

    /// Inverse iteration (Golub & Van Loan, *Matrix Computations*, 4th ed., section 7.6.1) on the
    /// reduced Hessian: with Z a basis of the constraints' null space and
    /// δ the shift, solutions with a right-hand side b of the variables alone are
    /// Z (Zᵀ(W + Σ + δ)Z)⁻¹ Zᵀ b, and turn towards the most negative curvature.
    fn negative_curvature(&self, system: &AugmentedSystem, stages: &mut StageKkt) -> Curvature {
        let layout = self.layout();
        let mut direction = vec![0.0; system.order()];
        // No symmetry of a maneuver leaves this direction alone.
        for (i, value) in direction[..system.variables()].iter_mut().enumerate() {
            *value = (1.0 + i as f64).sin();
        }
        for _ in 0..INVERSE_ITERATIONS {
            direction[system.variables()..].fill(0.0);
            stages.solve(&mut direction);
            let moved = &direction[..system.variables()];
            let largest = moved.iter().fold(0.0_f64, |largest, d| largest.max(d.abs()));
            if !(largest.is_finite() && largest > 0.0) {
                return Curvature::Zero;
            }
            direction.iter_mut().for_each(|d| *d /= largest);
        }
        if system.primal_curvature(&direction) >= 0.0 {
            return Curvature::Zero;
        }
        let of_step = |step| &direction[layout.control(step)];
        let steps = layout.dimensions().steps;
        let largest = (0..steps).flat_map(of_step).fold(0.0_f64, |a, d| a.max(d.abs()));
        let mut changes = Samples::new(layout.dimensions().controls);
        for step in 0..steps {
            let row: Vec<f64> = of_step(step).iter().map(|d| d / largest).collect();
            changes.push(&row);
        }
        Curvature::Negative { direction: changes }
    }
}

/// The augmented system at a point, without regularisation.
struct BarrierSystem {
    matrix: AugmentedSystem,
    /// The barrier terms Σ of variables and slacks.
    sigma: Vec<f64>,
}

impl BarrierSystem {
    fn at(program: &mut MultipleShooting<'_>, point: &PrimalDualPoint) -> Result<Self, NlpError> {
        let declared = Declarations::of(program)?;
        let mut matrix = AugmentedSystem::new(&declared);
        // The shooting problem can be evaluated anywhere: its functions have no domain to leave.
        let mut constraint_values = vec![0.0; matrix.constraints()];
        let z = &point.z;
        let _ = program.constraints(z, true, &mut constraint_values);
        let _ = program.jacobian(z, false, matrix.jacobian_mut());
        let _ = program.hessian(z, false, 1.0, &point.constraints, true, matrix.hessian_mut());

        let Declarations { x_lower, x_upper, g_lower, g_upper, .. } = &declared;
        let of_variables = (0..matrix.variables()).map(|i| {
            curvature_of_barrier(point.lower[i], z[i] - x_lower[i], x_lower[i])
                + curvature_of_barrier(point.upper[i], x_upper[i] - z[i], x_upper[i])
        });
        let of_slacks = declared.inequalities().map(|row| {
            let (force, value) = (point.constraints[row], constraint_values[row]);
            curvature_of_barrier(-force, value - g_lower[row], g_lower[row])
                + curvature_of_barrier(force, g_upper[row] - value, g_upper[row])
        });
        let sigma: Vec<f64> = of_variables.chain(of_slacks).collect();
        matrix.diagonal_mut().copy_from_slice(&sigma);
        Ok(Self { matrix, sigma })
    }

    /// The values with `shift` added to the diagonal of the variables.
    fn shifted(&mut self, shift: f64) -> &[f64] {
        let variables = self.matrix.variables();
        let diagonal = self.matrix.diagonal_mut();
        diagonal.copy_from_slice(&self.sigma);
        diagonal[..variables].iter_mut().for_each(|value| *value += shift);
        self.matrix.values()
    }
}

/// Σ = v / d of a bound with multiplier `force` at this distance; zero without a bound.
fn curvature_of_barrier(force: f64, distance: f64, bound: f64) -> f64 {
    if !bound.is_finite() {
        return 0.0;
    }
    let relaxed = RELAXED * bound.abs().max(1.0);
    force.max(0.0) / (distance + relaxed).max(f64::EPSILON)
}

#[cfg(test)]
mod tests;
