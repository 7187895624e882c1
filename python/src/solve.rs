use std::path::PathBuf;
use std::time::Instant;

use pyo3::prelude::*;
use righting_planner::{PlanLibrary, Planned, Planner};
use righting_results::{TRAJECTORY_FILE, Trajectory};
use righting_scenario::json::FileKind;

use crate::argument::{count, seconds};
use crate::failure::{Failure, Outcome};
use crate::plan::Plan;
use crate::scenario::Scenario;
use crate::turn::alone;
use crate::watch::Watch;

/// Plans a maneuver and verifies the plan: see `righting.solve`, which adds the progress.
#[pyfunction]
#[pyo3(signature = (scenario, *, warm_start=None, library=None, time_limit_s=None, threads=None, on_iteration=None))]
pub fn solve(
    py: Python<'_>,
    scenario: &Bound<'_, PyAny>,
    warm_start: Option<&Bound<'_, PyAny>>,
    library: Option<PathBuf>,
    time_limit_s: Option<f64>,
    threads: Option<usize>,
    on_iteration: Option<Py<PyAny>>,
) -> PyResult<Plan> {
    let started = Instant::now();
    let scenario = Scenario::of(scenario)?;
    let earlier = warm_start.map(earlier).transpose()?;
    if let (Some(_), Some(library)) = (&earlier, &library) {
        let found = format!("{:?} beside a warm start", library.display());
        let expected = "one of warm_start and library";
        return Err(Failure::Argument { name: "library", found, expected }.into());
    }
    let mut library = library
        .map(|folder| PlanLibrary::read(&folder))
        .transpose()
        .map_err(Failure::of_input(FileKind::Solution))?;
    let limit = time_limit_s.map(|limit| seconds("time_limit_s", limit)).transpose()?;
    let threads = threads.map(|threads| count("threads", threads)).transpose()?;
    let load = started.elapsed();
    let mut watch = Watch::new(on_iteration);
    let planned = alone(py, || {
        let mut planner = Planner::new().program(env!("CARGO_PKG_VERSION"));
        if let Some(earlier) = &earlier {
            planner = planner.warm_start(earlier);
        }
        if let Some(library) = &mut library {
            planner = planner.library(library);
        }
        if let Some(limit) = limit {
            planner = planner.time_limit(limit);
        }
        if let Some(threads) = threads {
            planner = planner.threads(threads);
        }
        planner.plan(&scenario, &mut |record| watch.see(record))
    })?;
    watch.end()?;
    let Planned { mut solution, trajectory } = planned.map_err(Failure::from)?;
    solution.timing_s.load = load.as_secs_f64();
    solution.timing_s.total = started.elapsed().as_secs_f64();
    Ok(Plan::new(scenario, solution, trajectory))
}

/// The motion of an earlier plan: of a `Plan`, or of one in a folder.
fn earlier(plan: &Bound<'_, PyAny>) -> Outcome<Trajectory> {
    if let Ok(plan) = plan.cast::<Plan>() {
        return Ok(plan.get().trajectory.clone());
    }
    let folder: PathBuf = plan.extract()?;
    let read = Trajectory::read_csv(&folder.join(TRAJECTORY_FILE));
    read.map_err(Failure::of_input(FileKind::Solution))
}
