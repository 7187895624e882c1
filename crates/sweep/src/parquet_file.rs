//! `results.parquet`: the table for whoever has millions of rows.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int32Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};

use crate::cells::{Cell, CellKind, Head};
use crate::table::Table;

/// Rows that are in memory at a time.
const ROW_GROUP: usize = 1 << 16;

impl Table {
    /// Writes `results.parquet`: the columns and rows of [`write_csv`](Self::write_csv), uncompressed
    /// but for repeated values; what is empty there is null here.
    ///
    /// # Errors
    /// Those of writing.
    pub fn write_parquet(&self, writer: &mut (dyn Write + Send)) -> io::Result<()> {
        self.write_groups(writer).map_err(|error| match error {
            // A full disk shall say so.
            ParquetError::External(source) => match source.downcast::<io::Error>() {
                Ok(error) => *error,
                Err(source) => io::Error::other(source),
            },
            other => io::Error::other(other),
        })
    }

    fn write_groups(&self, writer: &mut (dyn Write + Send)) -> Result<(), ParquetError> {
        let heads = self.heads();
        let properties = Arc::new(WriterProperties::builder().build());
        let mut file = SerializedFileWriter::new(writer, schema(&heads)?, properties)?;
        let mut recorded = self.recorded().peekable();
        while recorded.peek().is_some() {
            let mut columns: Vec<Vec<Cell>> = heads.iter().map(|_| Vec::new()).collect();
            for (index, row) in recorded.by_ref().take(ROW_GROUP) {
                for (column, cell) in columns.iter_mut().zip(self.cells(index, row)) {
                    column.push(cell);
                }
            }
            let mut group = file.next_row_group()?;
            for (head, cells) in heads.iter().zip(columns) {
                write_column(&mut group, head.kind, cells)?;
            }
            group.close()?;
        }
        file.close()?;
        Ok(())
    }
}

fn schema(heads: &[Head]) -> Result<TypePtr, ParquetError> {
    let field = |head: &Head| {
        let (physical, logical) = match head.kind {
            CellKind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            CellKind::Number => (Physical::DOUBLE, None),
            CellKind::Whole => (Physical::INT32, None),
            CellKind::Flag => (Physical::BOOLEAN, None),
        };
        let field = Type::primitive_type_builder(&head.name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(logical);
        Ok(Arc::new(field.build()?))
    };
    let fields = heads.iter().map(field).collect::<Result<_, ParquetError>>()?;
    Ok(Arc::new(Type::group_type_builder("results").with_fields(fields).build()?))
}

fn write_column<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    kind: CellKind,
    cells: Vec<Cell>,
) -> Result<(), ParquetError> {
    match kind {
        CellKind::Text => write::<ByteArrayType, _>(group, cells, |cell| match cell {
            Cell::Text(text) if !text.is_empty() => Some(ByteArray::from(text.into_bytes())),
            _ => None,
        }),
        CellKind::Number => write::<DoubleType, _>(group, cells, |cell| match cell {
            Cell::Number(value) if value.is_finite() => Some(value),
            _ => None,
        }),
        CellKind::Whole => write::<Int32Type, _>(group, cells, |cell| match cell {
            Cell::Whole(value) => Some(i32::try_from(value).unwrap_or(i32::MAX)),
            _ => None,
        }),
        CellKind::Flag => write::<BoolType, _>(group, cells, |cell| match cell {
            Cell::Flag(value) => Some(value),
            _ => None,
        }),
    }
}

/// Writes one column: its values, and for each row whether it has one.
fn write<T: DataType, W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    cells: Vec<Cell>,
    value: impl Fn(Cell) -> Option<T::T>,
) -> Result<(), ParquetError> {
    let values: Vec<Option<T::T>> = cells.into_iter().map(value).collect();
    let present: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    let values: Vec<T::T> = values.into_iter().flatten().collect();
    let missing = || ParquetError::General("fewer columns than the schema has".to_owned());
    let mut column = group.next_column()?.ok_or_else(missing)?;
    column.typed::<T>().write_batch(&values, Some(&present), None)?;
    column.close()
}
