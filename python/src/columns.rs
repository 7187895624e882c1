//! The columns of a trajectory as arrays of NumPy.

use numpy::ndarray::Array2;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use righting_results::{ControlInterval, Node, Trajectory};

/// One array a column, made once and read-only: N + 1 nodes, N intervals, j joints.
pub struct Columns {
    pub time_s: Py<PyArray1<f64>>,
    pub position_m: Py<PyArray2<f64>>,
    pub quaternion: Py<PyArray2<f64>>,
    pub velocity_m_s: Py<PyArray2<f64>>,
    pub angular_rate_rad_s: Py<PyArray2<f64>>,
    pub joint_angles_rad: Py<PyArray2<f64>>,
    pub joint_rates_rad_s: Py<PyArray2<f64>>,
    pub joint_accelerations_rad_s2: Py<PyArray2<f64>>,
    pub joint_torques_n_m: Py<PyArray2<f64>>,
    pub power_w: Py<PyArray1<f64>>,
}

impl Columns {
    pub fn new(py: Python<'_>, trajectory: &Trajectory) -> PyResult<Self> {
        let (nodes, intervals) = (trajectory.nodes(), trajectory.intervals());
        let joints = trajectory.joints();
        let of_nodes = |width: usize, row: fn(&Node) -> &[f64]| {
            matrix(py, width, nodes.iter().flat_map(row).copied().collect())
        };
        let of_intervals = |row: fn(&ControlInterval) -> &[f64]| {
            matrix(py, joints, intervals.iter().flat_map(row).copied().collect())
        };
        Ok(Self {
            time_s: vector(py, nodes.iter().map(|node| node.time_s).collect()),
            position_m: of_nodes(3, |node| &node.position_m)?,
            quaternion: of_nodes(4, |node| &node.attitude)?,
            velocity_m_s: of_nodes(3, |node| &node.velocity_m_s)?,
            angular_rate_rad_s: of_nodes(3, |node| &node.angular_rate_rad_s)?,
            joint_angles_rad: of_nodes(joints, |node| &node.joint_angles_rad)?,
            joint_rates_rad_s: of_nodes(joints, |node| &node.joint_rates_rad_s)?,
            joint_accelerations_rad_s2: of_intervals(|interval| {
                &interval.joint_accelerations_rad_s2
            })?,
            joint_torques_n_m: of_intervals(|interval| &interval.joint_torques_n_m)?,
            power_w: vector(py, nodes.iter().map(|node| node.power_w).collect()),
        })
    }
}

/// A read-only array that takes the values over.
pub fn vector(py: Python<'_>, values: Vec<f64>) -> Py<PyArray1<f64>> {
    let array = PyArray1::from_vec(py, values);
    array.readwrite().make_nonwriteable();
    array.unbind()
}

/// A read-only array that takes the values over, row by row, each of `width`.
pub fn matrix(py: Python<'_>, width: usize, values: Vec<f64>) -> PyResult<Py<PyArray2<f64>>> {
    let rows = values.len() / width.max(1);
    let matrix = Array2::from_shape_vec((rows, width), values)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    let array = PyArray2::from_owned_array(py, matrix);
    array.readwrite().make_nonwriteable();
    Ok(array.unbind())
}
