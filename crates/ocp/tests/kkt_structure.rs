//! Matrices that are not augmented systems of the stage problem are refused.

mod kkt_support;

use kkt_support::arm::ArmSystem;
use righting_nlp::{Factorization, LinearSolver};
use righting_ocp::kkt::{KktStructureError, StageDims, StageKkt};

// u_0 = 0, x_1 = 1 2, u_1 = 3, x_2 = 4 5, slacks 6 7, defects 8 9 and 10 11, inequalities 12 13.
fn small() -> Written {
    let dims = StageDims::uniform(2, 1, 1, 2);
    let triplets = vec![
        (0, 0, 1.0),
        (1, 1, 1.0),
        (2, 1, 0.5),
        (3, 3, 1.0),
        (3, 2, 0.5),
        (6, 6, 1.0),
        (7, 7, 1.0),
        (8, 0, 1.0),
        (8, 1, 1.0),
        (9, 2, 1.0),
        (10, 1, 1.0),
        (10, 3, 1.0),
        (10, 4, 1.0),
        (11, 5, 1.0),
        (12, 2, 1.0),
        (12, 6, -1.0),
        (13, 5, 1.0),
        (13, 7, -1.0),
    ];
    Written { dims, triplets }
}

/// A system written down entry by entry.
struct Written {
    dims: StageDims,
    triplets: Vec<(i32, i32, f64)>,
}

impl Written {
    fn recognise(&self, order: usize) -> Result<StageKkt, KktStructureError> {
        let mut solver = StageKkt::new(&self.dims);
        let rows: Vec<i32> = self.triplets.iter().map(|t| t.0).collect();
        let columns: Vec<i32> = self.triplets.iter().map(|t| t.1).collect();
        solver.recognise(order, &rows, &columns).map(|()| solver)
    }

    fn with(mut self, row: i32, column: i32) -> Self {
        self.triplets.push((row, column, 1.0));
        self
    }

    fn without(mut self, row: i32, column: i32) -> Self {
        self.triplets.retain(|t| (t.0, t.1) != (row, column));
        self
    }

    #[track_caller]
    fn refused(&self) -> KktStructureError {
        self.recognise(14).expect_err("the structure is not that of the stages")
    }
}

#[test]
fn the_small_system_is_one() {
    let system = small();
    let mut solver = system.recognise(14).unwrap();
    assert_eq!(solver.order(), 14);
    let values: Vec<f64> = system.triplets.iter().map(|t| t.2).collect();
    assert!(matches!(solver.factor(&values), Factorization::Regular { negative_eigenvalues: 6 }));
}

#[test]
fn another_order_is_refused() {
    let refusal = small().recognise(15).expect_err("another order");
    assert_eq!(refusal, KktStructureError::Order { expected: 14, found: 15 });
    let mut solver = StageKkt::new(&small().dims);
    let refusal = solver.recognise(14, &[0, 1], &[0]).expect_err("different lengths");
    assert_eq!(refusal, KktStructureError::TripletLengths { rows: 2, columns: 1 });
}

#[test]
fn entries_between_stages_are_refused() {
    let foreign = [
        (3, 0, "controls of two stages"),
        (4, 1, "states of two stages"),
        (10, 0, "a defect and an earlier stage's control"),
        (8, 3, "a defect and a later stage's control"),
        (10, 5, "a defect and another next state"),
        (12, 0, "an inequality and another stage"),
        (12, 7, "an inequality and another slack"),
        (7, 6, "two slacks"),
        (6, 1, "a slack and a state"),
        (9, 8, "two defect rows"),
        (12, 9, "an inequality and a defect"),
        (8, 6, "a defect and a slack"),
        (14, 0, "beyond the last row"),
        (0, -1, "before the first column"),
    ];
    for (row, column, what) in foreign {
        let refusal = small().with(row, column).refused();
        assert_eq!(refusal, KktStructureError::ForeignEntry { row, column }, "{what}");
        assert!(small().with(column, row).recognise(14).is_err(), "{what}, transposed");
    }
}

#[test]
fn missing_couplings_are_refused() {
    let refusal = small().without(10, 4).refused();
    assert_eq!(refusal, KktStructureError::DefectWithoutState { step: 1, row: 0 });
    let refusal = small().without(12, 6).refused();
    assert_eq!(refusal, KktStructureError::InequalityWithoutSlack { node: 1, row: 0 });
}

#[test]
fn a_solver_without_a_structure_fails() {
    let arm = ArmSystem::new(2, 1, 4);
    let mut solver = StageKkt::new(&arm.dims);
    assert_eq!(solver.factor(&arm.values), Factorization::Failed);
    solver.analyse(arm.order, &arm.rows, &arm.columns).unwrap();
    assert_eq!(solver.factor(&arm.values[1..]), Factorization::Failed);
    let mut rhs = vec![1.0; arm.order];
    solver.solve(&mut rhs);
    assert!(rhs.iter().all(|value| value.is_nan()));
    assert!(matches!(solver.factor(&arm.values), Factorization::Regular { .. }));
    assert!(solver.analyse(arm.order + 1, &arm.rows, &arm.columns).is_err());
    assert_eq!(solver.factor(&arm.values), Factorization::Failed);
}

#[test]
fn a_zero_coupling_fails() {
    let system = small();
    let mut solver = system.recognise(14).unwrap();
    let values: Vec<f64> =
        system.triplets.iter().map(|t| if (t.0, t.1) == (10, 4) { 0.0 } else { t.2 }).collect();
    assert_eq!(solver.factor(&values), Factorization::Failed);
}
