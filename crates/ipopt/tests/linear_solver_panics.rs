//! A linear solver that panics.

mod support;

use righting_ipopt::*;
use std::panic::panic_any;
use support::caught;
use support::hock_schittkowski::*;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Step {
    Analyse,
    Factor,
    Solve,
}

/// A linear solver that panics at one step, the second time it gets there if there is one.
struct Panicking {
    inner: BunchKaufman,
    at: Step,
    calls: usize,
}

impl Panicking {
    fn step(&mut self, step: Step) {
        if step == self.at {
            self.calls += 1;
            if step == Step::Analyse || self.calls == 2 {
                panic_any(step);
            }
        }
    }
}

impl LinearSolver for Panicking {
    fn analyse(&mut self, n: usize, r: &[i32], c: &[i32]) -> Result<(), LinearSolverError> {
        self.step(Step::Analyse);
        self.inner.analyse(n, r, c)
    }

    fn factor(&mut self, values: &[f64]) -> Factorization {
        self.step(Step::Factor);
        self.inner.factor(values)
    }

    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        self.step(Step::Solve);
        self.inner.solve(right_hand_sides);
    }
}

#[test]
fn a_panic_in_the_linear_solver_goes_on_after_the_solve() {
    let start = Start::at(Hs071::START.to_vec());
    for at in [Step::Analyse, Step::Factor, Step::Solve] {
        let mut solver = Panicking { inner: BunchKaufman::default(), at, calls: 0 };
        let found: Step = caught(|| {
            solve_with(&mut Dense(Hs071), &Options::default(), &start, &mut solver, |_| {
                Control::Continue
            })
        });
        assert_eq!(found, at);
        assert!(solver.calls <= 2, "it was called again");
    }
}
