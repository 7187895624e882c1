/// Bounds of the variables (n entries each) and of the constraints (m entries each).
#[derive(Debug, PartialEq)]
pub struct Bounds<'a> {
    /// Least values of the variables.
    pub x_lower: &'a mut [f64],
    /// Greatest values of the variables.
    pub x_upper: &'a mut [f64],
    /// Least values of the constraints.
    pub g_lower: &'a mut [f64],
    /// Greatest values of the constraints.
    pub g_upper: &'a mut [f64],
}
