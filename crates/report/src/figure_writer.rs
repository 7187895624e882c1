//! Figures as files: SVG always, PNG beside it where asked for.

use std::path::{Path, PathBuf};

use righting_scenario::file_io;

use crate::ReportError;
use crate::png::PngPainter;

/// Writes figures.
#[derive(Default)]
pub struct FigureWriter {
    painter: Option<PngPainter>,
}

impl FigureWriter {
    /// As SVG alone.
    pub fn svg() -> Self {
        Self::default()
    }

    /// As SVG and as PNG.
    ///
    /// # Errors
    /// [`ReportError::NoPng`] of a build without the feature `png`, [`ReportError::NoFonts`] where
    /// text would be left out.
    pub fn svg_and_png() -> Result<Self, ReportError> {
        Ok(Self { painter: Some(PngPainter::new()?) })
    }

    /// Writes a figure, given as the text of an SVG file called `name`, and where asked for its
    /// PNG, called `name` with another extension; the files. A PNG of an earlier figure never stays
    /// beside it.
    ///
    /// # Errors
    /// [`ReportError::File`] and [`ReportError::Png`] with the path and the cause.
    pub fn write(
        &self,
        directory: &Path,
        name: &str,
        svg: &str,
    ) -> Result<Vec<PathBuf>, ReportError> {
        let file = directory.join(name);
        let png_file = file.with_extension("png");
        file_io::remove(&png_file)?;
        file_io::replace(&file, |writer| writer.write_all(svg.as_bytes()))?;
        let Some(painter) = &self.painter else { return Ok(vec![file]) };
        let failed = |problem| ReportError::Png { path: png_file.clone(), problem };
        let png = painter.paint(svg).map_err(failed)?;
        file_io::replace(&png_file, |writer| writer.write_all(&png))?;
        Ok(vec![file, png_file])
    }
}
