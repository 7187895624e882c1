use righting_symbolic::{Expr, SparseMatrix, Sparsity};

use crate::matrix_output::MatrixOutput;

/// A small dense matrix of expressions whose products skip the structural zeros.
#[derive(Clone)]
pub(crate) struct ExprMatrix {
    rows: usize,
    columns: usize,
    entries: Vec<Expr>,
}

impl ExprMatrix {
    pub(crate) fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, entries: vec![Expr::constant(0.0); rows * columns] }
    }

    /// `[I 0]`: the first `rows` of `columns` variables themselves.
    pub(crate) fn identity(rows: usize, columns: usize) -> Self {
        let mut matrix = Self::zeros(rows, columns);
        for i in 0..rows {
            *matrix.at_mut(i, i) = Expr::constant(1.0);
        }
        matrix
    }

    pub(crate) fn columns(&self) -> usize {
        self.columns
    }

    pub(crate) fn at(&self, row: usize, column: usize) -> Expr {
        self.entries[row * self.columns + column]
    }

    pub(crate) fn at_mut(&mut self, row: usize, column: usize) -> &mut Expr {
        &mut self.entries[row * self.columns + column]
    }

    /// The matrix that `output` describes, its varying entries taken from `values`.
    pub(crate) fn from_output(
        output: &MatrixOutput,
        values: &[Expr],
        rows: usize,
        columns: usize,
    ) -> Self {
        let mut matrix = Self::zeros(rows, columns);
        let mut next = values.iter().copied();
        for (&(row, column), constant) in output.entries.iter().zip(&output.constants) {
            *matrix.at_mut(row, column) = match constant {
                Some(constant) => Expr::constant(*constant),
                None => next.next().expect("one value per varying entry"),
            };
        }
        matrix
    }

    /// The square matrix whose lower triangle this is.
    pub(crate) fn mirrored(mut self) -> Self {
        for i in 0..self.rows {
            for j in 0..i {
                *self.at_mut(j, i) = self.at(i, j);
            }
        }
        self
    }

    /// `self · right`, with `right` taken as its first `self.columns` rows.
    pub(crate) fn times(&self, right: &Self) -> Self {
        let mut product = Self::zeros(self.rows, right.columns);
        for i in 0..self.rows {
            for k in 0..self.columns {
                let left = self.at(i, k);
                if is_zero(left) {
                    continue;
                }
                for j in 0..right.columns {
                    let entry = right.at(k, j);
                    if !is_zero(entry) {
                        *product.at_mut(i, j) += left * entry;
                    }
                }
            }
        }
        product
    }

    /// `self + scale · right`.
    pub(crate) fn plus_scaled(&self, scale: Expr, right: &Self) -> Self {
        let entries =
            self.entries.iter().zip(&right.entries).map(|(&a, &b)| a + scale * b).collect();
        Self { rows: self.rows, columns: self.columns, entries }
    }

    pub(crate) fn negated(mut self) -> Self {
        self.entries.iter_mut().for_each(|entry| *entry = -*entry);
        self
    }

    /// `selfᵀ · vector`.
    pub(crate) fn transposed_times(&self, vector: &[Expr]) -> Vec<Expr> {
        let mut product = vec![Expr::constant(0.0); self.columns];
        for (i, &factor) in vector.iter().enumerate() {
            for (j, entry) in product.iter_mut().enumerate() {
                *entry += self.at(i, j) * factor;
            }
        }
        product
    }

    /// The matrix with `rows` below appended.
    pub(crate) fn stacked(mut self, below: &Self) -> Self {
        debug_assert_eq!(self.columns, below.columns);
        self.entries.extend_from_slice(&below.entries);
        self.rows += below.rows;
        self
    }

    /// The first `columns` columns.
    pub(crate) fn leading_columns(&self, columns: usize) -> Self {
        let mut part = Self::zeros(self.rows, columns);
        for i in 0..self.rows {
            for j in 0..columns {
                *part.at_mut(i, j) = self.at(i, j);
            }
        }
        part
    }

    /// Adds the lower triangle of `selfᵀ · symmetric · self` to `sum`.
    pub(crate) fn add_congruence_lower(&self, symmetric: &Self, sum: &mut Self) {
        let half = symmetric.times(self);
        for k in 0..self.rows {
            for i in 0..self.columns {
                let left = self.at(k, i);
                if is_zero(left) {
                    continue;
                }
                for j in 0..=i {
                    let right = half.at(k, j);
                    if !is_zero(right) {
                        *sum.at_mut(i, j) += left * right;
                    }
                }
            }
        }
    }

    /// The entries that are not structurally zero.
    pub(crate) fn to_sparse(&self) -> SparseMatrix {
        let (entries, values): (Vec<_>, Vec<_>) = (0..self.rows)
            .flat_map(|i| (0..self.columns).map(move |j| (i, j)))
            .map(|(i, j)| ((i, j), self.at(i, j)))
            .filter(|&(_, value)| !is_zero(value))
            .unzip();
        Sparsity::new(self.rows, self.columns, entries)
            .and_then(|sparsity| SparseMatrix::new(sparsity, values))
            .expect("entries taken from the matrix, in row-major order, fit it")
    }
}

fn is_zero(expression: Expr) -> bool {
    expression.as_constant() == Some(0.0)
}
