//! Ipopt with a linear solver of one's own.

mod support;

use righting_ipopt::*;
use support::assert_close;
use support::bunch_kaufman::BunchKaufman;
use support::hock_schittkowski::*;

fn compare_with_mumps<F: Functions>(functions: fn() -> F) {
    let options = Options { tolerance: 1e-9, ..Options::default() };
    let start = Start::at(F::START.to_vec());
    let mut own = BunchKaufman::default();
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
