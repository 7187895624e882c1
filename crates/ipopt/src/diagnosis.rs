//! What a process can solve with, found out by solving.

use crate::libraries::{Versions, versions};
use crate::{
    Control, Dimensions, EvaluationError, Factorization, LinearSolver, LinearSolverError,
    NlpSolution, OptionValue, Options, Problem, SolveError, Start, Status, TripletStructure, solve,
    solve_with,
};
use righting_ipopt_sys::hsl::ma57_slot;
use std::fmt;

/// What this process can solve with.
#[derive(Debug)]
pub struct Diagnosis {
    /// The versions in use; that of Ipopt as its log has it.
    pub versions: Versions,
    /// A solve with MUMPS.
    pub mumps: Mumps,
    /// How Ipopt is given a linear solver of one's own; why not otherwise.
    pub slot: Result<LinearSolverSlot, SolveError>,
}

/// How MUMPS did.
#[derive(Debug)]
pub struct Mumps {
    /// Whether it solved.
    pub works: bool,
    /// Its version, where Ipopt's log has it (3.14).
    pub version: Option<String>,
}

/// How Ipopt is given a linear solver of one's own ([`solve_with`](crate::solve_with)).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinearSolverSlot {
    /// By the hooks of its HSL loader (to 3.13).
    HslLoader,
    /// By a library in memory that its option `hsllib` names (from 3.14).
    HslLibrary,
}

impl fmt::Display for LinearSolverSlot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::HslLoader => "MA57 by LSL_setMA57",
            Self::HslLibrary => "MA57 by hsllib (memfd)",
        })
    }
}

/// Finds out what this process can solve with, by solving a problem of one variable with MUMPS and
/// with a linear solver of its own.
///
/// # Errors
/// [`SolveError::NotLoaded`] when there is no Ipopt.
pub fn diagnose() -> Result<Diagnosis, SolveError> {
    righting_ipopt_sys::api()?;
    let (solution, log) = with_log(|options| solve(&mut Parabola, options, &start(), go_on));
    let mumps = Mumps {
        works: solution.is_ok_and(|solution| solution.status == Status::Solved),
        version: log.as_deref().and_then(mumps_version),
    };
    let mut versions = versions();
    if let Some(version) = log.as_deref().and_then(ipopt_version) {
        versions.ipopt = version;
    }
    Ok(Diagnosis { versions, mumps, slot: try_slot() })
}

fn start() -> Start {
    Start::at(vec![1.0])
}

fn go_on(_: &crate::Iteration) -> Control {
    Control::Continue
}

/// Solves with a [`Scalar`]; the slot, if that was called.
fn try_slot() -> Result<LinearSolverSlot, SolveError> {
    let mut scalar = Scalar::default();
    solve_with(&mut Parabola, &Options::default(), &start(), &mut scalar, go_on)?;
    let by_name = ma57_slot().is_ok_and(|slot| slot.hsllib.is_some());
    match scalar.factorizations {
        0 => Err(SolveError::SlotNotCalled),
        _ if by_name => Ok(LinearSolverSlot::HslLibrary),
        _ => Ok(LinearSolverSlot::HslLoader),
    }
}

/// Solves with options that make Ipopt write a log, and reads it where that is possible.
#[cfg(target_os = "linux")]
fn with_log<T>(
    run: impl FnOnce(&Options) -> Result<NlpSolution, T>,
) -> (Result<NlpSolution, T>, Option<String>) {
    use std::fs::File;
    use std::io::Read;
    use std::os::fd::AsRawFd;

    // A file in memory, so that no disk is needed.
    let file = rustix::fs::memfd_create("ipopt.log", rustix::fs::MemfdFlags::CLOEXEC);
    let Ok(mut file) = file.map(File::from) else { return (run(&Options::default()), None) };
    let name = format!("/proc/self/fd/{}", file.as_raw_fd());
    let extra = vec![
        ("output_file".to_owned(), OptionValue::Text(name)),
        ("file_print_level".to_owned(), OptionValue::Integer(5)),
    ];
    let solution = run(&Options { extra, ..Options::default() });
    let mut log = String::new();
    let read = file.read_to_string(&mut log);
    (solution, read.is_ok().then_some(log))
}

#[cfg(not(target_os = "linux"))]
fn with_log<T>(
    run: impl FnOnce(&Options) -> Result<NlpSolution, T>,
) -> (Result<NlpSolution, T>, Option<String>) {
    (run(&Options::default()), None)
}

/// `3.14.17` in "This is Ipopt version 3.14.17, running with linear solver MUMPS 5.7.1."
fn ipopt_version(log: &str) -> Option<String> {
    version_after(log, "Ipopt version ")
}

/// `5.7.1` in the same.
fn mumps_version(log: &str) -> Option<String> {
    version_after(log, "linear solver MUMPS ")
}

fn version_after(log: &str, words: &str) -> Option<String> {
    let (_, rest) = log.split_once(words)?;
    let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '.').unwrap_or(rest.len());
    let version = rest[..end].trim_end_matches('.');
    version.starts_with(|c: char| c.is_ascii_digit()).then(|| version.to_owned())
}

/// The solver of one equation in one unknown.
#[derive(Default)]
struct Scalar {
    value: f64,
    factorizations: usize,
}

impl LinearSolver for Scalar {
    fn analyse(&mut self, order: usize, _: &[i32], _: &[i32]) -> Result<(), LinearSolverError> {
        if order == 1 {
            return Ok(());
        }
        Err(LinearSolverError::new(format!("found {order} unknowns, expected 1")))
    }

    fn factor(&mut self, values: &[f64]) -> Factorization {
        self.factorizations += 1;
        self.value = values.iter().sum();
        match self.value {
            0.0 => Factorization::Singular,
            value => Factorization::Regular {
                negative_eigenvalues: usize::from(value.is_sign_negative()),
            },
        }
    }

    fn solve(&mut self, right_hand_sides: &mut [f64]) {
        right_hand_sides.iter_mut().for_each(|side| *side /= self.value);
    }
}

/// min x², the least that a linear solver is needed for.
struct Parabola;

impl Problem for Parabola {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: 1, constraints: 0 }
    }

    fn hessian_structure(&self) -> TripletStructure {
        TripletStructure { rows: vec![0], columns: vec![0] }
    }

    fn objective(&mut self, x: &[f64], _: bool) -> Result<f64, EvaluationError> {
        Ok(x[0] * x[0])
    }

    fn gradient(&mut self, x: &[f64], _: bool, out: &mut [f64]) -> Result<(), EvaluationError> {
        out[0] = 2.0 * x[0];
        Ok(())
    }

    fn hessian(
        &mut self,
        _: &[f64],
        _: bool,
        objective_factor: f64,
        _: &[f64],
        _: bool,
        values: &mut [f64],
    ) -> Result<(), EvaluationError> {
        values[0] = 2.0 * objective_factor;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_read_from_the_log() {
        let new = "\nThis is Ipopt version 3.14.17, running with linear solver MUMPS 5.7.1.\n\n";
        assert_eq!(ipopt_version(new).as_deref(), Some("3.14.17"));
        assert_eq!(mumps_version(new).as_deref(), Some("5.7.1"));
        let old = "\nThis is Ipopt version 3.11.9, running with linear solver mumps.\n\n";
        assert_eq!(ipopt_version(old).as_deref(), Some("3.11.9"));
        assert_eq!(mumps_version(old), None);
        assert_eq!(ipopt_version(""), None);
    }

    #[test]
    fn this_machine_solves_with_mumps_and_with_the_slot() {
        let Diagnosis { versions, mumps, slot } = diagnose().expect("Ipopt is installed");
        assert_eq!(versions.ipopt, righting_ipopt_sys::VERSION);
        assert!(mumps.works);
        let expected = match righting_ipopt_sys::HAS_HSL_LOADER {
            true => LinearSolverSlot::HslLoader,
            false => LinearSolverSlot::HslLibrary,
        };
        assert_eq!(slot.expect("Ipopt calls it"), expected);
        // As Debian links them.
        if cfg!(target_os = "linux") {
            for name in ["Ipopt", "MUMPS", "BLAS", "LAPACK"] {
                let found = versions.libraries.iter().find(|library| library.name == name);
                assert!(found.is_some_and(|found| found.path.exists()), "{name}: {versions:?}");
            }
        }
    }
}
