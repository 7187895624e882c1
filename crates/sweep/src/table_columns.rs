//! A table by columns, for programs that hold tables so.

use crate::cells::{Cell, CellKind};
use crate::table::Table;

/// A column of a table, in the order of the plan.
#[derive(Clone, Debug, PartialEq)]
pub struct TableColumn {
    /// Its head in `results.csv`.
    pub name: String,
    /// Its cells, one a recorded case.
    pub cells: ColumnCells,
}

/// The cells of a column, all of one kind.
#[derive(Clone, Debug, PartialEq)]
pub enum ColumnCells {
    /// Texts; none where there is nothing to say.
    Text(Vec<Option<String>>),
    /// Numbers; not finite where there is none.
    Number(Vec<f64>),
    /// Whole numbers.
    Whole(Vec<u32>),
    /// Yes or no.
    Flag(Vec<bool>),
}

impl Table {
    /// The columns and rows of [`write_csv`](Self::write_csv).
    pub fn columns(&self) -> Vec<TableColumn> {
        let heads = self.heads();
        let mut columns: Vec<Vec<Cell>> = heads.iter().map(|_| Vec::new()).collect();
        for (index, row) in self.recorded() {
            for (column, cell) in columns.iter_mut().zip(self.cells(index, row)) {
                column.push(cell);
            }
        }
        let named = heads.into_iter().zip(columns);
        named
            .map(|(head, cells)| TableColumn {
                name: head.name,
                cells: ColumnCells::of(head.kind, cells),
            })
            .collect()
    }
}

impl ColumnCells {
    /// Cells of a kind; one of another kind would be missing.
    fn of(kind: CellKind, cells: Vec<Cell>) -> Self {
        let cells = cells.into_iter();
        match kind {
            CellKind::Text => Self::Text(
                cells.map(|cell| Some(cell.to_text()).filter(|text| !text.is_empty())).collect(),
            ),
            CellKind::Number => Self::Number(
                cells
                    .map(|cell| match cell {
                        Cell::Number(value) => value,
                        _ => f64::NAN,
                    })
                    .collect(),
            ),
            CellKind::Whole => Self::Whole(
                cells
                    .map(|cell| match cell {
                        Cell::Whole(value) => value,
                        _ => 0,
                    })
                    .collect(),
            ),
            CellKind::Flag => {
                Self::Flag(cells.map(|cell| matches!(cell, Cell::Flag(true))).collect())
            }
        }
    }
}
