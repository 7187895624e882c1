//! A table as columns with types and rows of cells, for whoever writes it down.

use std::io::{self, Write};

use serde_json::Value;

use crate::dimension::Column;
use crate::setting::Kind;
use crate::table::{RESULT_COLUMNS, Row, Table};

/// What the cells of a column hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CellKind {
    Text,
    Number,
    Whole,
    Flag,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Head {
    pub name: String,
    pub kind: CellKind,
}

/// One cell; a text that is empty and a number that is not finite stand for nothing.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Cell {
    Text(String),
    Number(f64),
    Whole(u32),
    Flag(bool),
}

impl Table {
    /// The columns: the case, what it sets, what it came to, how it was computed.
    pub(crate) fn heads(&self) -> Vec<Head> {
        use CellKind::{Flag, Number, Text, Whole};
        let mut heads = vec![head(RESULT_COLUMNS[0], Text)];
        heads.extend(self.sweep().columns().iter().flat_map(heads_of));
        let kinds = [Text, Flag, Number, Number, Number, Number, Whole, Text, Number, Whole];
        heads.extend(RESULT_COLUMNS[1..].iter().zip(kinds).map(|(name, kind)| head(name, kind)));
        heads
    }

    /// The cells of a case, one a column.
    pub(crate) fn cells(&self, index: usize, row: &Row) -> Vec<Cell> {
        let case = self.sweep().case(index);
        let mut cells = vec![Cell::Text(case.id.to_string())];
        for (column, value) in self.sweep().columns().iter().zip(&case.values) {
            cells.extend(cells_of(column, value));
        }
        cells.extend([
            Cell::Text(row.status.to_string()),
            Cell::Flag(row.verified),
            Cell::Number(row.attitude_error),
            Cell::Number(row.final_rate_deg_s),
            Cell::Number(row.joint_rate_deg_s),
            Cell::Number(row.objective),
            Cell::Whole(row.iterations),
            Cell::Text(self.reason(row).unwrap_or_default().to_owned()),
            Cell::Number(row.solve_s),
            Cell::Whole(row.attempts),
        ]);
        cells
    }

    /// The recorded cases with their places, in the order of the plan.
    pub(crate) fn recorded(&self) -> impl Iterator<Item = (usize, &Row)> {
        self.rows().iter().enumerate().filter_map(|(index, row)| Some((index, row.as_ref()?)))
    }

    /// Writes `results.csv`: one row a recorded case, in the order of the plan.
    ///
    /// # Errors
    /// Those of writing.
    pub fn write_csv(&self, writer: &mut dyn Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(io::BufWriter::new(writer));
        csv.write_record(self.heads().iter().map(|head| &head.name))?;
        for (index, row) in self.recorded() {
            csv.write_record(self.cells(index, row).iter().map(Cell::to_text))?;
        }
        csv.flush()
    }
}

impl Cell {
    pub(crate) fn to_text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(value) if !value.is_finite() => String::new(),
            Self::Number(value) if *value == 0.0 || (1e-3..1e9).contains(&value.abs()) => {
                value.to_string()
            }
            Self::Number(value) => format!("{value:e}"),
            Self::Whole(value) => value.to_string(),
            Self::Flag(value) => value.to_string(),
        }
    }
}

impl Column {
    /// A setting as the table shows it.
    pub fn shown(&self, setting: &Value) -> String {
        let cells: Vec<String> = cells_of(self, setting).iter().map(Cell::to_text).collect();
        cells.join(", ")
    }
}

/// The columns of a setting.
pub(crate) fn heads_of(column: &Column) -> Vec<Head> {
    let Column { name, kind, .. } = column;
    match *kind {
        Kind::Number => vec![head(name, CellKind::Number)],
        Kind::Named | Kind::Text => vec![head(name, CellKind::Text)],
        Kind::Vector(3) => {
            ["x", "y", "z"].map(|axis| head(&format!("{name}_{axis}"), CellKind::Number)).to_vec()
        }
        Kind::Vector(len) => {
            (0..len).map(|i| head(&format!("{name}[{i}]"), CellKind::Number)).collect()
        }
    }
}

/// The cells of a setting, one a column.
pub(crate) fn cells_of(column: &Column, setting: &Value) -> Vec<Cell> {
    match (column.kind, setting) {
        (Kind::Number, value) => vec![number(value)],
        (Kind::Vector(_), Value::Array(elements)) => elements.iter().map(number).collect(),
        (Kind::Named, Value::Object(fields)) => {
            vec![Cell::Text(
                fields.get("name").and_then(Value::as_str).unwrap_or_default().to_owned(),
            )]
        }
        (_, Value::String(text)) => vec![Cell::Text(text.clone())],
        (_, other) => vec![Cell::Text(other.to_string())],
    }
}

fn head(name: &str, kind: CellKind) -> Head {
    Head { name: name.to_owned(), kind }
}

fn number(value: &Value) -> Cell {
    Cell::Number(value.as_f64().unwrap_or(f64::NAN))
}
