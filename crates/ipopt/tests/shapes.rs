//! Problems of unusual shape: nothing to constrain, nothing free, nothing that matters.

mod support;

use righting_ipopt::*;
use support::hock_schittkowski::*;
use support::quadratic::Projection;
use support::{assert_close, solve_from};

const INF: f64 = f64::INFINITY;

#[test]
fn without_constraints() {
    let mut problem = Projection::of(&[3.0, -2.0]).within(&[(-INF, 1.0), (-INF, INF)]);
    let solution = solve_from(&mut problem, &[0.0, 0.0], &Options::default());
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.x, &[1.0, -2.0], 1e-6);
    assert_close(&[solution.objective], &[4.0], 1e-6);
    assert_close(&solution.multipliers.upper, &[4.0, 0.0], 1e-6);
    assert_eq!(solution.g, []);
    assert_eq!(solution.multipliers.constraints, []);
    assert!(solution.constraint_violation <= 1e-8);
}

#[test]
fn some_variables_fixed() {
    for treatment in
        [FixedVariables::MakeParameter, FixedVariables::MakeConstraint, FixedVariables::RelaxBounds]
    {
        let mut problem = Projection::of(&[3.0, 5.0, 1.0])
            .within(&[(-INF, INF), (2.0, 2.0), (-INF, INF)])
            .subject_to(&[(0, 1.0), (1, 1.0), (2, 1.0)], (0.0, 0.0));
        let options = Options { fixed_variables: treatment, ..Options::default() };
        let solution = solve_from(&mut problem, &[0.0, 9.0, 0.0], &options);
        assert_eq!(solution.status, Status::Solved, "{treatment:?}");
        assert_close(&solution.x, &[0.0, 2.0, -2.0], 1e-6);
        assert_close(&solution.multipliers.constraints, &[6.0], 1e-5);
    }
}

#[test]
fn all_variables_fixed() {
    let mut problem = Projection::of(&[0.0, 0.0]).within(&[(1.0, 1.0), (2.0, 2.0)]);
    let solution = solve_from(&mut problem, &[7.0, 7.0], &Options::default());
    assert_eq!(solution.status, Status::Solved);
    assert_eq!(solution.x, [1.0, 2.0]);
    assert_eq!(solution.objective, 5.0);
    assert_eq!(solution.iterations, 0);

    let mut impossible = problem.subject_to(&[(0, 1.0)], (5.0, 5.0));
    let solution = solve_from(&mut impossible, &[7.0, 7.0], &Options::default());
    assert_eq!(solution.status, Status::Infeasible);
    assert_eq!(solution.constraint_violation, 4.0);
}

#[test]
fn a_constraint_that_depends_on_nothing() {
    let mut problem = Projection::of(&[1.0]).subject_to(&[], (-1.0, 1.0));
    let solution = solve_from(&mut problem, &[0.0], &Options::default());
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.x, &[1.0], 1e-6);
    assert_eq!(solution.g, [0.0]);
}

#[test]
fn no_curvature_at_all() {
    /// min x₀ + 2x₁  s.t.  x₀ + x₁ ≥ 1,  x ≥ 0
    struct Linear;
    impl Functions for Linear {
        const NAME: &'static str = "linear";
        const X_BOUNDS: &'static [(f64, f64)] = &[(0.0, INF); 2];
        const G_BOUNDS: &'static [(f64, f64)] = &[(1.0, INF)];
        const START: &'static [f64] = &[3.0, 3.0];
        const OBJECTIVE: f64 = 1.0;
        const SOLUTION: &'static [f64] = &[1.0, 0.0];
        fn objective<D: num_dual::DualNum<Primitive = f64> + Copy>(x: &[D]) -> D {
            x[0] + x[1] * 2.0
        }
        fn constraints<D: num_dual::DualNum<Primitive = f64> + Copy>(x: &[D]) -> Vec<D> {
            vec![x[0] + x[1]]
        }
    }
    struct WithoutHessian(Dense<Linear>);
    impl Problem for WithoutHessian {
        fn dimensions(&self) -> Dimensions {
            self.0.dimensions()
        }
        fn bounds(&self, bounds: &mut Bounds) {
            self.0.bounds(bounds);
        }
        fn jacobian_structure(&self) -> TripletStructure {
            self.0.jacobian_structure()
        }
        fn hessian_structure(&self) -> TripletStructure {
            TripletStructure::default()
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
            _: bool,
            _: f64,
            _: &[f64],
            _: bool,
            values: &mut [f64],
        ) -> Result<(), EvaluationError> {
            assert_eq!((x.len(), values.len()), (2, 0));
            Ok(())
        }
    }
    let solution =
        solve_from(&mut WithoutHessian(Dense(Linear)), Linear::START, &Options::default());
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.x, Linear::SOLUTION, 1e-6);
}

#[test]
fn entries_given_twice_are_summed() {
    let mut problem = Projection::of(&[1.0]).subject_to(&[(0, 1.0), (0, 1.0)], (-INF, 1.0));
    problem.hessian = TripletStructure { rows: vec![0, 0], columns: vec![0, 0] };
    let solution = solve_from(&mut problem, &[0.0], &Options::default());
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.x, &[0.5], 1e-6);
}

#[test]
fn more_equations_than_variables() {
    let mut problem = Projection::of(&[0.0])
        .subject_to(&[(0, 1.0)], (1.0, 1.0))
        .subject_to(&[(0, 1.0)], (2.0, 2.0));
    let solution = solve_from(&mut problem, &[0.0], &Options::default());
    assert_eq!(solution.status, Status::TooFewDegreesOfFreedom);
    assert_eq!(solution.x, [0.0]);
    assert_eq!(solution.constraint_violation, 2.0);
}

#[test]
fn constraints_that_exclude_each_other() {
    let mut problem = Projection::of(&[0.0, 0.0])
        .subject_to(&[(0, 1.0), (1, 1.0)], (2.0, INF))
        .subject_to(&[(0, 1.0), (1, 1.0)], (-INF, 1.0));
    let solution = solve_from(&mut problem, &[0.0, 0.0], &Options::default());
    assert_eq!(solution.status, Status::Infeasible);
    assert!(solution.constraint_violation > 0.4);
}

#[test]
fn an_objective_without_limit() {
    let mut problem = Projection::of(&[0.0]);
    problem.scaling = Some(Scaling { objective: -1.0, x: None, g: None });
    let solution = solve_from(&mut problem, &[1.0], &Options::default());
    assert_eq!(solution.status, Status::Diverging);
    assert!(!solution.status.is_success());
}

#[test]
fn a_limit_of_iterations() {
    let options = Options { max_iterations: 3, ..Options::default() };
    let solution = solve_from(&mut Dense(Hs100), Hs100::START, &options);
    assert_eq!(solution.status, Status::IterationLimit);
    assert_eq!(solution.iterations, 3);
    assert_eq!(solution.objective, Hs100::objective(&solution.x));
}

#[test]
fn the_problem_brings_its_scaling() {
    let plain = solve_from(&mut Projection::of(&[3.0, 4.0]), &[0.0, 0.0], &Options::default());
    let mut problem = Projection::of(&[3.0, 4.0]).subject_to(&[(0, 1e6), (1, 1e6)], (-INF, 14e6));
    problem.scaling =
        Some(Scaling { objective: 1e-3, x: Some(vec![1.0, 0.5]), g: Some(vec![1e-6]) });
    let scaled = solve_from(&mut problem, &[0.0, 0.0], &Options::default());
    assert_eq!(scaled.status, Status::Solved);
    assert_close(&scaled.x, &plain.x, 1e-6);
    assert_close(&scaled.multipliers.constraints, &[0.0], 1e-9);
}

#[test]
fn gradients_alone_suffice() {
    let options = Options { hessian: Hessian::LimitedMemory, ..Options::default() };
    let solution = solve_from(&mut Dense(Hs071), Hs071::START, &options);
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.x, Hs071::SOLUTION, 1e-5);
    assert_eq!(solution.timing.evaluation.hessian.calls, 0);
}

#[test]
fn through_a_trait_object() {
    let mut problem: Box<dyn Problem> = Box::new(Dense(Hs040));
    let start = Start::at(Hs040::START.to_vec());
    let solution =
        solve(&mut *problem, &Options::default(), &start, |_| Control::Continue).unwrap();
    assert_close(&[solution.objective], &[Hs040::OBJECTIVE], 1e-8);
}
