//! MATLAB files of level 5: one variable a group of columns of `trajectory.csv`.

use righting_results::Trajectory;

use crate::columns::{Columns, groups};

// Data types and array class of the format.
const INT8: u32 = 1;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
const DOUBLE_CLASS: u32 = 6;

/// The trajectory as a MATLAB file of level 5, uncompressed, little-endian: matrices of doubles, named
/// as the arrays of [`npz`](crate::npz), with times and power as columns.
pub fn mat(trajectory: &Trajectory) -> Vec<u8> {
    let mut bytes = format!("{:<116}", "MATLAB 5.0 MAT-file, written by Righting").into_bytes();
    // No subsystem data; version and byte order.
    bytes.extend([0; 8]);
    bytes.extend(0x0100_u16.to_le_bytes());
    bytes.extend(b"IM");
    for columns in groups(trajectory) {
        bytes.extend(element(MATRIX, &matrix(&columns)));
    }
    bytes
}

fn matrix(columns: &Columns) -> Vec<u8> {
    let width = columns.width.unwrap_or(1);
    // A plan has at most 100 000 rows of 32 values.
    let dimensions = [columns.rows, width].map(|length| length as i32);
    let value = |row: usize, column: usize| columns.values[row * width + column];
    let by_column = (0..width).flat_map(|column| (0..columns.rows).map(move |row| (row, column)));
    let mut bytes = element(UINT32, &[DOUBLE_CLASS, 0].map(u32::to_le_bytes).concat());
    bytes.extend(element(INT32, &dimensions.map(i32::to_le_bytes).concat()));
    bytes.extend(element(INT8, columns.name.as_bytes()));
    let values: Vec<u8> =
        by_column.flat_map(|(row, column)| value(row, column).to_le_bytes()).collect();
    bytes.extend(element(DOUBLE, &values));
    bytes
}

/// A data element: type, length and the data, padded to eight bytes.
fn element(data_type: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = [data_type, data.len() as u32].map(u32::to_le_bytes).concat();
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}
