//! The way from Ipopt's calls of MA57 to a [`LinearSolver`].
//!
//! MA57 is five Fortran subroutines without a context argument, so the solver of the current solve
//! is found through a thread-local: Ipopt calls them on the thread that solves. It allocates
//! MA57's work arrays but only MA57 reads them; here they are as small as can be and unused.

mod ma57;

use crate::trap::Trap;
use crate::{Factorization, LinearSolver, LinearSolverError, LinearSolverTiming, SolveError};
use righting_ipopt_sys::hsl::{SlotError, ma57_slot};
use std::cell::Cell;
use std::ptr::null_mut;
use std::sync::Once;
use std::time::Instant;

thread_local! {
    static CURRENT: Cell<*mut Slot<'static>> = const { Cell::new(null_mut()) };
}

/// What became of the linear solver in a solve.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) timing: LinearSolverTiming,
    /// It refused the structure.
    pub(crate) refusal: Option<LinearSolverError>,
    /// Its last factorisation failed.
    pub(crate) failed: bool,
}

/// Puts this module in the place of MA57; gives what Ipopt's option `hsllib` must be, if anything.
pub(crate) fn install() -> Result<Option<&'static str>, SolveError> {
    static INSTALLED: Once = Once::new();
    let slot = ma57_slot().map_err(|error| match error {
        SlotError::Load(error) => SolveError::NotLoaded(error),
        error => SolveError::NoLinearSolverSlot(error),
    })?;
    INSTALLED.call_once(|| ma57::install(slot.set));
    Ok(slot.hsllib.as_deref())
}

/// Runs `body`; meanwhile the calls of MA57 on this thread reach `solver`.
pub(crate) fn with_solver<T>(
    solver: &mut dyn LinearSolver,
    trap: &Trap,
    body: impl FnOnce() -> T,
) -> (T, Report) {
    struct Reset;
    impl Drop for Reset {
        fn drop(&mut self) {
            CURRENT.set(null_mut());
        }
    }

    let mut slot = Slot {
        takes_tolerances: solver.pivot_tolerances().is_some(),
        solver,
        trap,
        report: Report::default(),
        order: 0,
        rows: Vec::new(),
        columns: Vec::new(),
    };
    let reset = Reset;
    // The lifetimes end after `reset` has taken the pointer out again.
    CURRENT.set((&raw mut slot).cast());
    let result = body();
    drop(reset);
    (result, slot.report)
}

struct Slot<'a> {
    solver: &'a mut dyn LinearSolver,
    takes_tolerances: bool,
    trap: &'a Trap,
    report: Report,
    order: usize,
    rows: Vec<i32>,
    columns: Vec<i32>,
}

impl Slot<'_> {
    /// Runs `body` on the slot of the solve that this thread is in; `None` outside of one.
    fn with_current<T>(body: impl FnOnce(&mut Slot<'static>) -> T) -> Option<T> {
        let current = CURRENT.get();
        if current.is_null() {
            return None;
        }
        // SAFETY: the slot outlives the time that it is current, it is used through this pointer
        // only, and not twice at once: a solver that solves again is refused.
        Some(body(unsafe { &mut *current }))
    }

    /// Takes the structure, with indices that count from one.
    fn analyse(&mut self, order: usize, rows: &[i32], columns: &[i32]) {
        let from_zero = |indices: &[i32]| indices.iter().map(|index| index - 1).collect();
        (self.rows, self.columns) = (from_zero(rows), from_zero(columns));
        self.order = order;
        let start = Instant::now();
        let outcome = self.trap.run(|| self.solver.analyse(order, &self.rows, &self.columns));
        self.report.timing.analyse.add_since(start);
        if let Some(Err(refusal)) = outcome {
            self.report.refusal = Some(refusal);
        }
    }

    fn factor(&mut self, values: &[f64], pivot_tolerance: f64) -> Factorization {
        if self.report.refusal.is_some() {
            return Factorization::Failed;
        }
        let start = Instant::now();
        let outcome = self.trap.run(|| {
            if self.takes_tolerances {
                self.solver.set_pivot_tolerance(pivot_tolerance);
            }
            self.solver.factor(values)
        });
        self.report.timing.factor.add_since(start);
        let outcome = outcome.unwrap_or(Factorization::Failed);
        self.report.failed = outcome == Factorization::Failed;
        outcome
    }

    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        let start = Instant::now();
        self.trap.run(|| self.solver.solve(right_hand_sides));
        self.report.timing.solve.add_since(start);
    }
}
