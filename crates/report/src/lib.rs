//! Figures, pages and summaries of solved maneuvers.
//!
//! Everything here reads results, a [`Solution`](righting_results::Solution) with its
//! [`Trajectory`](righting_results::Trajectory), and computes none: what a figure shows is what the
//! files hold.
//!
//! ```no_run
//! use std::path::Path;
//!
//! let folder = Path::new("out/demo");
//! let plan = righting_verifier::verify_directory(folder)?;
//! let figure = righting_report::attitude_svg(&plan.solution, &plan.trajectory);
//! righting_report::FigureWriter::svg().write(folder, "attitude.svg", &figure)?;
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
mod body_view;
mod chart;
mod clearances;
mod compared_numbers;
mod comparison;
mod convergence;
mod envelope;
mod error;
mod facts;
mod figure;
mod figure_writer;
mod flights;
mod heading;
mod joints;
mod loads;
mod maneuvers;
mod momentum;
mod number;
mod open_loop_errors;
mod page;
mod panel;
#[cfg_attr(not(feature = "png"), path = "no_png.rs")]
mod png;
mod pointing;
mod power;
mod power_trade;
mod reach;
mod reach_summary;
mod shares;
mod slew_limits;
mod slews;
mod sparsity;
pub mod style;
mod summary;
mod svg;
mod table;
mod turn_rates;
mod wheels;

pub use asked::{phrase as asked_phrase, planned_phrase as maneuver_phrase};
pub use attitude::attitude_svg;
pub use clearances::clearances_svg;
pub use compared_numbers::{ComparedMargin, ComparedNumbers};
pub use comparison::{ComparedPlan, comparison_table};
pub use convergence::convergence_svg;
pub use envelope::{EnvelopeOutlines, envelope_svg};
pub use error::ReportError;
pub use figure_writer::FigureWriter;
pub use flights::{FlightsFigure, flights_svg, flights_table};
pub use joints::joints_svg;
pub use loads::loads_svg;
pub use maneuvers::maneuvers_svg;
pub use momentum::momentum_svg;
pub use number::short;
pub use open_loop_errors::open_loop_errors_svg;
pub use page::{compare_html, report_html, slews_html};
pub use pointing::pointing_svg;
pub use power::{PowerComparison, power_svg, power_table};
pub use power_trade::{PowerTrade, power_trade_svg};
pub use reach::reach_svg;
pub use reach_summary::reach_summary;
pub use slew_limits::slew_limits_svg;
pub use slews::slews_svg;
pub use sparsity::sparsity_svg;
pub use summary::{status_phrase, summary, verification_summary};
pub use turn_rates::turn_rates_svg;
pub use wheels::wheels_svg;
