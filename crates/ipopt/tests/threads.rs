//! Solves in several threads at once.

mod support;

use righting_ipopt::*;
use support::hock_schittkowski::*;

const THREADS: usize = 8;
const SOLVES: usize = 20;

/// Runs solves in several threads; all must give the same bits as one alone.
fn agree(solve: impl Fn() -> NlpSolution + Sync) {
    let alone = solve();
    assert_eq!(alone.status, Status::Solved);
    std::thread::scope(|scope| {
        for _ in 0..THREADS {
            scope.spawn(|| {
                for _ in 0..SOLVES {
                    let solution = solve();
                    assert_eq!(solution.x, alone.x);
                    assert_eq!(solution.multipliers, alone.multipliers);
                    assert_eq!(solution.iterations, alone.iterations);
                }
            });
        }
    });
}

fn start() -> Start {
    Start::at(Hs100::START.to_vec())
}

#[test]
fn with_mumps_one_after_the_other() {
    let options = Options::default();
    agree(|| solve(&mut Dense(Hs100), &options, &start(), |_| Control::Continue).unwrap());
}

#[test]
fn with_a_solver_each_at_once() {
    let options = Options::default();
    agree(|| {
        let mut solver = BunchKaufman::default();
        let go_on = |_: &Iteration| Control::Continue;
        solve_with(&mut Dense(Hs100), &options, &start(), &mut solver, go_on).unwrap()
    });
}

#[test]
fn two_solves_with_the_slot_do_overlap() {
    // Each waits within its solve until the other is within its own.
    let both = std::sync::Barrier::new(2);
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                let mut solver = BunchKaufman::default();
                let options = Options::default();
                let solution =
                    solve_with(&mut Dense(Hs100), &options, &start(), &mut solver, |iteration| {
                        if iteration.iteration == 2 {
                            both.wait();
                        }
                        Control::Continue
                    });
                assert_eq!(solution.unwrap().status, Status::Solved);
            });
        }
    });
}
