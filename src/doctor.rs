//! `righting doctor`: whether this machine can solve, and with what.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use righting_ipopt::versions;
use righting_ocp::{
    ComponentBounds, Control, ControlProblem, Grid, InitialGuess, LinearSolverChoice,
    MultipleShooting, OcpError, OcpStart, Optimizer, Settings, StageFunctions,
};
use righting_symbolic::{InstructionSet, LANES};
use serde::Serialize;

use crate::failure::Failure;
use crate::{build, output};

/// Check that this machine can solve, and say with what.
#[derive(Args)]
pub struct Arguments {
    /// Print one JSON object.
    #[arg(long)]
    pub json: bool,
}

/// What was found.
#[derive(Serialize)]
struct Diagnosis {
    ok: bool,
    /// What to do about whatever is not well.
    problems: Vec<String>,
    righting: &'static str,
    rustc: &'static str,
    target: &'static str,
    ipopt: String,
    mumps: Option<String>,
    /// How Ipopt is given the stage solver.
    slot: String,
    /// Whether Ipopt called the stage solver when it solved with it.
    stage_solver_called: bool,
    libraries: Vec<LoadedLibrary>,
    linear_solvers: Vec<&'static str>,
    instruction_set: String,
    instruction_sets_available: Vec<String>,
    stages_per_batch: usize,
    cores: usize,
}

/// A shared library in use.
#[derive(Serialize)]
struct LoadedLibrary {
    name: &'static str,
    version: Option<String>,
    path: PathBuf,
}

/// Prints the diagnosis.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let diagnosis = diagnose();
    if arguments.json {
        output::print_json(&diagnosis)?;
    } else {
        output::print(&describe(&diagnosis))?;
    }
    match diagnosis.problems.into_iter().next() {
        None => Ok(()),
        Some(problem) => Err(Failure::NotReady { problem }),
    }
}

fn diagnose() -> Diagnosis {
    let mut problems = Vec::new();
    let mut linear_solvers = Vec::new();
    let mut slot = "none".to_owned();
    let (mut found, mut mumps) = (versions(), None);
    let mut stage_solver_called = false;
    match righting_ipopt::diagnose() {
        Ok(diagnosis) => {
            (found, mumps) = (diagnosis.versions, diagnosis.mumps.version);
            if diagnosis.mumps.works {
                linear_solvers.push("mumps");
            } else {
                problems.push(
                    "Ipopt cannot solve with MUMPS: reinstall coinor-libipopt-dev".to_owned(),
                );
            }
            match diagnosis.slot {
                Ok(kind) => slot = kind.to_string(),
                Err(error) => problems.push(chain(&error)),
            }
            match stage_solver_calls() {
                Ok(calls) => stage_solver_called = calls > 0,
                Err(error) => problems.push(chain(&error)),
            }
            if stage_solver_called {
                linear_solvers.push("stage");
            }
        }
        Err(error) => problems.push(chain(&error)),
    }
    let mumps_file = found.libraries.iter().find(|library| library.name == "MUMPS");
    let mumps = mumps.or_else(|| mumps_file?.version.clone());
    let available = InstructionSet::ALL.into_iter().filter(|set| set.is_available());
    Diagnosis {
        ok: problems.is_empty(),
        problems,
        righting: build::VERSION,
        rustc: build::RUSTC,
        target: build::TARGET,
        ipopt: found.ipopt,
        mumps,
        slot,
        stage_solver_called,
        libraries: found
            .libraries
            .into_iter()
            .map(|library| LoadedLibrary {
                name: library.name,
                version: library.version,
                path: library.path,
            })
            .collect(),
        linear_solvers,
        instruction_set: InstructionSet::detect().to_string(),
        instruction_sets_available: available.map(|set| set.to_string()).collect(),
        stages_per_batch: LANES,
        cores: std::thread::available_parallelism().map_or(1, usize::from),
    }
}

/// How often Ipopt calls the stage solver on the way of a point from rest to rest.
fn stage_solver_calls() -> Result<usize, OcpError> {
    const STEPS: usize = 10;
    let problem = ControlProblem::new(2, 1, |x, u| vec![x[1], u[0]])
        .running_cost(|_, u, _| u[0] * u[0])
        .terminal_constraints(ComponentBounds::new(vec![1.0, 0.0], vec![1.0, 0.0]), |x| x.to_vec());
    let functions = StageFunctions::compile(&problem)?;
    let mut program = MultipleShooting::new(&functions, Grid::new(1.0, STEPS)?, &[0.0, 0.0])?;
    let settings = Settings {
        optimizer: Optimizer::Ipopt,
        linear_solver: LinearSolverChoice::Stage,
        ..Settings::default()
    };
    let start = OcpStart::Guess(InitialGuess::constant(&[0.0, 0.0], 1, STEPS));
    let solution = program.solve(&start, &settings, |_| Control::Continue)?;
    Ok(solution.timing.linear_solver.map_or(0, |timing| timing.factor.calls))
}

/// An error and what is behind it.
fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut source = error.source();
    while let Some(error) = source {
        write!(text, ": {error}").expect("a string takes all that is written to it");
        source = error.source();
    }
    text
}

fn describe(diagnosis: &Diagnosis) -> String {
    let mut text = String::new();
    let mut row = |name: &str, value: &str| {
        writeln!(text, "{name:<15} {value}").expect("a string takes all that is written to it");
    };
    row("righting", diagnosis.righting);
    row("built with", &format!("rustc {} for {}", diagnosis.rustc, diagnosis.target));
    if diagnosis.libraries.is_empty() {
        row("Ipopt", &diagnosis.ipopt);
    }
    for library in &diagnosis.libraries {
        // Their files carry the version of the interface only, or half of theirs.
        let version = match library.name {
            "Ipopt" => &diagnosis.ipopt,
            "MUMPS" => diagnosis.mumps.as_deref().unwrap_or(""),
            _ => library.version.as_deref().unwrap_or(""),
        };
        row(library.name, &format!("{version:<10} {}", library.path.display()));
    }
    let called = if diagnosis.stage_solver_called { ", calls the stage solver" } else { "" };
    row("slot", &format!("{}{called}", diagnosis.slot));
    let solvers = diagnosis.linear_solvers.join(", ");
    row("linear solvers", if solvers.is_empty() { "none" } else { &solvers });
    row(
        "instructions",
        &format!(
            "{} (of {}), {} stages at once",
            diagnosis.instruction_set,
            diagnosis.instruction_sets_available.join(", "),
            diagnosis.stages_per_batch
        ),
    );
    row("cores", &diagnosis.cores.to_string());
    if diagnosis.ok {
        text.push_str("\nReady to solve.\n");
    }
    text
}
