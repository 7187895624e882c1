//! NumPy archives: one array a group of columns of `trajectory.csv`.

use std::io::{Cursor, Write};

use righting_results::Trajectory;
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, result::ZipError};

use crate::ExportError;
use crate::columns::{Columns, groups};

/// The trajectory as an `.npz` archive of uncompressed arrays of doubles, in C order:
///
/// | array | shape | |
/// | --- | --- | --- |
/// | `t_s`, `power_w` | N + 1 | time, mechanical power of the joints |
/// | `r_m`, `v_m_s` | N + 1, 3 | position and velocity of the base, inertial axes |
/// | `q_wxyz` | N + 1, 4 | attitude, body → inertial, scalar first |
/// | `w_rad_s` | N + 1, 3 | angular rate, body axes |
/// | `q_rad`, `dq_rad_s` | N + 1, j | joint angles and rates |
/// | `u_rad_s2`, `tau_n_m` | N, j | joint accelerations and torques at the first node of an interval |
/// | `j_rad_s3` | N, j | joint jerks of an interval, where the plan has them |
///
/// # Errors
/// [`ExportError::Archive`] for more data than an archive without its 64-bit extension holds.
pub fn npz(trajectory: &Trajectory) -> Result<Vec<u8>, ExportError> {
    let arrays = groups(trajectory).into_iter().map(|Columns { name, rows, width, values }| {
        Array { name, shape: std::iter::once(rows).chain(width).collect(), values }
    });
    archive(arrays)
}

/// An array in C order.
pub(crate) struct Array {
    pub name: &'static str,
    pub shape: Vec<usize>,
    pub values: Vec<f64>,
}

/// Arrays as an archive, not compressed.
pub(crate) fn archive(arrays: impl IntoIterator<Item = Array>) -> Result<Vec<u8>, ExportError> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    for array in arrays {
        archive.start_file(format!("{}.npy", array.name), options)?;
        archive.write_all(&npy(&array)).map_err(ZipError::from)?;
    }
    Ok(archive.finish()?.into_inner())
}

/// The array in NumPy's format, version 1.0: a dictionary padded to a multiple of 64 bytes, and the
/// values.
fn npy(array: &Array) -> Vec<u8> {
    const PREFIX: usize = 10;
    let lengths: Vec<String> = array.shape.iter().map(usize::to_string).collect();
    // A tuple of one has a comma.
    let shape = match &lengths[..] {
        [rows] => format!("({rows},)"),
        lengths => format!("({})", lengths.join(", ")),
    };
    let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
    let unpadded = PREFIX + header.len() + 1;
    header.push_str(&" ".repeat(unpadded.next_multiple_of(64) - unpadded));
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    // A header of three numbers is far below 64 KiB.
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(array.values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}
