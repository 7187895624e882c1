use std::sync::{Mutex, PoisonError};

use numpy::ndarray::{ArrayD, IxDyn};
use numpy::{IntoPyArray, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use righting_symbolic::{Port, Workspace};

/// A compiled function from named inputs to named outputs: values, exact Jacobians and Hessians.
///
/// It is called with one array an input, each of shape (n,) for one point or (B, n) for B points; inputs of one point
/// are repeated where others have several. It returns a dictionary of arrays: (n,) or (rows, columns) an output, with B
/// in front where any input has several points. Matrices are dense, and Hessians whole. Points are evaluated side by
/// side in vector instructions, with Python's lock released; any thread may call.
#[pyclass(frozen, module = "righting")]
pub struct Function {
    function: righting_symbolic::Function,
    /// Of the outputs that are the lower triangle of a symmetric matrix.
    symmetric: &'static str,
    idle: Mutex<Vec<Workspace>>,
}

impl Function {
    /// A compiled function whose output called `symmetric`, if it has one, is a lower triangle.
    pub fn new(function: righting_symbolic::Function, symmetric: &'static str) -> Self {
        Self { function, symmetric, idle: Mutex::default() }
    }

    /// One list of values a port, for so many points.
    fn evaluate(&self, points: usize, inputs: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let free = idle().pop();
        let mut workspace = free.unwrap_or_else(|| self.function.workspace());
        let ports = self.function.output_ports().iter();
        let mut outputs: Vec<Vec<f64>> = ports.map(|port| vec![0.0; points * port.len()]).collect();
        {
            let inputs: Vec<&[f64]> = inputs.iter().map(Vec::as_slice).collect();
            let mut outputs: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
            self.function.evaluate_batch(&mut workspace, points, &inputs, &mut outputs);
        }
        idle().push(workspace);
        outputs
    }

    /// The values of a matrix, whole and row by row, of each point.
    fn dense(&self, port: &Port, points: usize, values: &[f64]) -> Option<(Vec<usize>, Vec<f64>)> {
        let sparsity = port.sparsity()?;
        let (rows, columns) = (sparsity.rows(), sparsity.cols());
        let mut dense = vec![0.0; points * rows * columns];
        for point in 0..points {
            let dense = &mut dense[point * rows * columns..][..rows * columns];
            let values = &values[point * port.len()..][..port.len()];
            for ((row, column), &value) in sparsity.iter().zip(values) {
                dense[row * columns + column] = value;
                if port.name() == self.symmetric {
                    dense[column * columns + row] = value;
                }
            }
        }
        Some((vec![rows, columns], dense))
    }
}

#[pymethods]
impl Function {
    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        self.function.name()
    }

    /// Names and lengths of the inputs, in the order of the arguments.
    #[getter]
    fn inputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let lengths = PyDict::new(py);
        for port in self.function.input_ports() {
            lengths.set_item(port.name(), port.len())?;
        }
        Ok(lengths)
    }

    /// Names and shapes of the outputs for one point.
    #[getter]
    fn outputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let shapes = PyDict::new(py);
        for port in self.function.output_ports() {
            let shape = match port.sparsity() {
                Some(sparsity) => PyTuple::new(py, [sparsity.rows(), sparsity.cols()])?,
                None => PyTuple::new(py, [port.len()])?,
            };
            shapes.set_item(port.name(), shape)?;
        }
        Ok(shapes)
    }

    /// Rows and columns of the entries of a matrix that are not structurally zero; of a Hessian, of its lower
    /// triangle.
    fn sparsity(&self, output: &str) -> PyResult<(Vec<usize>, Vec<usize>)> {
        let port = self.function.output_ports().iter().find(|port| port.name() == output);
        let sparsity = port.and_then(Port::sparsity);
        let sparsity = sparsity.ok_or_else(|| {
            PyValueError::new_err(format!("{}: no matrix is called {output:?}", self.name()))
        })?;
        Ok(sparsity.iter().unzip())
    }

    #[pyo3(signature = (*inputs))]
    fn __call__<'py>(&self, inputs: &Bound<'py, PyTuple>) -> PyResult<Bound<'py, PyDict>> {
        let py = inputs.py();
        let ports = self.function.input_ports();
        if inputs.len() != ports.len() {
            let names: Vec<&str> = ports.iter().map(Port::name).collect();
            return Err(PyTypeError::new_err(format!(
                "{}: found {} inputs, expected {}: {}",
                self.name(),
                inputs.len(),
                ports.len(),
                names.join(", ")
            )));
        }
        let arrays = ports.iter().zip(inputs).map(|(port, input)| given(port, &input));
        let arrays: Vec<PyReadonlyArrayDyn<'_, f64>> = arrays.collect::<PyResult<_>>()?;
        let counts = arrays.iter().filter(|array| array.ndim() == 2).map(|array| array.shape()[0]);
        let batch = counts.clone().next();
        if let Some(other) = counts.clone().find(|&count| Some(count) != batch) {
            let first = batch.unwrap_or(1);
            return Err(PyValueError::new_err(format!(
                "{}: found inputs of {first} and of {other} points, expected as many of each, or one",
                self.name()
            )));
        }
        let points = batch.unwrap_or(1);
        let values: Vec<Vec<f64>> = arrays
            .iter()
            .map(|array| {
                let values = array.as_array().iter().copied().collect::<Vec<f64>>();
                if array.ndim() == 2 { values } else { values.repeat(points) }
            })
            .collect();
        let outputs = py.detach(|| self.evaluate(points, &values));
        let named = PyDict::new(py);
        for (port, values) in self.function.output_ports().iter().zip(outputs) {
            let (shape, values) = match self.dense(port, points, &values) {
                Some(dense) => dense,
                None => (vec![port.len()], values),
            };
            let shape: Vec<usize> = batch.into_iter().chain(shape).collect();
            let array = ArrayD::from_shape_vec(IxDyn(&shape), values)
                .map_err(|error| PyValueError::new_err(error.to_string()))?;
            named.set_item(port.name(), array.into_pyarray(py))?;
        }
        Ok(named)
    }

    fn __repr__(&self) -> String {
        let list = |ports: &[Port]| {
            let names = ports.iter().map(|port| match port.sparsity() {
                Some(sparsity) => {
                    format!("{} ({}, {})", port.name(), sparsity.rows(), sparsity.cols())
                }
                None => format!("{} ({})", port.name(), port.len()),
            });
            names.collect::<Vec<_>>().join(", ")
        };
        let (inputs, outputs) = (self.function.input_ports(), self.function.output_ports());
        format!("Function({}: {} -> {})", self.name(), list(inputs), list(outputs))
    }
}

/// What was given for an input, as doubles: of one point, or of several.
fn given<'py>(port: &Port, input: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    let numpy = input.py().import("numpy")?;
    let array = numpy.call_method1("asarray", (input, "float64"))?;
    let array = array.cast::<PyArrayDyn<f64>>()?.readonly();
    match array.shape() {
        [len] | [_, len] if *len == port.len() => Ok(array),
        shape => Err(PyValueError::new_err(format!(
            "{}: found an array of shape {shape:?}, expected ({len},) or (points, {len})",
            port.name(),
            len = port.len()
        ))),
    }
}
