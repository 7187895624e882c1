use crate::{Declarations, EvaluationError, Multipliers, Problem};

/// Multipliers larger than this on average are divided out of the residuals (Wächter & Biegler,
/// *Mathematical Programming* 106, 2006, after eq. 6; Ipopt's `s_max`).
const S_MAX: f64 = 100.0;

/// By how much a point with its multipliers misses the first-order conditions of optimality, of the problem
/// as it was given: no scaling, and bounds as they were declared.
///
/// Maximum norms, evaluated from the problem itself. What an optimizer says of the same point has no part
/// in them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OptimalityResiduals {
    /// ‖∇f + ∇gᵀλ − z_L + z_U‖ over s_d (W&B eq. 5).
    pub stationarity: f64,
    /// Largest violation of a bound or a constraint.
    pub violation: f64,
    /// Largest product of a distance from a bound and its multiplier, over s_c (W&B eq. 5). A bound that is
    /// passed is at no distance: by how much it is passed is `violation`.
    pub complementarity: f64,
}

impl OptimalityResiduals {
    /// Those of a point; its vectors must have the problem's sizes.
    ///
    /// # Errors
    /// [`EvaluationError`] where the problem is not defined there.
    ///
    /// # Panics
    /// A vector has another length.
    pub fn of<P: Problem + ?Sized>(
        problem: &mut P,
        declared: &Declarations,
        x: &[f64],
        multipliers: &Multipliers,
    ) -> Result<Self, EvaluationError> {
        let Multipliers { constraints, lower, upper } = multipliers;
        let mut g = vec![0.0; declared.constraints];
        problem.constraints(x, true, &mut g)?;
        let mut lagrangian = vec![0.0; declared.variables];
        problem.gradient(x, false, &mut lagrangian)?;
        let mut jacobian = vec![0.0; declared.jacobian.len()];
        problem.jacobian(x, false, &mut jacobian)?;
        let places = declared.jacobian.rows.iter().zip(&declared.jacobian.columns);
        for ((&row, &column), value) in places.zip(&jacobian) {
            lagrangian[column as usize] += value * constraints[row as usize];
        }
        for (gradient, (lower, upper)) in lagrangian.iter_mut().zip(lower.iter().zip(upper)) {
            *gradient += upper - lower;
        }
        let bounds = declared.x_lower.iter().zip(&declared.x_upper);
        let of_variables = x.iter().zip(bounds).zip(lower.iter().zip(upper)).map(
            |((value, (x_lower, x_upper)), (z_lower, z_upper))| match x_lower == x_upper {
                // A variable that is fixed has no side.
                true => 0.0,
                false => product(value - x_lower, *z_lower).max(product(x_upper - value, *z_upper)),
            },
        );
        let bounds = declared.g_lower.iter().zip(&declared.g_upper);
        let of_constraints = g.iter().zip(bounds).zip(constraints).map(
            |((value, (lower, upper)), multiplier)| match (lower == upper, *multiplier > 0.0) {
                (true, _) => 0.0,
                (false, true) => product(upper - value, *multiplier),
                (false, false) => product(value - lower, *multiplier),
            },
        );
        let complementarity = of_variables.chain(of_constraints).fold(0.0, larger);
        let sum = |values: &[f64]| values.iter().map(|value| value.abs()).sum::<f64>();
        let of_bounds = sum(lower) + sum(upper);
        let scale = |sum: f64, count: usize| (sum / count.max(1) as f64).max(S_MAX) / S_MAX;
        let all = 2 * declared.variables + declared.constraints;
        Ok(Self {
            stationarity: lagrangian.iter().map(|entry| entry.abs()).fold(0.0, larger)
                / scale(of_bounds + sum(constraints), all),
            violation: declared.violation(x, &g),
            complementarity: complementarity / scale(of_bounds, 2 * declared.variables),
        })
    }

    /// The largest of the three; NaN if one is.
    pub fn largest(&self) -> f64 {
        [self.stationarity, self.violation, self.complementarity].into_iter().fold(0.0, larger)
    }
}

/// |distance · multiplier|, and the multiplier itself where there is no bound for it.
fn product(distance: f64, multiplier: f64) -> f64 {
    match (distance.is_infinite(), multiplier == 0.0) {
        (_, true) => 0.0,
        (true, false) => multiplier.abs(),
        (false, false) => (distance.max(0.0) * multiplier).abs(),
    }
}

/// The larger of two sizes; not a number if one is not.
fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}
