//! What stands in for [`PngPainter`] in a build without the feature `png`.

use std::convert::Infallible;

use crate::ReportError;

/// There is none.
pub struct PngPainter(Infallible);

impl PngPainter {
    /// # Errors
    /// Always [`ReportError::NoPng`].
    pub fn new() -> Result<Self, ReportError> {
        Err(ReportError::NoPng)
    }

    pub fn paint(&self, _svg: &str) -> Result<Vec<u8>, String> {
        match self.0 {}
    }
}
