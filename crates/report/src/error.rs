//! What can go wrong in writing a report.

use std::path::PathBuf;

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file could not be written.
    #[error(transparent)]
    File(#[from] righting_scenario::Error),
    /// A figure could not be drawn as PNG.
    #[error("cannot draw {}: {problem}", path.display())]
    Png {
        /// The file it was for.
        path: PathBuf,
        /// What is in the way.
        problem: String,
    },
    /// PNGs are asked of a build that does not draw them.
    #[error("this build draws no PNG")]
    NoPng,
    /// PNGs are asked of a machine that has nothing to draw text with.
    #[error("cannot draw PNG: this machine has no fonts")]
    NoFonts,
}
