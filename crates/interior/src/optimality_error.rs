use righting_nlp::Problem;

use crate::iterate::Iterate;
use crate::norm::{larger, max_norm, sum_norm};
use crate::program::{Program, Row};

/// s_max: multipliers larger than this on average are divided out of the errors (W&B after eq. 6;
/// option `s_max`).
const S_MAX: f64 = 100.0;

/// The parts of the optimality error E (W&B eq. 5) of the scaled problem; maximum norms.
pub(crate) struct OptimalityError {
    /// Of the gradient of the Lagrangian.
    pub(crate) dual: f64,
    /// Of the residuals c(w), slacks and all.
    pub(crate) primal: f64,
    /// Of the constraints themselves: how far g is from where it should be, whatever the slacks
    /// are. This is what the termination test looks at, since slacks are not the caller's.
    pub(crate) violation: f64,
    pub(crate) unscaled_violation: f64,
    /// s_d.
    pub(crate) dual_scale: f64,
    /// s_c.
    pub(crate) complementarity_scale: f64,
}

impl OptimalityError {
    pub(crate) fn of<P: Problem + ?Sized>(program: &Program<'_, P>, iterate: &Iterate) -> Self {
        let (residuals, distances) = (&iterate.point.residuals, &iterate.point.distances);
        let (mut violation, mut unscaled_violation) = (0.0_f64, 0.0_f64);
        let mut outside = |row: usize, by: f64| {
            violation = violation.max(by);
            unscaled_violation = unscaled_violation.max(by / program.scaling.of_row(row));
        };
        for (row, (kind, c)) in program.rows.iter().zip(residuals).enumerate() {
            if let Row::Equality(_) = kind {
                outside(row, c.abs());
            }
        }
        for (bound, distance) in program.bounds.iter().zip(distances) {
            if let Some(row) = program.row_of(bound) {
                // g − bound = (s − bound) + (g − s).
                outside(row, -(distance + bound.sign() * residuals[row]));
            }
        }
        let sum_z: f64 = iterate.z.iter().sum();
        let sum_y = sum_norm(&iterate.y);
        let scale = |sum: f64, count: usize| match count {
            0 => 1.0,
            _ => (sum / count as f64).max(S_MAX) / S_MAX,
        };
        Self {
            dual: max_norm(&iterate.lagrangian_gradient),
            primal: max_norm(residuals),
            violation,
            unscaled_violation,
            dual_scale: scale(sum_y + sum_z, iterate.y.len() + iterate.z.len()),
            complementarity_scale: scale(sum_z, iterate.z.len()),
        }
    }
}

/// max |δ z − μ|.
pub(crate) fn complementarity(iterate: &Iterate, mu: f64) -> f64 {
    let products = iterate.point.distances.iter().zip(&iterate.z);
    products.map(|(distance, z)| (distance * z - mu).abs()).fold(0.0, larger)
}
