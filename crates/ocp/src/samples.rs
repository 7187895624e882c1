/// One row of `width` numbers per node or per step.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    width: usize,
    values: Vec<f64>,
}

impl Samples {
    /// No rows yet.
    pub fn new(width: usize) -> Self {
        Self { width, values: Vec::new() }
    }

    /// The same row `rows` times.
    pub fn repeated(row: &[f64], rows: usize) -> Self {
        Self { width: row.len(), values: row.repeat(rows) }
    }

    /// Numbers per row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows. Rows of width zero are not counted.
    pub fn len(&self) -> usize {
        self.values.len().checked_div(self.width).unwrap_or(0)
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Row `index`.
    pub fn row(&self, index: usize) -> &[f64] {
        &self.values[index * self.width..(index + 1) * self.width]
    }

    /// Row `index`, to be changed.
    pub fn row_mut(&mut self, index: usize) -> &mut [f64] {
        &mut self.values[index * self.width..(index + 1) * self.width]
    }

    /// Appends a row.
    ///
    /// # Panics
    /// When `row` has another width.
    pub fn push(&mut self, row: &[f64]) {
        assert_eq!(row.len(), self.width, "rows of one table have one width");
        self.values.extend_from_slice(row);
    }

    /// The rows in order.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        (0..self.len()).map(|index| self.row(index))
    }

    /// Index, row by row, and value of the first number that is infinite or none.
    pub fn first_not_finite(&self) -> Option<(usize, f64)> {
        self.values.iter().copied().enumerate().find(|(_, value)| !value.is_finite())
    }
}
