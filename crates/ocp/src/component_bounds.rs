use crate::error::OcpError;

/// A lower and an upper bound per component; infinities stand for "none".
#[derive(Debug, Clone, PartialEq)]
pub struct ComponentBounds {
    /// Lower bounds.
    pub lower: Vec<f64>,
    /// Upper bounds.
    pub upper: Vec<f64>,
}

impl ComponentBounds {
    /// `lower ≤ · ≤ upper`.
    pub fn new(lower: Vec<f64>, upper: Vec<f64>) -> Self {
        Self { lower, upper }
    }

    /// No bound on any of `len` components.
    pub fn unbounded(len: usize) -> Self {
        Self { lower: vec![f64::NEG_INFINITY; len], upper: vec![f64::INFINITY; len] }
    }

    /// `|·| ≤ limit` for every component.
    pub fn symmetric(limits: &[f64]) -> Self {
        Self { lower: limits.iter().map(|l| -l).collect(), upper: limits.to_vec() }
    }

    /// How many components it bounds.
    pub fn len(&self) -> usize {
        self.lower.len()
    }

    /// Whether it bounds no component.
    pub fn is_empty(&self) -> bool {
        self.lower.is_empty()
    }

    pub(crate) fn bounds_component(&self, index: usize) -> bool {
        self.lower[index].is_finite() || self.upper[index].is_finite()
    }

    pub(crate) fn check(&self, what: &'static str, expected: usize) -> Result<(), OcpError> {
        for side in [&self.lower, &self.upper] {
            if side.len() != expected {
                return Err(OcpError::Dimension { what, expected, found: side.len() });
            }
        }
        for (index, (&lower, &upper)) in self.lower.iter().zip(&self.upper).enumerate() {
            if lower.is_nan() || upper.is_nan() || lower > upper {
                return Err(OcpError::CrossedBounds { what, index, lower, upper });
            }
        }
        Ok(())
    }
}
