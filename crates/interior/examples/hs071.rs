//! Problem 71 of Hock and Schittkowski, *Test Examples for Nonlinear Programming Codes* (1981),
//! without Ipopt:
//!
//! ```text
//! min x₀x₃(x₀+x₁+x₂) + x₂   s.t.  x₀x₁x₂x₃ ≥ 25,  ‖x‖² = 40,  1 ≤ x ≤ 5
//! ```
//!
//! `cargo run -p righting-interior --example hs071`

use righting_interior::{InteriorError, solve};
use righting_nlp::*;

struct Hs071;

impl Problem for Hs071 {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: 4, constraints: 2 }
    }

    fn bounds(&self, bounds: &mut Bounds) {
        bounds.x_lower.fill(1.0);
        bounds.x_upper.fill(5.0);
        bounds.g_lower.copy_from_slice(&[25.0, 40.0]);
        bounds.g_upper[1] = 40.0;
    }

    /// Both constraints depend on every variable.
    fn jacobian_structure(&self) -> TripletStructure {
        TripletStructure {
            rows: vec![0, 0, 0, 0, 1, 1, 1, 1],
            columns: vec![0, 1, 2, 3, 0, 1, 2, 3],
        }
    }

    /// The lower triangle, row by row.
    fn hessian_structure(&self) -> TripletStructure {
        TripletStructure {
            rows: vec![0, 1, 1, 2, 2, 2, 3, 3, 3, 3],
            columns: vec![0, 0, 1, 0, 1, 2, 0, 1, 2, 3],
        }
    }

    fn objective(&mut self, x: &[f64], _new_x: bool) -> Result<f64, EvaluationError> {
        Ok(x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2])
    }

    fn gradient(
        &mut self,
        x: &[f64],
        _new_x: bool,
        gradient: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let sum = x[0] + x[1] + x[2];
        gradient.copy_from_slice(&[
            x[3] * (x[0] + sum),
            x[0] * x[3],
            x[0] * x[3] + 1.0,
            x[0] * sum,
        ]);
        Ok(())
    }

    fn constraints(
        &mut self,
        x: &[f64],
        _new_x: bool,
        g: &mut [f64],
    ) -> Result<(), EvaluationError> {
        g[0] = x.iter().product();
        g[1] = x.iter().map(|x| x * x).sum();
        Ok(())
    }

    fn jacobian(
        &mut self,
        x: &[f64],
        _new_x: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
        values[..4].copy_from_slice(&[b * c * d, a * c * d, a * b * d, a * b * c]);
        values[4..].copy_from_slice(&[2.0 * a, 2.0 * b, 2.0 * c, 2.0 * d]);
        Ok(())
    }

    fn hessian(
        &mut self,
        x: &[f64],
        _new_x: bool,
        objective_factor: f64,
        multipliers: &[f64],
        _new_multipliers: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let [a, b, c, d] = [x[0], x[1], x[2], x[3]];
        let (f, product, norm) = (objective_factor, multipliers[0], 2.0 * multipliers[1]);
        values.copy_from_slice(&[
            f * 2.0 * d + norm,
            f * d + product * c * d,
            norm,
            f * d + product * b * d,
            product * a * d,
            norm,
            f * (2.0 * a + b + c) + product * b * c,
            f * a + product * a * c,
            f * a + product * a * b,
            norm,
        ]);
        Ok(())
    }
}

fn main() -> Result<(), InteriorError> {
    let options = Options { fast_step_computation: true, ..Options::default() };
    let start = Start::at(vec![1.0, 5.0, 5.0, 1.0]);
    let mut linear_solver = BunchKaufman::default();
    let solution = solve(&mut Hs071, &options, &start, &mut linear_solver, |iteration| {
        println!(
            "{:>2}  f = {:9.6}  violation {:.1e}  dual infeasibility {:.1e}  mu {:.0e}",
            iteration.iteration,
            iteration.objective,
            iteration.primal_infeasibility,
            iteration.dual_infeasibility,
            iteration.mu
        );
        Control::Continue
    })?;
    println!("{}: f = {:.6} at x = {:.6?}", solution.status, solution.objective, solution.x);
    println!("multipliers of the constraints: {:.6?}", solution.multipliers.constraints);
    println!("reduced Hessian: {:?}", solution.reduced_hessian);
    Ok(())
}
