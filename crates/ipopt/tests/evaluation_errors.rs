//! Where functions are not defined.

mod support;

use num_dual::DualNum;
use righting_ipopt::*;
use support::hock_schittkowski::*;
use support::meddling::{Meddling, Method, Mischief};
use support::{assert_close, solve_from};

/// min x − ln x, defined for x > 0 only.
struct Logarithm;

impl Functions for Logarithm {
    const NAME: &'static str = "logarithm";
    const X_BOUNDS: &'static [(f64, f64)] = &[(f64::NEG_INFINITY, f64::INFINITY)];
    const G_BOUNDS: &'static [(f64, f64)] = &[];
    const START: &'static [f64] = &[3.0];
    const OBJECTIVE: f64 = 1.0;
    const SOLUTION: &'static [f64] = &[1.0];

    fn objective<D: DualNum<Primitive = f64> + Copy>(x: &[D]) -> D {
        x[0] - x[0].ln()
    }

    fn constraints<D: DualNum<Primitive = f64> + Copy>(_: &[D]) -> Vec<D> {
        Vec::new()
    }
}

#[test]
fn a_step_out_of_the_domain_is_cut() {
    // The full step goes to 3 − 3² (1 − 1/3) = −3, where the logarithm is NaN or refused.
    for refuse in [false, true] {
        let mut outside = 0;
        let mut problem = Meddling::new(Dense(Logarithm), |_, _, x: &[f64]| {
            outside += usize::from(x[0] <= 0.0);
            if refuse && x[0] <= 0.0 { Mischief::Refuse } else { Mischief::None }
        });
        let mut cut = false;
        let start = Start::at(Logarithm::START.to_vec());
        let solution = solve(&mut problem, &Options::default(), &start, |iteration| {
            cut |= iteration.line_search_trials > 1 && iteration.alpha_primal < 1.0;
            Control::Continue
        })
        .unwrap();
        assert_eq!(solution.status, Status::Solved);
        assert_close(&solution.x, Logarithm::SOLUTION, 1e-7);
        assert!(cut && outside > 0);
    }
}

fn solve_meddled(method: Method, call: usize, mischief: Mischief) -> NlpSolution {
    let mut problem = Meddling::new(Dense(Hs071), |called, count, _: &[f64]| {
        if called == method && count == call { mischief } else { Mischief::None }
    });
    // Automatic scaling would take the first derivatives, and do without if they fail.
    let options = Options { nlp_scaling: NlpScaling::None, ..Options::default() };
    solve_from(&mut problem, Hs071::START, &options)
}

#[test]
fn one_bad_trial_point_does_no_harm() {
    for method in [Method::Objective, Method::Constraints] {
        for mischief in [Mischief::Refuse, Mischief::Nan, Mischief::Infinite] {
            let solution = solve_meddled(method, 2, mischief);
            assert_eq!(solution.status, Status::Solved, "{method:?} {mischief:?}");
            assert_close(&solution.x, Hs071::SOLUTION, 1e-6);
        }
    }
}

#[test]
fn an_undefined_start_is_a_status() {
    let methods = [Method::Objective, Method::Gradient, Method::Constraints, Method::Jacobian];
    for method in methods {
        for mischief in [Mischief::Refuse, Mischief::Nan, Mischief::Infinite] {
            let solution = solve_meddled(method, 0, mischief);
            assert_eq!(solution.status, Status::InvalidNumber, "{method:?} {mischief:?}");
            // The functions are defined the second time, and belong to the point.
            assert_eq!(solution.objective, Hs071::objective(&solution.x));
            assert_eq!(solution.g, Hs071::constraints(&solution.x));
        }
    }
}

#[test]
fn an_undefined_derivative_is_a_status() {
    for method in [Method::Gradient, Method::Jacobian, Method::Hessian] {
        for mischief in [Mischief::Refuse, Mischief::Nan] {
            let solution = solve_meddled(method, 3, mischief);
            assert_eq!(solution.status, Status::InvalidNumber, "{method:?} {mischief:?}");
            assert!(solution.iterations >= 2);
        }
    }
}

/// Hock and Schittkowski's 71 takes fewer calls of each function: the last of these meddle with nothing.
#[test]
fn mischief_at_any_call_of_any_function_is_a_status_at_a_finite_point() {
    let methods = [
        Method::Objective,
        Method::Gradient,
        Method::Constraints,
        Method::Jacobian,
        Method::Hessian,
    ];
    let mut solved = 0;
    for method in methods {
        for call in 0..20 {
            for mischief in [Mischief::Refuse, Mischief::Nan, Mischief::Infinite] {
                let solution = solve_meddled(method, call, mischief);
                let what = format!("{method:?} {call} {mischief:?}: {:?}", solution.status);
                assert!(solution.x.iter().all(|x| x.is_finite()), "{what}");
                match solution.status {
                    Status::Solved | Status::Acceptable => {
                        solved += 1;
                        assert_close(&solution.x, Hs071::SOLUTION, 1e-6);
                    }
                    Status::InvalidNumber | Status::RestorationFailed => {}
                    _ => panic!("{what}"),
                }
            }
        }
    }
    assert!(solved > 100, "{solved}");
}

#[test]
fn functions_that_are_nowhere_defined_leave_nan() {
    let mut problem = Meddling::new(Dense(Hs071), |_, _, _: &[f64]| Mischief::Refuse);
    let solution = solve_from(&mut problem, Hs071::START, &Options::default());
    assert_eq!(solution.status, Status::InvalidNumber);
    assert!(solution.objective.is_nan());
    assert!(solution.g.iter().all(|g| g.is_nan()));
    assert!(solution.constraint_violation.is_nan());
}

#[test]
fn new_x_is_true_whenever_the_point_is_new() {
    /// Checks the promise that intermediate results may be kept.
    struct Watching {
        last: Option<Vec<f64>>,
        repeats: usize,
        multipliers: Option<Vec<f64>>,
    }
    impl Watching {
        fn see(&mut self, x: &[f64], new_x: bool) {
            if !new_x {
                assert_eq!(self.last.as_deref(), Some(x));
                self.repeats += 1;
            }
            self.last = Some(x.to_vec());
        }
    }
    impl Problem for Watching {
        fn dimensions(&self) -> Dimensions {
            Dense(Hs100).dimensions()
        }
        fn bounds(&self, bounds: &mut Bounds) {
            Dense(Hs100).bounds(bounds);
        }
        fn jacobian_structure(&self) -> TripletStructure {
            Dense(Hs100).jacobian_structure()
        }
        fn hessian_structure(&self) -> TripletStructure {
            Dense(Hs100).hessian_structure()
        }
        fn objective(&mut self, x: &[f64], new: bool) -> Result<f64, EvaluationError> {
            self.see(x, new);
            Dense(Hs100).objective(x, new)
        }
        fn gradient(&mut self, x: &[f64], n: bool, o: &mut [f64]) -> Result<(), EvaluationError> {
            self.see(x, n);
            Dense(Hs100).gradient(x, n, o)
        }
        fn constraints(
            &mut self,
            x: &[f64],
            n: bool,
            g: &mut [f64],
        ) -> Result<(), EvaluationError> {
            self.see(x, n);
            Dense(Hs100).constraints(x, n, g)
        }
        fn jacobian(&mut self, x: &[f64], n: bool, o: &mut [f64]) -> Result<(), EvaluationError> {
            self.see(x, n);
            Dense(Hs100).jacobian(x, n, o)
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
            self.see(x, new_x);
            if !new_multipliers {
                assert_eq!(self.multipliers.as_deref(), Some(multipliers));
            }
            self.multipliers = Some(multipliers.to_vec());
            Dense(Hs100).hessian(x, new_x, factor, multipliers, new_multipliers, values)
        }
    }
    let mut watching = Watching { last: None, repeats: 0, multipliers: None };
    let solution = solve_from(&mut watching, Hs100::START, &Options::default());
    assert_eq!(solution.status, Status::Solved);
    assert!(watching.repeats > 3 * solution.iterations, "Ipopt never says that x is the same");
}
