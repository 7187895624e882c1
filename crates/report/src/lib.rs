//! Figures, pages and summaries of solved maneuvers.
//!
//! Everything here reads results, a [`Solution`](righting_maneuver::Solution) with its
//! [`Trajectory`](righting_maneuver::Trajectory), and computes none: what a figure shows is what the
//! files hold.
//!
//! ```no_run
//! use std::path::Path;
//!
//! let folder = Path::new("out/demo");
//! let plan = righting_maneuver::verify_directory(folder)?;
//! let figure = righting_report::attitude_svg(&plan.solution, &plan.trajectory);
//! righting_report::write_whole(folder, "attitude.svg", figure.as_bytes())?;
//! print!("{}", righting_report::verification_summary(&plan.solution));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Figures are written as SVG by a small writer of their own rather than through a plotting crate:
//! measured on the joints of a 7-joint arm (21 panels of 600 steps), plotters' SVG backend rounds
//! every point to a whole pixel and spends an element on every dash, 710 kB in 6 300 elements
//! against 270 kB in 550 here.
#![forbid(unsafe_code)]

mod asked;
mod attitude;
mod axis;
mod chart;
mod envelope;
mod error;
mod errors;
mod figure;
mod files;
mod joints;
mod number;
mod numbers;
mod page;
mod panel;
mod power;
mod reach;
mod reach_summary;
mod slew_limits;
mod slews;
pub mod style;
mod summary;
mod svg;
mod table;

pub use attitude::attitude_svg;
pub use envelope::{EnvelopeOutlines, envelope_svg};
pub use error::ReportError;
pub use errors::errors_svg;
pub use files::write_whole;
pub use joints::joints_svg;
pub use number::short;
pub use page::report_html;
pub use power::{PowerComparison, power_svg, power_table};
pub use reach::reach_svg;
pub use reach_summary::reach_summary;
pub use slew_limits::slew_limits_svg;
pub use slews::slews_svg;
pub use summary::{status_phrase, summary, verification_summary};
