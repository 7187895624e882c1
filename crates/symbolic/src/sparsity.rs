//! Sparsity patterns and matrices of expressions that have one.

use std::sync::Arc;

use crate::expr::Expr;

/// Which entries of a matrix may be nonzero: a shared, immutable pattern in row-major order.
#[derive(Clone, PartialEq, Eq)]
pub struct Sparsity(Arc<Pattern>);

#[derive(PartialEq, Eq)]
struct Pattern {
    rows: usize,
    cols: usize,
    /// Sorted by row, then column; no duplicates.
    entries: Vec<(usize, usize)>,
}

impl Sparsity {
    /// A pattern from its entries (row, column), in any order, duplicates merged; `None` if an entry
    /// lies outside the matrix.
    pub fn new(
        rows: usize,
        cols: usize,
        entries: impl IntoIterator<Item = (usize, usize)>,
    ) -> Option<Self> {
        let mut entries: Vec<_> = entries.into_iter().collect();
        entries.sort_unstable();
        entries.dedup();
        let inside = entries.iter().all(|&(row, col)| row < rows && col < cols);
        inside.then(|| Self::from_sorted(rows, cols, entries))
    }

    /// Every entry.
    pub fn dense(rows: usize, cols: usize) -> Self {
        let entries = (0..rows).flat_map(|row| (0..cols).map(move |col| (row, col))).collect();
        Self::from_sorted(rows, cols, entries)
    }

    pub(crate) fn from_sorted(rows: usize, cols: usize, entries: Vec<(usize, usize)>) -> Self {
        debug_assert!(entries.is_sorted());
        Sparsity(Arc::new(Pattern { rows, cols, entries }))
    }

    /// Number of rows of the matrix.
    pub fn rows(&self) -> usize {
        self.0.rows
    }

    /// Number of columns of the matrix.
    pub fn cols(&self) -> usize {
        self.0.cols
    }

    /// Number of structural nonzeros.
    pub fn nonzeros(&self) -> usize {
        self.0.entries.len()
    }

    /// The structural nonzeros as (row, column), by row, then column: the order of the values.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (usize, usize)> + '_ {
        self.0.entries.iter().copied()
    }

    /// Where among the values entry (row, column) is.
    pub fn position(&self, row: usize, col: usize) -> Option<usize> {
        self.0.entries.binary_search(&(row, col)).ok()
    }
}

impl std::fmt::Debug for Sparsity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Sparsity({}x{}, {} nonzeros)", self.rows(), self.cols(), self.nonzeros())
    }
}

/// A matrix of expressions that stores its structural nonzeros only.
#[derive(Clone, Debug)]
pub struct SparseMatrix {
    sparsity: Sparsity,
    /// The nonzeros in the pattern's order.
    pub values: Vec<Expr>,
}

impl SparseMatrix {
    /// A matrix from its nonzeros in the order of the pattern; `None` if their number differs.
    pub fn new(sparsity: Sparsity, values: Vec<Expr>) -> Option<Self> {
        (sparsity.nonzeros() == values.len()).then_some(SparseMatrix { sparsity, values })
    }

    /// From entries in any order; those that are the number zero are dropped.
    pub(crate) fn from_entries(
        rows: usize,
        cols: usize,
        mut entries: Vec<(usize, usize, Expr)>,
    ) -> Self {
        entries.sort_unstable_by_key(|&(row, col, _)| (row, col));
        let pattern = entries.iter().map(|&(row, col, _)| (row, col)).collect();
        let values = entries.into_iter().map(|(_, _, value)| value).collect();
        SparseMatrix { sparsity: Sparsity::from_sorted(rows, cols, pattern), values }
    }

    /// The pattern of the values.
    pub fn sparsity(&self) -> &Sparsity {
        &self.sparsity
    }

    /// The entry, if it is structurally nonzero.
    pub fn get(&self, row: usize, col: usize) -> Option<Expr> {
        self.sparsity.position(row, col).map(|k| self.values[k])
    }

    /// The nonzeros as (row, column, value).
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (usize, usize, Expr)> + '_ {
        self.sparsity.iter().zip(&self.values).map(|((row, col), &value)| (row, col, value))
    }
}
