//! Figures as files: SVG always, PNG beside it where asked for.

use std::path::{Path, PathBuf};

use crate::png::PngPainter;
use crate::{ReportError, write_whole};

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
    /// PNG, called `name` with another extension; the files.
    ///
    /// # Errors
    /// [`ReportError::Write`] and [`ReportError::Png`] with the path and the cause.
    pub fn write(
        &self,
        directory: &Path,
        name: &str,
        svg: &str,
    ) -> Result<Vec<PathBuf>, ReportError> {
        let mut files = vec![write_whole(directory, name, svg.as_bytes())?];
        if let Some(painter) = &self.painter {
            let name = Path::new(name).with_extension("png");
            let failed = |problem| ReportError::Png { path: directory.join(&name), problem };
            let png = painter.paint(svg).map_err(failed)?;
            files.push(write_whole(directory, &name.to_string_lossy(), &png)?);
        }
        Ok(files)
    }
}
