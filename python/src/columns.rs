//! The columns of a trajectory as arrays of NumPy.

use numpy::ndarray::Array2;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use righting_results::{ControlInterval, Node, Trajectory};

/// One array a column, made once and read-only: N + 1 nodes, N intervals, j joints, w wheels.
pub struct Columns {
    pub time_s: Py<PyArray1<f64>>,
    pub position_m: Py<PyArray2<f64>>,
    pub quaternion: Py<PyArray2<f64>>,
    pub velocity_m_s: Py<PyArray2<f64>>,
    pub angular_rate_rad_s: Py<PyArray2<f64>>,
    pub joint_angles_rad: Py<PyArray2<f64>>,
    pub joint_rates_rad_s: Py<PyArray2<f64>>,
    pub joint_accelerations_rad_s2: Py<PyArray2<f64>>,
    /// None where accelerations are held.
    pub joint_jerks_rad_s3: Option<Py<PyArray2<f64>>>,
    pub joint_torques_n_m: Py<PyArray2<f64>>,
    pub power_w: Py<PyArray1<f64>>,
    pub wheel_momenta_n_m_s: Py<PyArray2<f64>>,
    pub wheel_torques_n_m: Py<PyArray2<f64>>,
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
        let wheels = trajectory.wheels();
        let wheel_torques = intervals.iter().flat_map(|interval| &interval.wheel_torques_n_m);
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
            joint_jerks_rad_s3: trajectory
                .has_jerks()
                .then(|| of_intervals(|interval| &interval.joint_jerks_rad_s3))
                .transpose()?,
            joint_torques_n_m: of_intervals(|interval| &interval.joint_torques_n_m)?,
            power_w: vector(py, nodes.iter().map(|node| node.power_w).collect()),
            wheel_momenta_n_m_s: of_nodes(wheels, |node| &node.wheel_momenta_n_m_s)?,
            wheel_torques_n_m: matrix(py, wheels, wheel_torques.copied().collect())?,
        })
    }
}

/// The arrays in the order of their fields, for another process.
pub fn to_tuple<'py>(py: Python<'py>, columns: &Columns) -> PyResult<Bound<'py, PyTuple>> {
    let vectors =
        [&columns.time_s, &columns.power_w].map(|array| array.bind(py).clone().into_any());
    let matrices = [
        &columns.position_m,
        &columns.quaternion,
        &columns.velocity_m_s,
        &columns.angular_rate_rad_s,
        &columns.joint_angles_rad,
        &columns.joint_rates_rad_s,
        &columns.joint_accelerations_rad_s2,
        &columns.joint_torques_n_m,
        &columns.wheel_momenta_n_m_s,
        &columns.wheel_torques_n_m,
    ];
    let matrices = matrices.into_iter().chain(&columns.joint_jerks_rad_s3);
    let matrices = matrices.map(|array| array.bind(py).clone().into_any());
    PyTuple::new(py, vectors.into_iter().chain(matrices).collect::<Vec<_>>())
}

/// The trajectory whose arrays [`to_tuple`] gave.
///
/// # Errors
/// The arrays are others, or do not fit together.
pub fn trajectory(arrays: &Bound<'_, PyTuple>) -> PyResult<Trajectory> {
    let vector = |index: usize| -> PyResult<Vec<f64>> {
        let array: PyReadonlyArray1<'_, f64> = arrays.get_item(index)?.extract()?;
        Ok(array.as_array().to_vec())
    };
    let matrix = |index: usize| -> PyResult<Vec<Vec<f64>>> {
        let array: PyReadonlyArray2<'_, f64> = arrays.get_item(index)?.extract()?;
        Ok(array.as_array().rows().into_iter().map(|row| row.to_vec()).collect())
    };
    let (times, powers) = (vector(0)?, vector(1)?);
    let [positions, attitudes, velocities, angular_rates, angles, rates] =
        [matrix(2)?, matrix(3)?, matrix(4)?, matrix(5)?, matrix(6)?, matrix(7)?];
    // Empty where there are no wheels.
    let [wheel_momenta, wheel_torques] = [matrix(10)?, matrix(11)?];
    let mut wheel_torques = wheel_torques.into_iter();
    let nodes: Option<Vec<Node>> = (0..times.len())
        .map(|k| {
            Some(Node {
                time_s: times[k],
                position_m: array(positions.get(k)?)?,
                attitude: array(attitudes.get(k)?)?,
                velocity_m_s: array(velocities.get(k)?)?,
                angular_rate_rad_s: array(angular_rates.get(k)?)?,
                joint_angles_rad: angles.get(k)?.clone(),
                joint_rates_rad_s: rates.get(k)?.clone(),
                power_w: *powers.get(k)?,
                wheel_momenta_n_m_s: wheel_momenta.get(k).cloned().unwrap_or_default(),
            })
        })
        .collect();
    let mut jerks = match arrays.len() {
        ..=12 => Vec::new(),
        _ => matrix(12)?,
    }
    .into_iter();
    let intervals = matrix(8)?.into_iter().zip(matrix(9)?);
    let intervals = intervals
        .map(|(joint_accelerations_rad_s2, joint_torques_n_m)| ControlInterval {
            joint_accelerations_rad_s2,
            joint_jerks_rad_s3: jerks.next().unwrap_or_default(),
            joint_torques_n_m,
            wheel_torques_n_m: wheel_torques.next().unwrap_or_default(),
        })
        .collect();
    let nodes =
        nodes.ok_or_else(|| PyValueError::new_err("the arrays of a plan do not fit together"))?;
    Trajectory::new(nodes, intervals).map_err(|error| PyValueError::new_err(error.to_string()))
}

fn array<const N: usize>(row: &[f64]) -> Option<[f64; N]> {
    row.try_into().ok()
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
