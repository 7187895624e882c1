//! What the method leaves to Ipopt, and what it says then.

mod common;

use std::time::Duration;

use common::support::hock_schittkowski::*;
use common::{fast, own};
use righting_interior::FailureReason;
use righting_ipopt::*;

fn outcome(
    problem: impl Problem,
    options: &Options,
    x: &[f64],
) -> Result<NlpSolution, FailureReason> {
    let outcome = own(problem, options, &Start::at(x.to_vec())).1;
    outcome.map_err(|error| error.reason)
}

/// min x₀² + x₁²  with  x₀ + x₁² = level, −1 ≤ x₀ ≤ 1 and x₁ within these bounds.
struct Parabola {
    level: f64,
    x1: (f64, f64),
    is_nan: bool,
}

impl Parabola {
    fn new(level: f64, x1: (f64, f64)) -> Self {
        Self { level, x1, is_nan: false }
    }
}

impl Problem for Parabola {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: 2, constraints: 1 }
    }
    fn bounds(&self, bounds: &mut Bounds) {
        bounds.x_lower.copy_from_slice(&[-1.0, self.x1.0]);
        bounds.x_upper.copy_from_slice(&[1.0, self.x1.1]);
        (bounds.g_lower[0], bounds.g_upper[0]) = (self.level, self.level);
    }
    fn jacobian_structure(&self) -> TripletStructure {
        TripletStructure { rows: vec![0, 0], columns: vec![0, 1] }
    }
    fn hessian_structure(&self) -> TripletStructure {
        TripletStructure { rows: vec![0, 1], columns: vec![0, 1] }
    }
    fn objective(&mut self, x: &[f64], _: bool) -> Result<f64, EvaluationError> {
        Ok(x[0] * x[0] + x[1] * x[1])
    }
    fn gradient(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        out.copy_from_slice(&[2.0 * x[0], 2.0 * x[1]]);
        Ok(())
    }
    fn constraints(&mut self, x: &[f64], _: bool, g: &mut [f64]) -> Result<(), EvaluationError> {
        g[0] = x[0] + x[1] * x[1];
        Ok(())
    }
    fn jacobian(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        out.copy_from_slice(&[1.0, 2.0 * x[1]]);
        Ok(())
    }
    fn hessian(
        &mut self,
        _: &[f64],
        _: bool,
        factor: f64,
        multipliers: &[f64],
        _: bool,
        out: &mut [f64],
    ) -> Result<(), EvaluationError> {
        let curvature = if self.is_nan { f64::NAN } else { 2.0 * factor };
        out.copy_from_slice(&[curvature, curvature + 2.0 * multipliers[0]]);
        Ok(())
    }
}

#[test]
fn infeasible_problems_are_left_to_the_restoration_phase() {
    let problem = Parabola::new(3.0, (-1.0, 1.0));
    let found = outcome(problem, &fast(), &[0.5, 0.5]);
    assert!(
        matches!(found, Err(FailureReason::RestorationNeeded | FailureReason::StepComputation)),
        "{found:?}"
    );
    // With a feasible level the same problem is solved.
    let solution = outcome(Parabola::new(1.5, (-1.0, 1.0)), &fast(), &[0.5, 0.5]).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert!((solution.g[0] - 1.5).abs() < 1e-7);
}

#[test]
fn the_error_says_how_far_it_came() {
    let start = Start::at(vec![0.5, 0.5]);
    let (seen, outcome) = own(Parabola::new(3.0, (-1.0, 1.0)), &fast(), &start);
    let error = outcome.unwrap_err();
    assert!(error.iterations > 0, "{error}");
    assert_eq!(error.iterations, seen.last().unwrap().iteration);
    assert!(error.time > Duration::ZERO);
    let expected = format!("{}, after {} iterations", error.reason, error.iterations);
    assert_eq!(error.to_string(), expected);
}

#[test]
fn so_are_fixed_variables_and_time_limits() {
    let found = outcome(Parabola::new(0.5, (0.5, 0.5)), &fast(), &[0.5, 0.5]);
    assert!(matches!(found, Err(FailureReason::FixedVariable { index: 1 })), "{found:?}");
    let found = outcome(Dense(Hs006), &Options { max_cpu_time: 1.0, ..fast() }, Hs006::START);
    assert!(matches!(found, Err(FailureReason::Unsupported("a time limit"))), "{found:?}");
}

#[test]
fn every_option_is_followed_or_refused() {
    let refused = |options: Options| outcome(Dense(Hs071), &options, Hs071::START).unwrap_err();
    for options in [
        Options { fast_step_computation: false, ..fast() },
        Options { mu_strategy: MuStrategy::Adaptive, ..fast() },
        Options { hessian: righting_ipopt::Hessian::LimitedMemory, ..fast() },
        Options { mu_target: 1e-3, ..fast() },
        Options { obj_scaling_factor: -1.0, ..fast() },
        Options { expect_infeasible: true, ..fast() },
        Options { start_with_resto: true, ..fast() },
        Options { print_level: 5, ..fast() },
        Options { honor_original_bounds: false, ..fast() },
        Options { acceptable_obj_change_tol: 1.0, ..fast() },
        Options { extra: vec![("recalc_y".into(), OptionValue::Text("yes".into()))], ..fast() },
    ] {
        let why = refused(options);
        assert!(matches!(why, FailureReason::Unsupported(_)), "{why:?}");
    }
    let why = refused(Options { tolerance: -1.0, ..fast() });
    assert!(why.to_string().contains("tolerance"), "{why}");
}

#[test]
fn a_start_that_does_not_fit_or_is_no_number_is_refused() {
    for x in [&[1.0][..], &[1.0, f64::NAN, 1.0, 1.0], &[1.0; 5]] {
        let found = outcome(Dense(Hs071), &fast(), x);
        assert!(matches!(found, Err(FailureReason::Invalid(_))), "{found:?}");
    }
    let nan =
        Multipliers { constraints: vec![0.0, f64::NAN], lower: vec![0.0; 4], upper: vec![0.0; 4] };
    let start = Start { x: Hs071::START.to_vec(), multipliers: Some(nan) };
    let found = own(Dense(Hs071), &fast(), &start).1.map_err(|error| error.reason);
    assert!(matches!(found, Err(FailureReason::Invalid(_))), "{found:?}");
}

#[test]
fn derivatives_and_steps_that_are_no_numbers_end_it() {
    let problem = Parabola { is_nan: true, ..Parabola::new(0.5, (-1.0, 1.0)) };
    let found = outcome(problem, &fast(), &[0.5, 0.5]);
    assert!(matches!(found, Err(FailureReason::Undefined)), "{found:?}");

    /// Right about everything but the last unknown of a solution.
    struct Blind(BunchKaufman);
    impl LinearSolver for Blind {
        fn analyse(&mut self, n: usize, r: &[i32], c: &[i32]) -> Result<(), LinearSolverError> {
            self.0.analyse(n, r, c)
        }
        fn factor(&mut self, values: &[f64]) -> Factorization {
            self.0.factor(values)
        }
        fn solve(&mut self, right_hand_sides: &mut [f64]) {
            self.0.solve(right_hand_sides);
            *right_hand_sides.last_mut().unwrap() = f64::NAN;
        }
    }
    let start = Start::at(Hs071::START.to_vec());
    let mut solver = Blind(BunchKaufman::default());
    let found = righting_interior::solve(&mut Dense(Hs071), &fast(), &start, &mut solver, |_| {
        Control::Continue
    });
    let error = found.unwrap_err();
    assert!(matches!(error.reason, FailureReason::StepComputation), "{error}");
}
