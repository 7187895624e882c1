use righting_symbolic::{Expr, SparseMatrix};

use crate::block::lanes;

/// A matrix output of a compiled function: its structure, the entries that are constant, and where
/// the values that the function computes belong.
#[derive(Debug, Clone)]
pub(crate) struct MatrixOutput {
    /// Row and column of each structural entry, sorted by row, then by column.
    pub(crate) entries: Vec<(usize, usize)>,
    /// The constant of each entry, `None` where the function computes it.
    pub(crate) constants: Vec<Option<f64>>,
}

impl MatrixOutput {
    pub(crate) fn of(matrix: &SparseMatrix) -> Self {
        Self {
            entries: matrix.sparsity().iter().collect(),
            constants: matrix.values.iter().map(|value| value.as_constant()).collect(),
        }
    }

    /// Row, column and value of every entry at one point: the constants, and what the function has
    /// computed in one lane of its output.
    pub(crate) fn at_lane<'a>(
        &'a self,
        computed: &'a [f64],
        lane: usize,
    ) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
        let mut varying = 0;
        self.entries.iter().zip(&self.constants).map(move |(&(row, column), constant)| {
            let value = constant.unwrap_or_else(|| {
                varying += 1;
                lanes(computed, varying - 1)[lane]
            });
            (row, column, value)
        })
    }

    /// How many values the function computes.
    pub(crate) fn varying(&self) -> usize {
        self.constants.iter().filter(|constant| constant.is_none()).count()
    }
}

/// The values of a matrix that are not constants.
pub(crate) fn varying(matrix: &SparseMatrix) -> Vec<Expr> {
    matrix.values.iter().copied().filter(|value| value.as_constant().is_none()).collect()
}
