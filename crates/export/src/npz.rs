//! NumPy archives: one array a group of columns of `trajectory.csv`.

use std::io::{Cursor, Write};

use righting_results::{ControlInterval, Node, Trajectory};
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, result::ZipError};

use crate::ExportError;

/// The trajectory as an `.npz` archive of uncompressed arrays of doubles, in C order:
///
/// | array | shape | |
/// | --- | --- | --- |
/// | `t_s`, `power_w` | N + 1 | time, mechanical power of the joints |
/// | `r_m`, `v_m_s` | N + 1, 3 | position and velocity of the base, inertial axes |
/// | `q_wxyz` | N + 1, 4 | attitude, body → inertial, scalar first |
/// | `w_rad_s` | N + 1, 3 | angular rate, body axes |
/// | `q_rad`, `dq_rad_s` | N + 1, j | joint angles and rates |
/// | `u_rad_s2`, `tau_n_m` | N, j | joint accelerations and, at the first node, torques of an interval |
///
/// # Errors
/// [`ExportError::Archive`] for more data than an archive without its 64-bit extension holds.
pub fn npz(trajectory: &Trajectory) -> Result<Vec<u8>, ExportError> {
    let nodes = trajectory.nodes();
    let intervals = trajectory.intervals();
    let joints = trajectory.joints();
    let of_nodes = |name, width: Option<usize>, row: &dyn Fn(&Node) -> Vec<f64>| Array {
        name,
        rows: nodes.len(),
        width,
        values: nodes.iter().flat_map(row).collect(),
    };
    let of_intervals = |name, row: &dyn Fn(&ControlInterval) -> Vec<f64>| Array {
        name,
        rows: intervals.len(),
        width: Some(joints),
        values: intervals.iter().flat_map(row).collect(),
    };
    let arrays = [
        of_nodes("t_s", None, &|node| vec![node.time_s]),
        of_nodes("r_m", Some(3), &|node| node.position_m.to_vec()),
        of_nodes("q_wxyz", Some(4), &|node| node.attitude.to_vec()),
        of_nodes("v_m_s", Some(3), &|node| node.velocity_m_s.to_vec()),
        of_nodes("w_rad_s", Some(3), &|node| node.angular_rate_rad_s.to_vec()),
        of_nodes("q_rad", Some(joints), &|node| node.joint_angles_rad.clone()),
        of_nodes("dq_rad_s", Some(joints), &|node| node.joint_rates_rad_s.clone()),
        of_intervals("u_rad_s2", &|interval| interval.joint_accelerations_rad_s2.clone()),
        of_intervals("tau_n_m", &|interval| interval.joint_torques_n_m.clone()),
        of_nodes("power_w", None, &|node| vec![node.power_w]),
    ];
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    for array in arrays {
        archive.start_file(format!("{}.npy", array.name), options)?;
        archive.write_all(&array.npy()).map_err(ZipError::from)?;
    }
    Ok(archive.finish()?.into_inner())
}

/// A matrix, or a vector where it has no width.
struct Array {
    name: &'static str,
    rows: usize,
    width: Option<usize>,
    values: Vec<f64>,
}

impl Array {
    /// The array in NumPy's format, version 1.0: a dictionary padded to a multiple of 64 bytes, and
    /// the values.
    fn npy(&self) -> Vec<u8> {
        const PREFIX: usize = 10;
        let shape = match self.width {
            Some(width) => format!("({}, {width})", self.rows),
            None => format!("({},)", self.rows),
        };
        let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
        let unpadded = PREFIX + header.len() + 1;
        header.push_str(&" ".repeat(unpadded.next_multiple_of(64) - unpadded));
        header.push('\n');
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        // A header of two numbers is far below 64 KiB.
        bytes.extend((header.len() as u16).to_le_bytes());
        bytes.extend(header.as_bytes());
        bytes.extend(self.values.iter().flat_map(|value| value.to_le_bytes()));
        bytes
    }
}
