//! The solver as Ipopt sees it.

use righting_nlp::{Factorization, LinearSolver, LinearSolverError, PivotTolerances};

use super::dims::{StageDims, SystemLayout};
use super::elimination::Breakdown;
use super::factor::{Factor, FactorWorkspace, Inertia};
use super::lanes::Lanes;
use super::node::NodeFactor;
use super::solve::{Solve, SolveWorkspace};
use super::structure::{KktStructureError, Structure};

/// Pivots smaller than this beside the rest of their row are avoided, at first.
const PIVOT_TOLERANCE: f64 = 1e-8;
/// The strictest tolerance.
const STRICTEST_PIVOT_TOLERANCE: f64 = 1e-2;

/// Stage-structured LDLᵀ of an augmented system: see the [module](super).
#[derive(Debug, Clone)]
pub struct StageKkt {
    layout: SystemLayout,
    lanes: Lanes,
    structure: Option<Structure>,
    /// The triplets that have this structure.
    rows: Vec<i32>,
    columns: Vec<i32>,
    nodes: Vec<NodeFactor>,
    work: FactorWorkspace,
    solve_work: SolveWorkspace,
    pivot_tolerance: f64,
    stop_at_excess: bool,
    /// Whether the last factorisation came to its end.
    factorised: bool,
}

impl StageKkt {
    /// A solver for problems of these sizes, with the widest SIMD lanes of this processor.
    pub fn new(dims: &StageDims) -> Self {
        Self::with_lanes(dims, Lanes::native())
    }

    /// The same without SIMD: what the lanes are tested against.
    pub fn scalar(dims: &StageDims) -> Self {
        Self::with_lanes(dims, Lanes::Scalar)
    }

    /// The same solver for problems of these sizes: it stays as it is where they are its own.
    pub(crate) fn resized(mut self, dims: &StageDims) -> Self {
        if !self.layout.has_dims(dims) {
            self.layout = SystemLayout::new(dims);
            self.rows.clear();
        }
        self
    }

    /// Gives up a factorisation as soon as there are more negative eigenvalues than constraints,
    /// and reports one too many instead of how many there are. Ipopt regularises such a matrix
    /// whatever the number, and does not solve with it.
    pub fn stop_at_excess(mut self) -> Self {
        self.stop_at_excess = true;
        self
    }

    fn with_lanes(dims: &StageDims, lanes: Lanes) -> Self {
        Self {
            layout: SystemLayout::new(dims),
            lanes,
            structure: None,
            rows: Vec::new(),
            columns: Vec::new(),
            nodes: Vec::new(),
            work: FactorWorkspace::default(),
            solve_work: SolveWorkspace::default(),
            pivot_tolerance: PIVOT_TOLERANCE,
            stop_at_excess: false,
            factorised: false,
        }
    }

    /// Unknowns of the augmented system.
    pub fn order(&self) -> usize {
        self.layout.order
    }

    /// Recognises the stage structure in the triplets, anew where they are not those of the last time: the
    /// fallible part of [`LinearSolver::analyse`], with its own error.
    ///
    /// # Errors
    /// When the matrix does not have the structure; then another solver has to be used.
    pub fn recognise(
        &mut self,
        order: usize,
        rows: &[i32],
        columns: &[i32],
    ) -> Result<(), KktStructureError> {
        self.factorised = false;
        self.pivot_tolerance = PIVOT_TOLERANCE;
        let is_known = self.order() == order && self.rows == rows && self.columns == columns;
        if is_known && self.structure.is_some() {
            return Ok(());
        }
        self.structure = None;
        let structure = Structure::analyse(&self.layout, order, rows, columns, self.lanes.width())?;
        let lanes = self.lanes.width();
        let mut before = std::mem::take(&mut self.nodes).into_iter();
        let node = |k| {
            let pattern = structure.pattern(k);
            let reused = before.next().and_then(|node| node.reused(pattern, lanes));
            reused.unwrap_or_else(|| NodeFactor::new(pattern, lanes))
        };
        self.nodes = (0..self.layout.nodes.len()).map(node).collect();
        self.work = FactorWorkspace::default();
        self.rows.clear();
        self.rows.extend_from_slice(rows);
        self.columns.clear();
        self.columns.extend_from_slice(columns);
        self.structure = Some(structure);
        Ok(())
    }
}

impl LinearSolver for StageKkt {
    /// Finds where each triplet belongs; entries may lie in either triangle.
    fn analyse(
        &mut self,
        order: usize,
        rows: &[i32],
        columns: &[i32],
    ) -> Result<(), LinearSolverError> {
        self.recognise(order, rows, columns).map_err(LinearSolverError::new)
    }

    /// Factorises; fails before a successful analysis and when the number of values differs.
    fn factor(&mut self, values: &[f64]) -> Factorization {
        self.factorised = false;
        let Some(structure) = self.structure.as_ref().filter(|s| s.triplets == values.len()) else {
            return Factorization::Failed;
        };
        let outcome = self.lanes.run(Factor {
            layout: &self.layout,
            structure,
            nodes: &mut self.nodes,
            work: &mut self.work,
            values,
            tolerance: self.pivot_tolerance,
            stop_at_excess: self.stop_at_excess,
        });
        self.factorised = matches!(outcome, Ok(Inertia::Exact { .. }));
        match outcome {
            Ok(Inertia::Exact { negative }) => {
                Factorization::Regular { negative_eigenvalues: negative }
            }
            Ok(Inertia::Excess) => {
                Factorization::Regular { negative_eigenvalues: self.layout.constraints() + 1 }
            }
            Err(Breakdown::Singular) => Factorization::Singular,
            Err(Breakdown::Failed) => Factorization::Failed,
        }
    }

    /// Solves with the last factorisation; the result is not a number when there is none.
    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        let Some(structure) = self.structure.as_ref().filter(|_| self.factorised) else {
            return right_hand_sides.fill(f64::NAN);
        };
        for rhs in right_hand_sides.chunks_exact_mut(self.layout.order.max(1)) {
            self.lanes.run(Solve {
                layout: &self.layout,
                structure,
                nodes: &self.nodes,
                work: &mut self.solve_work,
                rhs,
            });
        }
    }

    fn pivot_tolerances(&self) -> Option<PivotTolerances> {
        Some(PivotTolerances { initial: PIVOT_TOLERANCE, largest: STRICTEST_PIVOT_TOLERANCE })
    }

    fn set_pivot_tolerance(&mut self, tolerance: f64) {
        self.pivot_tolerance = tolerance;
    }
}
