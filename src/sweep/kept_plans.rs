//! The plans that a sweep kept, each with its page.

use righting_report::report_html;
use righting_sweep::{Slews, SweepFolder};

use crate::failure::Failure;
use crate::output_folder::{OutputFolder, REPORT_FILE};
use crate::plan_folder;

/// Writes the pages of kept plans that have none yet.
pub fn write_pages(folder: &SweepFolder) -> Result<(), Failure> {
    let Ok(entries) = std::fs::read_dir(folder.plans()) else { return Ok(()) };
    for plan in entries.flatten().map(|entry| entry.path()) {
        if plan.join(righting_results::SOLUTION_FILE).exists() && !plan.join(REPORT_FILE).exists() {
            let read = plan_folder::read(&plan)?;
            let page = report_html(&read.scenario, &read.solution, &read.trajectory);
            OutputFolder::open(&plan)?.write(REPORT_FILE, page.as_bytes())?;
        }
    }
    Ok(())
}

/// Says of each slew where the page of its plan is, if there is one.
pub fn link_pages(slews: &mut Slews, folder: &SweepFolder) {
    let plans = folder.plans();
    for point in &mut slews.points {
        let page = plans.join(point.case_id.to_string()).join(REPORT_FILE);
        let relative = page.strip_prefix(folder.path()).ok().filter(|_| page.exists());
        point.plan_page = relative.map(|page| page.display().to_string());
    }
}
