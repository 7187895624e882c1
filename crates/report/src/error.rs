//! What can go wrong in writing a report.

use std::path::PathBuf;

use righting_scenario::error::Mismatch;

/// Why a report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file could not be written.
    #[error(transparent)]
    File(#[from] righting_scenario::Error),
    /// A value is not one that the format of an export takes.
    #[error("{keyword}: {mismatch}")]
    Value {
        /// The keyword it is for.
        keyword: &'static str,
        /// The value, and what the format takes.
        mismatch: Mismatch,
    },
    /// The time tags of an attitude ephemeris would not increase or leave the calendar.
    #[error(
        "time tags: {}",
        Mismatch::new(
            format_args!("a step of {step_s} s from {epoch}"),
            "at least 1e-9 s, up to the year 9999"
        )
    )]
    TimeTags {
        /// The step of the trajectory, s.
        step_s: f64,
        /// Its first time.
        epoch: String,
    },
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
    /// An archive could not be made.
    #[error("cannot make the archive: {0}")]
    Archive(#[from] zip::result::ZipError),
}
