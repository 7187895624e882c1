//! The residuals of optimality against points whose optimum is known in closed form.

use righting_nlp::{
    Bounds, Declarations, Dimensions, EvaluationError, Multipliers, OptimalityResiduals, Problem,
    TripletStructure,
};

/// min x₀² + x₁²,  x₀ + x₁ = 2,  x₀ − x₁ ≤ 1,  x₁ ≥ `lowest`. Without the bound the optimum is (1, 1) with
/// λ = (−2, 0); with x₁ ≥ 1.5 it is (0.5, 1.5) with λ = (−1, 0) and z_L = (0, 2).
struct Program {
    lowest: f64,
    is_defined: bool,
}

impl Problem for Program {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: 2, constraints: 2 }
    }

    fn bounds(&self, bounds: &mut Bounds) {
        bounds.x_lower[1] = self.lowest;
        (bounds.g_lower[0], bounds.g_upper[0]) = (2.0, 2.0);
        bounds.g_upper[1] = 1.0;
    }

    fn jacobian_structure(&self) -> TripletStructure {
        TripletStructure { rows: vec![0, 0, 1, 1], columns: vec![0, 1, 0, 1] }
    }

    fn hessian_structure(&self) -> TripletStructure {
        TripletStructure { rows: vec![0, 1], columns: vec![0, 1] }
    }

    fn objective(&mut self, x: &[f64], _: bool) -> Result<f64, EvaluationError> {
        Ok(x[0] * x[0] + x[1] * x[1])
    }

    fn gradient(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        out.copy_from_slice(&[2.0 * x[0], 2.0 * x[1]]);
        if self.is_defined { Ok(()) } else { Err(EvaluationError) }
    }

    fn constraints(&mut self, x: &[f64], _: bool, g: &mut [f64]) -> Result<(), EvaluationError> {
        g.copy_from_slice(&[x[0] + x[1], x[0] - x[1]]);
        Ok(())
    }

    fn jacobian(&mut self, _: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        out.copy_from_slice(&[1.0, 1.0, 1.0, -1.0]);
        Ok(())
    }

    fn hessian(
        &mut self,
        _: &[f64],
        _: bool,
        factor: f64,
        _: &[f64],
        _: bool,
        out: &mut [f64],
    ) -> Result<(), EvaluationError> {
        out.fill(2.0 * factor);
        Ok(())
    }
}

fn residuals(
    lowest: f64,
    x: [f64; 2],
    constraints: [f64; 2],
    lower: [f64; 2],
) -> OptimalityResiduals {
    let mut program = Program { lowest, is_defined: true };
    let declared = Declarations::of(&program).expect("a program");
    let multipliers = Multipliers {
        constraints: constraints.to_vec(),
        lower: lower.to_vec(),
        upper: vec![0.0; 2],
    };
    OptimalityResiduals::of(&mut program, &declared, &x, &multipliers).expect("defined")
}

#[test]
fn an_optimum_leaves_none() {
    let free = residuals(f64::NEG_INFINITY, [1.0, 1.0], [-2.0, 0.0], [0.0; 2]);
    assert_eq!(free.largest(), 0.0);
    let bounded = residuals(1.5, [0.5, 1.5], [-1.0, 0.0], [0.0, 2.0]);
    assert_eq!(bounded.largest(), 0.0);
}

#[test]
fn each_condition_has_its_own() {
    // Off the line by 0.1, and off stationarity by twice that.
    let off = residuals(f64::NEG_INFINITY, [1.1, 1.0], [-2.0, 0.0], [0.0; 2]);
    assert!((off.violation - 0.1).abs() < 1e-15 && (off.stationarity - 0.2).abs() < 1e-15);
    assert_eq!(off.complementarity, 0.0);
    // A multiplier of a bound 0.5 away: stationary by chance, and no optimum.
    let slack = residuals(1.0, [0.5, 1.5], [-1.0, 0.0], [0.0, 2.0]);
    assert_eq!((slack.stationarity, slack.violation, slack.complementarity), (0.0, 0.0, 1.0));
    // The same of an inequality that has room of 1 + 1.
    let inequality = residuals(1.5, [0.5, 1.5], [-1.0, 0.5], [0.0, 2.0]);
    assert_eq!((inequality.stationarity, inequality.complementarity), (0.5, 1.0));
    // A multiplier for a side that has no bound.
    let unbounded = residuals(f64::NEG_INFINITY, [1.0, 1.0], [-2.0, -0.25], [0.0; 2]);
    assert_eq!(unbounded.complementarity, 0.25);
    // A bound that is passed is violated, and not at a distance.
    let passed = residuals(1.5 + 1e-8, [0.5, 1.5], [-1.0, 0.0], [0.0, 2.0]);
    assert!(passed.violation > 0.9e-8 && passed.complementarity == 0.0);
}

#[test]
fn what_is_not_defined_has_none_and_not_a_number_is_not_small() {
    let mut program = Program { lowest: 0.0, is_defined: false };
    let declared = Declarations::of(&program).expect("a program");
    let zero = Multipliers { constraints: vec![0.0; 2], lower: vec![0.0; 2], upper: vec![0.0; 2] };
    let found = OptimalityResiduals::of(&mut program, &declared, &[1.0, 1.0], &zero);
    assert_eq!(found, Err(EvaluationError));
    let nan = residuals(0.0, [f64::NAN, 1.0], [-2.0, 0.0], [0.0; 2]);
    assert!(nan.largest().is_nan());
}
