//! Rosenbrock's valley between walls, solved again and again as one of them comes nearer, each time
//! warm from the solution before:
//!
//! ```text
//! min (1 − x₀)² + 100 (x₁ − x₀²)²   s.t.   x₀ ≤ right
//! ```
//!
//! `cargo run -p righting-interior --example rosenbrock`

use righting_interior::{InteriorError, solve};
use righting_nlp::*;

struct Rosenbrock {
    right: f64,
}

impl Problem for Rosenbrock {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: 2, constraints: 0 }
    }

    fn bounds(&self, bounds: &mut Bounds) {
        bounds.x_upper[0] = self.right;
    }

    fn hessian_structure(&self) -> TripletStructure {
        TripletStructure { rows: vec![0, 1, 1], columns: vec![0, 0, 1] }
    }

    fn objective(&mut self, x: &[f64], _new_x: bool) -> Result<f64, EvaluationError> {
        Ok((1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2))
    }

    fn gradient(
        &mut self,
        x: &[f64],
        _new_x: bool,
        gradient: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let height = x[1] - x[0] * x[0];
        gradient.copy_from_slice(&[2.0 * (x[0] - 1.0) - 400.0 * x[0] * height, 200.0 * height]);
        Ok(())
    }

    fn hessian(
        &mut self,
        x: &[f64],
        _new_x: bool,
        objective_factor: f64,
        _multipliers: &[f64],
        _new_multipliers: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        values.copy_from_slice(&[
            objective_factor * (2.0 - 400.0 * x[1] + 1200.0 * x[0] * x[0]),
            objective_factor * -400.0 * x[0],
            objective_factor * 200.0,
        ]);
        Ok(())
    }
}

fn main() -> Result<(), InteriorError> {
    let mut options = Options { fast_step_computation: true, ..Options::default() };
    let mut start = Start::at(vec![-1.2, 1.0]);
    let mut linear_solver = BunchKaufman::default();
    for right in [2.0, 0.9, 0.8, 0.7] {
        let mut problem = Rosenbrock { right };
        let go_on = |_: &Iteration| Control::Continue;
        let solution = solve(&mut problem, &options, &start, &mut linear_solver, go_on)?;
        println!(
            "x0 <= {right}: {} in {:2} iterations, x = {:.6?}, multiplier {:.3e}",
            solution.status, solution.iterations, solution.x, solution.multipliers.upper[0]
        );
        start = solution.to_start();
        options.mu_init = 1e-3;
    }
    Ok(())
}
