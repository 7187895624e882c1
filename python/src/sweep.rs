//! Sweeps: planned, run by worker processes, and read as columns.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use righting_scenario::json::FileKind;
use righting_sweep::{
    ColumnCells, Shard, ShardRun, Slews, Summary, SweepFolder, Table, Workers, worker,
};

use crate::argument::count;
use crate::failure::{Failure, Outcome};
use crate::input::{Input, named};
use crate::interruptible::interruptible;
use crate::json::to_python;

/// Checks a sweep and writes its plan to a folder; the number of its cases. Records that the folder has are gone on
/// from if `resume` says so, and refused otherwise.
#[pyfunction]
pub fn plan_sweep(
    source: &Bound<'_, PyAny>,
    out: PathBuf,
    resume: bool,
    folder: Option<PathBuf>,
) -> PyResult<usize> {
    let read = match Input::of(source)? {
        Input::File(file) => righting_sweep::Sweep::read(&file),
        Input::Text(text) => {
            righting_sweep::Sweep::parse(&text, &named(folder.as_deref(), "sweep"))
        }
    };
    let sweep = read.map_err(Failure::of_input(FileKind::Sweep))?;
    let folder = SweepFolder::at(&out);
    folder.begin(&sweep, env!("CARGO_PKG_VERSION"), resume).map_err(Failure::from)?;
    Ok(sweep.len())
}

/// Has what is missing of a shard of a planned sweep done by worker processes, which `command` starts; how many cases
/// were recorded. `keep_plans` keeps the plans of successful cases in the folder's `plans`. `on_record` is called after
/// each case with whether it succeeded, how many are done and how many there were to do.
#[pyfunction]
pub fn run_shard(
    py: Python<'_>,
    out: PathBuf,
    shard: &str,
    jobs: Option<usize>,
    keep_plans: bool,
    command: Vec<String>,
    on_record: Option<Py<PyAny>>,
) -> PyResult<usize> {
    let shard: Shard = shard.parse().map_err(|_| Failure::Argument {
        name: "shard",
        found: format!("{shard:?}"),
        expected: "i/n with i from 1 to n",
    })?;
    let jobs = jobs.map(|jobs| count("jobs", jobs)).transpose()?;
    let folder = SweepFolder::at(&out);
    let ran = py.detach(|| {
        let sweep = folder.sweep()?;
        let run = ShardRun::open(&folder, &sweep, shard)?;
        let run = if keep_plans { run.keeping_plans(folder.plans()) } else { run };
        watched(run, jobs, &command, on_record.as_ref())
    });
    Ok(ran?)
}

/// Runs a shard, while this thread looks for Ctrl-C and shows what is done.
fn watched(
    run: ShardRun<'_>,
    jobs: Option<NonZeroUsize>,
    command: &[String],
    on_record: Option<&Py<PyAny>>,
) -> Outcome<usize> {
    let left = run.left();
    let mut recorded = 0;
    let work = |halted: &AtomicBool, records: Sender<bool>| {
        let workers = Workers {
            command: &|| {
                let mut started = Command::new(&command[0]);
                started.args(&command[1..]);
                started
            },
            jobs,
            halted: &|| halted.load(Ordering::Relaxed),
        };
        run.run(&workers, |record| {
            // The receiver outlives the run.
            let _ = records.send(record.outcome.succeeded());
        })
    };
    let ran = interruptible(work, |py, succeeded| {
        recorded += 1;
        match on_record {
            Some(on_record) => on_record.call1(py, (succeeded, recorded, left)).map(drop),
            None => Ok(()),
        }
    })?;
    Ok(ran?)
}

/// Evaluates the cases that a parent process sends, until its input ends.
#[pyfunction]
pub fn serve_sweep(py: Python<'_>) -> PyResult<()> {
    righting_ipopt::use_one_blas_thread().map_err(Failure::from)?;
    Ok(py.detach(worker::serve)?)
}

/// All results of a sweep that there are, in the order of its plan.
#[pyclass(frozen, module = "righting")]
pub struct SweepTable(Table);

#[pymethods]
impl SweepTable {
    /// Joins all records of a folder.
    #[new]
    fn new(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        let read = py.detach(|| Table::read(&SweepFolder::at(&folder)));
        Ok(Self(read.map_err(Failure::from)?))
    }

    /// Number of cases planned.
    #[getter]
    fn cases(&self) -> usize {
        self.0.rows().len()
    }

    /// One entry a column of `results.csv`: an array, or a list of texts.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        for column in self.0.columns() {
            let name = column.name;
            match column.cells {
                ColumnCells::Text(cells) => columns.set_item(name, cells)?,
                ColumnCells::Number(cells) => {
                    columns.set_item(name, PyArray1::from_vec(py, cells))?;
                }
                ColumnCells::Whole(cells) => {
                    columns.set_item(name, PyArray1::from_vec(py, cells))?;
                }
                ColumnCells::Flag(cells) => {
                    columns.set_item(name, PyArray1::from_vec(py, cells))?;
                }
            }
        }
        Ok(columns)
    }

    /// What the sweep came to, as `summary.json` holds it.
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let slews = Slews::of(&self.0, Slews::MOST_POINTS);
        to_python(py, &Summary::of(&self.0, slews.as_ref()))
    }

    /// The page of a sweep over slew axes and angles, an HTML document; None of any other.
    fn page(&self) -> Option<String> {
        let slews = Slews::of(&self.0, Slews::MOST_POINTS)?;
        slews.has_axes().then(|| righting_report::slews_html(self.0.sweep().name(), &slews))
    }
}
