//! `righting solve`: plan a maneuver, prove it, write it down.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::Args;
use righting_planner::{Planned, Planner};
use righting_report::{FigureWriter, report_html, summary};
use righting_results::{
    IterationRecord, SOLUTION_FILE, Solution, Status, TRAJECTORY_FILE, Trajectory,
};
use righting_scenario::Scenario;
use serde::Serialize;

use crate::failure::Failure;
use crate::figures::{FigureSet, Formats, draw};
use crate::interrupt::Interrupt;
use crate::output_folder::{OutputFolder, REPORT_FILE, ResultFiles};
use crate::progress::Progress;
use crate::warm_start::WarmStart;
use crate::{build, optimizer, output, scenario_input};

/// Plan the maneuver of a scenario, verify the plan and write it to a folder.
#[derive(Args)]
pub struct Arguments {
    /// The scenario, a JSON file; - for standard input.
    scenario: PathBuf,
    /// The folder for trajectory.csv, solution.json, the figures and report.html; made if missing.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// An earlier result folder of the same arm (another angle, axis, duration, grid or mass) to
    /// start from too. From a plan of the very same problem it goes on alone.
    #[arg(long, value_name = "DIR")]
    warm_start: Option<PathBuf>,
    /// A folder of such result folders: the nearest maneuver of the same arm and type is a start
    /// too. To add this plan to it, name a folder in it with --out. Made if missing.
    #[arg(long, value_name = "DIR", conflicts_with = "warm_start")]
    library: Option<PathBuf>,
    /// Stop after so many seconds with what there is then: a plan that is verified but not optimal, or
    /// none; see also solver.time_limit_s of the scenario.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<Duration>,
    /// Do not write report.html, the interactive page (`righting report DIR` makes it later).
    #[arg(long)]
    no_report: bool,
    /// The figures to draw; `righting figures DIR` draws all of them later.
    #[arg(long, value_enum, value_name = "SET", default_value = "usual")]
    figures: FigureSet,
    #[command(flatten)]
    formats: Formats,
    /// Print the contents of solution.json and the files' paths as one JSON object.
    #[arg(long)]
    pub json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Printed<'a> {
    #[serde(flatten)]
    solution: &'a Solution,
    files: ResultFiles,
}

/// Solves, verifies, writes and prints.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let started = Instant::now();
    if arguments.figures == FigureSet::None && arguments.formats.png {
        return Err(Failure::Usage("--png and --figures none: there is no figure to write as PNG"));
    }
    let scenario = scenario_input::read(&arguments.scenario)?;
    // From here on: until then a signal may end the process while it waits for standard input.
    let interrupt = Interrupt::watch();
    let load = started.elapsed();
    let mut warm_start = match (&arguments.warm_start, &arguments.library) {
        (Some(folder), _) => WarmStart::of_plan(folder, &scenario)?,
        (None, Some(library)) => WarmStart::of_library(library)?,
        (None, None) => WarmStart::None,
    };
    let writer = arguments.formats.writer()?;
    optimizer::load()?;
    let folder = OutputFolder::open_alone(&arguments.out)?;

    let progress = Progress::start();
    let mut on_iteration = |record: &IterationRecord| {
        progress.show(record);
        interrupt.control()
    };
    let mut planner = Planner::new().program(build::VERSION);
    if let Some(limit) = arguments.time_limit {
        planner = planner.time_limit(limit);
    }
    match &mut warm_start {
        WarmStart::None => {}
        WarmStart::Plan { trajectory, .. } => planner = planner.warm_start(trajectory),
        WarmStart::Library(library) => planner = planner.library(library),
    }
    let planned = planner.plan(&scenario, &mut on_iteration);
    drop(planner);
    if planned.is_err() {
        folder.remove_earlier_plan()?;
    }
    let Planned { mut solution, trajectory } = planned?;
    warm_start.report(&mut solution);
    solution.timing_s.load = load.as_secs_f64();
    let shown = Shown { figures: arguments.figures, writer: &writer, page: !arguments.no_report };
    let files = write(&folder, shown, &scenario, &mut solution, &trajectory, started)?;
    drop(progress);

    if arguments.json {
        output::print_json(&Printed { solution: &solution, files })?;
    } else {
        output::print(&summary(&solution, &files.paths()))?;
    }
    conclude(&solution)
}

/// A positive number of seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds: &f64| *seconds > 0.0);
    let duration = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| "expected a number of seconds above 0".to_owned())
}

/// Whether that is what was asked for.
pub fn conclude(solution: &Solution) -> Result<(), Failure> {
    let (status, has_plan) = (solution.status, solution.has_plan());
    if status == Status::Interrupted {
        return Err(Failure::Interrupted { has_plan });
    }
    if !status.is_acceptable() {
        let has_notes = !solution.notes.is_empty();
        return Err(match has_plan {
            true => Failure::NotOptimal { status },
            false => Failure::NoPlan { status, has_notes },
        });
    }
    Failure::of_verification(solution).map_or(Ok(()), Err)
}

/// What is written beside a plan.
#[derive(Clone, Copy)]
pub struct Shown<'a> {
    /// The figures.
    pub figures: FigureSet,
    /// What writes them.
    pub writer: &'a FigureWriter,
    /// Whether the interactive page.
    pub page: bool,
}

/// Writes what there is: everything of a plan, or the outcome alone. `solution.json` comes after the
/// trajectory, so that where it is, the plan is whole, and before what shows the plan, so that the plan
/// stays if that fails.
pub fn write(
    folder: &OutputFolder,
    shown: Shown<'_>,
    scenario: &Scenario,
    solution: &mut Solution,
    trajectory: &Trajectory,
    started: Instant,
) -> Result<ResultFiles, Failure> {
    folder.remove_earlier_plan()?;
    let is_plan = solution.has_plan();
    if is_plan {
        let kinds = scenario.system().model.joint_kinds();
        trajectory.write_csv(&kinds, &folder.path().join(TRAJECTORY_FILE))?;
    }
    solution.timing_s.total = started.elapsed().as_secs_f64();
    solution.write_json(&folder.path().join(SOLUTION_FILE))?;
    if !is_plan {
        return Ok(ResultFiles::without_plan(folder));
    }
    show(folder, shown, scenario, solution, trajectory).map_err(|cause| Failure::NotShown {
        folder: folder.path().to_owned(),
        cause: Box::new(cause),
    })
}

/// Writes what shows a plan beside its files.
fn show(
    folder: &OutputFolder,
    shown: Shown<'_>,
    scenario: &Scenario,
    solution: &Solution,
    trajectory: &Trajectory,
) -> Result<ResultFiles, Failure> {
    let Shown { figures, writer, page } = shown;
    let figures = draw(folder.path(), figures, writer, scenario, solution, trajectory)?;
    let page = page.then(|| report_html(scenario, solution, trajectory));
    let page = page.map(|page| folder.write(REPORT_FILE, page.as_bytes())).transpose()?;
    Ok(ResultFiles::of_plan(folder, figures, page))
}
