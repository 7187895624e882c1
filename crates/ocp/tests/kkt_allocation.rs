//! Factorising and solving allocate nothing after the first time.

#[path = "../../symbolic/tests/counting/mod.rs"]
mod counting;
mod kkt_support;

use counting::allocations;
use kkt_support::arm::ArmSystem;
use righting_nlp::{Factorization, LinearSolver};
use righting_ocp::kkt::StageKkt;

#[test]
fn factor_and_solve_allocate_nothing() {
    let arm = ArmSystem::new(7, 8, 20);
    // Controls that cost little by themselves and much in pairs take pivots of two.
    let (states, joints) = (arm.dims.nodes()[1].states, arm.dims.nodes()[1].controls);
    let variables = arm.dims.nodes().iter().map(|node| node.states + node.controls).sum::<usize>();
    let is_control =
        |i: i32| (i as usize) < variables && (i as usize + states) % (states + joints) >= states;
    let constraints = arm.dims.nodes().iter().skip(1).map(|node| node.states + node.inequalities);
    let (least, mut saddle) = (constraints.sum::<usize>(), arm.values.clone());
    for (t, value) in saddle.iter_mut().enumerate() {
        let (row, column) = (arm.rows[t], arm.columns[t]);
        if row != column && is_control(row) && is_control(column) {
            *value *= 1e5;
        }
    }
    let mut solver = StageKkt::new(&arm.dims);
    solver.analyse(arm.order, &arm.rows, &arm.columns).unwrap();
    let mut rhs = vec![1.0; arm.order];
    let mut round = || {
        for (values, is_convex) in [(&arm.values, true), (&saddle, false)] {
            let Factorization::Regular { negative_eigenvalues } = solver.factor(values) else {
                panic!("a regular matrix");
            };
            assert_eq!(negative_eigenvalues == least, is_convex);
            solver.solve(&mut rhs);
        }
    };
    round();
    let before = allocations();
    round();
    assert_eq!(allocations(), before);
}
