use crate::{EvaluationError, Problem, TripletStructure};

/// How far exact derivatives are from finite differences along one direction, relative to the size
/// of the derivative there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DerivativeErrors {
    /// Of ∇f · d.
    pub gradient: f64,
    /// Of J d, largest over the constraints.
    pub jacobian: f64,
    /// Of ∇²L d, largest over the variables.
    pub hessian: f64,
}

impl DerivativeErrors {
    /// Compares the derivatives of `problem` at `x` along `direction` with fourth-order central
    /// differences of step `step`. An entry missing from a sparsity structure shows as an error.
    ///
    /// # Errors
    /// When a function cannot be evaluated near `x`.
    pub fn along(
        problem: &mut impl Problem,
        x: &[f64],
        direction: &[f64],
        multipliers: &[f64],
        step: f64,
    ) -> Result<Self, EvaluationError> {
        let rows = problem.dimensions().constraints;
        let (jacobian, hessian) = (problem.jacobian_structure(), problem.hessian_structure());

        let mut gradient = vec![0.0; x.len()];
        problem.gradient(x, true, &mut gradient)?;
        let slope: f64 = gradient.iter().zip(direction).map(|(g, d)| g * d).sum();
        let slope_difference =
            difference(x, direction, step, |x| Ok(vec![problem.objective(x, true)?]))?;

        let mut values = vec![0.0; jacobian.len()];
        problem.jacobian(x, true, &mut values)?;
        let mut product = vec![0.0; rows];
        multiply(&jacobian, &values, |row, column, value| {
            product[row] += value * direction[column]
        });
        let product_difference = difference(x, direction, step, |x| {
            let mut g = vec![0.0; rows];
            problem.constraints(x, true, &mut g)?;
            Ok(g)
        })?;

        let mut values = vec![0.0; hessian.len()];
        problem.hessian(x, true, 1.0, multipliers, true, &mut values)?;
        let mut curvature = vec![0.0; x.len()];
        multiply(&hessian, &values, |row, column, value| {
            curvature[row] += value * direction[column];
            if row != column {
                curvature[column] += value * direction[row];
            }
        });
        let curvature_difference = difference(x, direction, step, |x| {
            let mut lagrangian = vec![0.0; x.len()];
            problem.gradient(x, true, &mut lagrangian)?;
            let mut values = vec![0.0; jacobian.len()];
            problem.jacobian(x, true, &mut values)?;
            multiply(&jacobian, &values, |row, column, value| {
                lagrangian[column] += multipliers[row] * value;
            });
            Ok(lagrangian)
        })?;
        Ok(Self {
            gradient: relative_error(&[slope], &slope_difference),
            jacobian: relative_error(&product, &product_difference),
            hessian: relative_error(&curvature, &curvature_difference),
        })
    }

    /// The largest of the three.
    pub fn worst(&self) -> f64 {
        self.gradient.max(self.jacobian).max(self.hessian)
    }
}

fn multiply(structure: &TripletStructure, values: &[f64], mut add: impl FnMut(usize, usize, f64)) {
    for ((&row, &column), &value) in structure.rows.iter().zip(&structure.columns).zip(values) {
        add(row as usize, column as usize, value);
    }
}

fn difference(
    x: &[f64],
    direction: &[f64],
    step: f64,
    mut function: impl FnMut(&[f64]) -> Result<Vec<f64>, EvaluationError>,
) -> Result<Vec<f64>, EvaluationError> {
    let mut total: Vec<f64> = Vec::new();
    for (shift, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
        let moved: Vec<f64> = x.iter().zip(direction).map(|(x, d)| x + shift * step * d).collect();
        let values = function(&moved)?;
        total.resize(values.len(), 0.0);
        for (sum, value) in total.iter_mut().zip(values) {
            *sum += weight * value / (12.0 * step);
        }
    }
    Ok(total)
}

fn relative_error(exact: &[f64], estimate: &[f64]) -> f64 {
    let size = exact.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
    exact.iter().zip(estimate).map(|(a, b)| (a - b).abs() / size).fold(0.0, f64::max)
}
