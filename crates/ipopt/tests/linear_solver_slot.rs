//! Ipopt with a linear solver of one's own.

mod support;

use righting_ipopt::*;
use support::assert_close;
use support::counting::Counting;
use support::hock_schittkowski::*;

fn compare_with_mumps<F: Functions>(functions: fn() -> F) {
    let options = Options { tolerance: 1e-9, ..Options::default() };
    let start = Start::at(F::START.to_vec());
    let mut own = Counting::default();
    let go_on = |_: &Iteration| Control::Continue;
    let mumps = solve(&mut Dense(functions()), &options, &start, go_on).unwrap();
    let slot = solve_with(&mut Dense(functions()), &options, &start, &mut own, go_on).unwrap();

    assert_eq!(mumps.status, Status::Solved, "{}", F::NAME);
    assert_eq!(slot.status, Status::Solved, "{}", F::NAME);
    assert_close(&[slot.objective], &[F::OBJECTIVE], 1e-7);
    assert_close(&slot.x, F::SOLUTION, 1e-6);
    assert_close(&slot.x, &mumps.x, 1e-9);
    assert_close(&slot.g, &mumps.g, 1e-9);
    assert_close(&slot.multipliers.constraints, &mumps.multipliers.constraints, 1e-7);
    assert_close(&slot.multipliers.lower, &mumps.multipliers.lower, 1e-7);
    assert_close(&slot.multipliers.upper, &mumps.multipliers.upper, 1e-7);
    assert_eq!(slot.iterations, mumps.iterations, "{}", F::NAME);

    let timing = slot.timing.linear_solver.unwrap();
    assert_eq!(timing.factor.calls, own.factorizations);
    assert_eq!(timing.analyse.calls, own.analyses);
    assert!(timing.solve.calls >= slot.iterations);
    assert_eq!(mumps.timing.linear_solver, None);
}

#[test]
fn hock_schittkowski_problems_end_where_mumps_ends() {
    compare_with_mumps(|| Hs006);
    compare_with_mumps(|| Hs035);
    compare_with_mumps(|| Hs038);
    compare_with_mumps(|| Hs040);
    compare_with_mumps(|| Hs071);
    compare_with_mumps(|| Hs100);
}

fn start() -> Start {
    Start::at(Hs071::START.to_vec())
}

fn go_on(_: &Iteration) -> Control {
    Control::Continue
}

/// A [`Counting`] that may fail, and that keeps account of what it is asked.
struct Watched<F> {
    inner: Counting,
    /// Given the number of the factorisation, what it ends with instead.
    instead: F,
    tolerances: Option<PivotTolerances>,
    tolerances_set: Vec<f64>,
    /// What is added to each solution, relatively.
    error: f64,
}

impl<F: FnMut(usize) -> Option<Factorization>> Watched<F> {
    fn new(instead: F) -> Self {
        Self {
            inner: Counting::default(),
            instead,
            tolerances: None,
            tolerances_set: Vec::new(),
            error: 0.0,
        }
    }
}

impl<F: FnMut(usize) -> Option<Factorization>> LinearSolver for Watched<F> {
    fn analyse(&mut self, n: usize, r: &[i32], c: &[i32]) -> Result<(), LinearSolverError> {
        self.inner.analyse(n, r, c)
    }

    fn factor(&mut self, values: &[f64]) -> Factorization {
        let outcome = self.inner.factor(values);
        (self.instead)(self.inner.factorizations - 1).unwrap_or(outcome)
    }

    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        self.inner.solve(right_hand_sides);
        right_hand_sides.iter_mut().for_each(|x| *x *= 1.0 + self.error);
    }

    fn pivot_tolerances(&self) -> Option<PivotTolerances> {
        self.tolerances
    }

    fn set_pivot_tolerance(&mut self, tolerance: f64) {
        self.tolerances_set.push(tolerance);
    }
}

#[test]
fn a_singular_system_is_regularised() {
    let mut solver = Watched::new(|count| (count == 3).then_some(Factorization::Singular));
    let solution =
        solve_with(&mut Dense(Hs071), &Options::default(), &start(), &mut solver, go_on).unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.x, Hs071::SOLUTION, 1e-6);
}

#[test]
fn wrong_inertia_is_corrected() {
    // As if the Hessian had not been convex enough in one iteration.
    let mut solver = Watched::new(|count| {
        (count == 3).then_some(Factorization::Regular { negative_eigenvalues: 3 })
    });
    let mut regularised = 0;
    let options = Options::default();
    let solution = solve_with(&mut Dense(Hs071), &options, &start(), &mut solver, |iteration| {
        regularised += usize::from(iteration.regularization > 0.0);
        Control::Continue
    })
    .unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_eq!(regularised, 1);
}

#[test]
fn a_factorisation_that_fails_is_a_status() {
    let mut solver = Watched::new(|count| (count >= 4).then_some(Factorization::Failed));
    let solution =
        solve_with(&mut Dense(Hs071), &Options::default(), &start(), &mut solver, go_on).unwrap();
    assert_eq!(solution.status, Status::LinearSolverFailed);
    assert!(solution.iterations >= 2);
    assert_eq!(solution.objective, Hs071::objective(&solution.x));
    assert_close(&solution.g, &Hs071::constraints(&solution.x), 1e-14);
    // MUMPS takes it from there.
    let rest = support::solve_from(&mut Dense(Hs071), &solution.x, &Options::default());
    assert_eq!(rest.status, Status::Solved);
}

#[test]
fn a_structure_that_is_refused_is_an_error() {
    #[derive(Debug, thiserror::Error)]
    #[error("{0} unknowns are too many")]
    struct TooMany(usize);

    struct Refusing;
    impl LinearSolver for Refusing {
        fn analyse(&mut self, n: usize, _: &[i32], _: &[i32]) -> Result<(), LinearSolverError> {
            Err(LinearSolverError::new(TooMany(n)))
        }
        fn factor(&mut self, _: &[f64]) -> Factorization {
            unreachable!("without a structure")
        }
        fn solve(&mut self, _: &mut [f64]) {
            unreachable!("without factors")
        }
    }
    let error = solve_with(&mut Dense(Hs071), &Options::default(), &start(), &mut Refusing, go_on)
        .unwrap_err();
    assert_eq!(error.to_string(), "the linear solver refuses the system");
    let source = std::error::Error::source(&error).unwrap();
    assert_eq!(source.to_string(), "7 unknowns are too many");
}

#[test]
fn pivot_tolerances_rise_while_solutions_are_inaccurate() {
    let (initial, largest) = (1e-8, 1e-4);
    let mut solver = Watched::new(|_| None);
    solver.tolerances = Some(PivotTolerances { initial, largest });
    // So inaccurate that refinement is slow to help.
    solver.error = 0.9;
    let options = Options { max_iterations: 5, ..Options::default() };
    solve_with(&mut Dense(Hs071), &options, &start(), &mut solver, go_on).unwrap();
    let set = &solver.tolerances_set;
    assert_eq!(set.len(), solver.inner.factorizations);
    assert_eq!(set[0], initial);
    assert_eq!(*set.last().unwrap(), largest);
    assert!(set.windows(2).all(|pair| pair[0] <= pair[1]));
    assert!(set.contains(&initial.powf(0.75)));
}

#[test]
fn the_pivot_tolerance_is_not_asked_for_in_vain() {
    let mut solver = Watched::new(|_| None);
    solve_with(&mut Dense(Hs071), &Options::default(), &start(), &mut solver, go_on).unwrap();
    assert_eq!(solver.tolerances_set, []);
}

#[test]
fn the_restoration_phase_uses_it_too() {
    let mut solver = Counting::default();
    let options = Options { start_with_resto: true, ..Options::default() };
    let mut restored = 0;
    let solution = solve_with(&mut Dense(Hs071), &options, &start(), &mut solver, |iteration| {
        restored += usize::from(iteration.restoration);
        Control::Continue
    })
    .unwrap();
    assert_eq!(solution.status, Status::Solved);
    assert_close(&solution.x, Hs071::SOLUTION, 1e-6);
    assert!(restored > 0 && solver.factorizations > restored);
    assert_eq!(solver.analyses, 1);
}
