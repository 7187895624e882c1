//! A program's derivatives against finite differences, before any optimizer sees it:
//!
//! ```text
//! min (1 − x₀)² + 100 (x₁ − x₀²)²   s.t.   x₀² + x₁² ≤ 1
//! ```
//!
//! `cargo run -p righting-nlp --example derivatives`

use righting_nlp::*;

struct Rosenbrock {
    /// What one entry of the Jacobian is multiplied by: a mistake where it is not one.
    mistake: f64,
}

impl Problem for Rosenbrock {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: 2, constraints: 1 }
    }

    fn bounds(&self, bounds: &mut Bounds) {
        bounds.g_upper[0] = 1.0;
    }

    fn jacobian_structure(&self) -> TripletStructure {
        TripletStructure { rows: vec![0, 0], columns: vec![0, 1] }
    }

    fn hessian_structure(&self) -> TripletStructure {
        TripletStructure { rows: vec![0, 1, 1], columns: vec![0, 0, 1] }
    }

    fn objective(&mut self, x: &[f64], _: bool) -> Result<f64, EvaluationError> {
        Ok((1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2))
    }

    fn gradient(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        let height = x[1] - x[0] * x[0];
        out.copy_from_slice(&[2.0 * (x[0] - 1.0) - 400.0 * x[0] * height, 200.0 * height]);
        Ok(())
    }

    fn constraints(&mut self, x: &[f64], _: bool, g: &mut [f64]) -> Result<(), EvaluationError> {
        g[0] = x[0] * x[0] + x[1] * x[1];
        Ok(())
    }

    fn jacobian(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        out.copy_from_slice(&[2.0 * x[0], 2.0 * x[1] * self.mistake]);
        Ok(())
    }

    fn hessian(
        &mut self,
        x: &[f64],
        _: bool,
        factor: f64,
        multipliers: &[f64],
        _: bool,
        out: &mut [f64],
    ) -> Result<(), EvaluationError> {
        out.copy_from_slice(&[
            factor * (2.0 - 400.0 * x[1] + 1200.0 * x[0] * x[0]) + 2.0 * multipliers[0],
            factor * -400.0 * x[0],
            factor * 200.0 + 2.0 * multipliers[0],
        ]);
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let declared = Declarations::of(&Rosenbrock { mistake: 1.0 })?;
    println!(
        "{} variables, {} constraints, {} entries in the Jacobian, {} in the Hessian",
        declared.variables,
        declared.constraints,
        declared.jacobian.len(),
        declared.hessian.len()
    );
    let (x, direction, multipliers) = ([-1.2, 1.0], [0.6, 0.8], [0.5]);
    for mistake in [1.0, 1.1] {
        let mut problem = Rosenbrock { mistake };
        let errors = DerivativeErrors::along(&mut problem, &x, &direction, &multipliers, 1e-4)?;
        println!(
            "relative errors: gradient {:.0e}, Jacobian {:.0e}, Hessian {:.0e}",
            errors.gradient, errors.jacobian, errors.hessian
        );
    }
    Ok(())
}
