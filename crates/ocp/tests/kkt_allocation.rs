//! Factorising and solving allocate nothing after the first time.

mod kkt_support;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

use kkt_support::arm::ArmSystem;
use righting_ipopt::{Factorization, LinearSolver};
use righting_ocp::kkt::StageKkt;

struct Counting;

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: everything is passed on to the system allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::SeqCst);
        // SAFETY: the caller keeps the allocator's contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the allocator's contract.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

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
    let before = ALLOCATIONS.load(Ordering::SeqCst);
    round();
    assert_eq!(ALLOCATIONS.load(Ordering::SeqCst), before);
}
