//! Sizes of a node as the factorisation sees them.

/// Counts of one node's unknowns and constraint rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct NodeShape {
    /// Leading unknowns that the constraints see: controls (at node 0 the states before them).
    pub free: usize,
    pub equalities: usize,
    /// Trailing states: none at node 0.
    pub states: usize,
    pub defects: usize,
    pub inequalities: usize,
}

impl NodeShape {
    pub fn leading(&self) -> usize {
        self.free + self.equalities
    }
}
