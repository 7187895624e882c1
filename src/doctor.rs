//! `righting doctor`: whether this machine can solve, and with what.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use righting_ipopt::versions;
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
    problems: Vec<&'static str>,
    righting: &'static str,
    rustc: &'static str,
    target: &'static str,
    ipopt: &'static str,
    libraries: Vec<Library>,
    linear_solvers: Vec<&'static str>,
    instruction_set: String,
    instruction_sets_available: Vec<String>,
    stages_per_batch: usize,
    cores: usize,
}

/// A shared library in use.
#[derive(Serialize)]
struct Library {
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
    match diagnosis.problems.first() {
        None => Ok(()),
        Some(problem) => Err(Failure::NotReady { problem }),
    }
}

fn diagnose() -> Diagnosis {
    let found = versions();
    let solvers = found.linear_solvers;
    let linear_solvers = [("mumps", solvers.mumps), ("stage", solvers.own)];
    let mut problems = Vec::new();
    if !solvers.mumps {
        problems.push("Ipopt cannot solve with MUMPS: reinstall coinor-libipopt-dev");
    }
    let available = InstructionSet::ALL.into_iter().filter(|set| set.is_available());
    Diagnosis {
        ok: problems.is_empty(),
        problems,
        righting: build::VERSION,
        rustc: build::RUSTC,
        target: build::TARGET,
        ipopt: found.ipopt,
        libraries: found
            .libraries
            .into_iter()
            .map(|library| Library {
                name: library.name,
                version: library.version,
                path: library.path,
            })
            .collect(),
        linear_solvers: linear_solvers
            .into_iter()
            .filter_map(|(name, works)| works.then_some(name))
            .collect(),
        instruction_set: InstructionSet::detect().to_string(),
        instruction_sets_available: available.map(|set| set.to_string()).collect(),
        stages_per_batch: LANES,
        cores: std::thread::available_parallelism().map_or(1, usize::from),
    }
}

fn describe(diagnosis: &Diagnosis) -> String {
    let mut text = String::new();
    let mut row = |name: &str, value: &str| {
        writeln!(text, "{name:<15} {value}").expect("a string takes all that is written to it");
    };
    row("righting", diagnosis.righting);
    row("built with", &format!("rustc {} for {}", diagnosis.rustc, diagnosis.target));
    if diagnosis.libraries.is_empty() {
        row("Ipopt", diagnosis.ipopt);
    }
    for library in &diagnosis.libraries {
        // The file of Ipopt carries the version of its interface only.
        let own = library.version.as_deref().unwrap_or("");
        let version = if library.name == "Ipopt" { diagnosis.ipopt } else { own };
        row(library.name, &format!("{version:<10} {}", library.path.display()));
    }
    row("linear solvers", &diagnosis.linear_solvers.join(", "));
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
