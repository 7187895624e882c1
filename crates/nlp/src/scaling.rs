/// Factors by which the optimizer multiplies functions and variables before it measures anything.
#[derive(Debug, Clone, PartialEq)]
pub struct Scaling {
    /// Factor of the objective; negative maximises.
    pub objective: f64,
    /// Positive factors of the variables (n); `None`: all one.
    pub x: Option<Vec<f64>>,
    /// Positive factors of the constraints (m); `None`: all one.
    pub g: Option<Vec<f64>>,
}
