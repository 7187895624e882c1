//! Starts from a solution.

mod support;

use righting_ipopt::*;
use support::hock_schittkowski::*;
use support::{assert_close, solve_from};

/// As `Options` that suit the start from a solution.
fn warm() -> Options {
    Options {
        mu_init: 1e-8,
        warm_start_bound_push: 1e-9,
        warm_start_bound_frac: 1e-9,
        warm_start_slack_bound_push: 1e-9,
        warm_start_slack_bound_frac: 1e-9,
        warm_start_mult_bound_push: 1e-9,
        ..Options::default()
    }
}

fn restart(start: &Start) -> NlpSolution {
    solve(&mut Dense(Hs071), &warm(), start, |_| Control::Continue).unwrap()
}

#[test]
fn a_solution_is_recognised() {
    let cold = solve_from(&mut Dense(Hs071), Hs071::START, &Options::default());
    let warm = restart(&cold.to_start());
    assert_eq!(warm.status, Status::Solved);
    assert!(cold.iterations >= 6, "{}", cold.iterations);
    assert!(warm.iterations <= 1, "{}", warm.iterations);
    assert_close(&warm.x, &cold.x, 1e-7);
    assert_close(&warm.multipliers.constraints, &cold.multipliers.constraints, 1e-6);
}

#[test]
fn all_three_kinds_of_multipliers_matter() {
    let solution = solve_from(&mut Dense(Hs071), Hs071::START, &Options::default());
    let complete = restart(&solution.to_start()).iterations;
    let without = |change: fn(&mut Multipliers)| {
        let mut start = solution.to_start();
        change(start.multipliers.as_mut().unwrap());
        restart(&start).iterations
    };
    assert!(without(|multipliers| multipliers.constraints.fill(0.0)) > complete);
    assert!(without(|multipliers| multipliers.lower.fill(0.0)) > complete);
    assert!(without(|multipliers| multipliers.upper.fill(1.0)) > complete);
}

#[test]
fn a_neighbouring_problem_takes_fewer_iterations() {
    /// HS100 with another right-hand side, 1 % away.
    struct Neighbour(Dense<Hs100>);
    impl Problem for Neighbour {
        fn dimensions(&self) -> Dimensions {
            self.0.dimensions()
        }
        fn bounds(&self, bounds: &mut Bounds) {
            self.0.bounds(bounds);
            bounds.g_lower[0] = -1.27;
        }
        fn jacobian_structure(&self) -> TripletStructure {
            self.0.jacobian_structure()
        }
        fn hessian_structure(&self) -> TripletStructure {
            self.0.hessian_structure()
        }
        fn objective(&mut self, x: &[f64], new: bool) -> Result<f64, EvaluationError> {
            self.0.objective(x, new)
        }
        fn gradient(&mut self, x: &[f64], n: bool, o: &mut [f64]) -> Result<(), EvaluationError> {
            self.0.gradient(x, n, o)
        }
        fn constraints(
            &mut self,
            x: &[f64],
            n: bool,
            g: &mut [f64],
        ) -> Result<(), EvaluationError> {
            self.0.constraints(x, n, g)
        }
        fn jacobian(&mut self, x: &[f64], n: bool, o: &mut [f64]) -> Result<(), EvaluationError> {
            self.0.jacobian(x, n, o)
        }
        fn hessian(
            &mut self,
            x: &[f64],
            new_x: bool,
            factor: f64,
            multipliers: &[f64],
            new_multipliers: bool,
            values: &mut [f64],
        ) -> Result<(), EvaluationError> {
            self.0.hessian(x, new_x, factor, multipliers, new_multipliers, values)
        }
    }

    let origin = solve_from(&mut Dense(Hs100), Hs100::START, &Options::default());
    let cold = solve_from(&mut Neighbour(Dense(Hs100)), Hs100::START, &Options::default());
    let options = Options { mu_init: 1e-5, ..warm() };
    let start = origin.to_start();
    let warm =
        solve(&mut Neighbour(Dense(Hs100)), &options, &start, |_| Control::Continue).unwrap();
    assert_eq!((cold.status, warm.status), (Status::Solved, Status::Solved));
    assert!(warm.iterations < cold.iterations, "{} {}", warm.iterations, cold.iterations);
    assert!(warm.objective < origin.objective);
    assert_close(&warm.x, &cold.x, 1e-6);
}
