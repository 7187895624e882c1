//! Named inputs and outputs.

use crate::sparsity::Sparsity;

/// A named input or output: a vector, or the nonzeros of a sparse matrix.
#[derive(Clone, Debug)]
pub struct Port {
    pub(super) name: String,
    pub(super) len: usize,
    pub(super) sparsity: Option<Sparsity>,
}

impl Port {
    /// The name given when the function was built.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of values for one point.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether the port carries no values.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// For a sparse matrix, which entry each value is.
    pub fn sparsity(&self) -> Option<&Sparsity> {
        self.sparsity.as_ref()
    }
}
