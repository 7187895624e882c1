//! `righting sweep merge`: all records as one table.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;
use righting_report::{open_loop_errors_svg, slew_limits_svg, slews_html, slews_svg};
use righting_scenario::file_io;
use righting_sweep::{CaseStatus, Slews, Summary, SweepFolder, Table};

use super::{kept_plans, show};
use crate::failure::Failure;

/// Join the records of all shards in one table.
#[derive(Args)]
pub struct Arguments {
    /// The folder of the plan.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Print the summary as one JSON object.
    #[arg(long)]
    pub json: bool,
}

/// Merges.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    merge(&super::planned(&arguments.folder)?, arguments.json)
}

/// Writes the results of the records that there are, and prints their summary.
pub fn merge(folder: &SweepFolder, json: bool) -> Result<(), Failure> {
    let table = Table::read(folder)?;
    kept_plans::write_pages(folder)?;
    let mut slews = Slews::of(&table, Slews::MOST_POINTS);
    if let Some(slews) = &mut slews {
        kept_plans::link_pages(slews, folder);
    }
    let summary = Summary::of(&table, slews.as_ref());
    let mut files: Vec<PathBuf> = Vec::new();
    let mut write = |name: &str, print: &dyn Fn(&mut (dyn Write + Send)) -> io::Result<()>| {
        let path = folder.path().join(name);
        file_io::replace(&path, print)?;
        files.push(path);
        Ok::<(), Failure>(())
    };
    write("results.csv", &|writer| table.write_csv(writer))?;
    #[cfg(feature = "parquet")]
    write("results.parquet", &|writer| table.write_parquet(writer))?;
    write("summary.json", &|writer| {
        serde_json::to_writer_pretty(&mut *writer, &summary)?;
        writeln!(writer)
    })?;
    if let Some(slews) = &slews {
        write("slew_limits.csv", &|writer| slews.write_csv(writer))?;
        if slews.has_axes() {
            let figure = slews_svg(&summary.sweep, slews);
            write("slews.svg", &|writer| writer.write_all(figure.as_bytes()))?;
            let page = slews_html(&summary.sweep, slews);
            write("slews.html", &|writer| writer.write_all(page.as_bytes()))?;
        }
        if let Some(figure) = slew_limits_svg(&summary.sweep, slews) {
            write("slew_limits.svg", &|writer| writer.write_all(figure.as_bytes()))?;
        }
    }
    let flown = table.rows().iter().flatten();
    let flown = flown.filter(|row| matches!(row.status, CaseStatus::Flown(_)));
    // The error is the sine of half the angle.
    let errors_deg: Vec<f64> =
        flown.map(|row| 2.0 * row.attitude_error.asin().to_degrees()).collect();
    if let Some(figure) = open_loop_errors_svg(&summary.sweep, &errors_deg) {
        write("errors.svg", &|writer| writer.write_all(figure.as_bytes()))?;
    }
    show::print(&summary, &files, json)
}
