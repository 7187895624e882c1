//! Rosenbrock's valley, a problem without constraints (H. H. Rosenbrock, *The Computer Journal* 3,
//! 1960):
//!
//! ```text
//! min (1 − x₀)² + 100 (x₁ − x₀²)²
//! ```
//!
//! `cargo run -p righting-ipopt --example rosenbrock`

use righting_ipopt::*;

struct Rosenbrock;

impl Problem for Rosenbrock {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: 2, constraints: 0 }
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

fn main() -> Result<(), SolveError> {
    let start = Start::at(vec![-1.2, 1.0]);
    let options = Options { tolerance: 1e-10, ..Options::default() };
    let solution = solve(&mut Rosenbrock, &options, &start, |iteration| {
        println!("{:>3}  f = {:.3e}", iteration.iteration, iteration.objective);
        Control::Continue
    })?;
    println!("{}: x = {:?}", solution.status, solution.x);
    Ok(())
}
