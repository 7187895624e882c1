/// A sparsity pattern as coordinates that count from zero.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TripletStructure {
    /// Row of each entry.
    pub rows: Vec<i32>,
    /// Column of each entry.
    pub columns: Vec<i32>,
}

impl TripletStructure {
    /// The number of entries.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no entries.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}
