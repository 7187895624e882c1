use crate::{
    Bounds, Control, Dimensions, EvaluationError, Options, Problem, Start, Status,
    TripletStructure, solve,
};
use std::path::{Path, PathBuf};

/// What this process solves with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Versions {
    /// The version of Ipopt that this program was built against.
    pub ipopt: &'static str,
    /// Which linear solvers can be used.
    pub linear_solvers: LinearSolvers,
    /// Ipopt, MUMPS, BLAS and LAPACK as the process has loaded them. Empty where the system does
    /// not say (only Linux does).
    pub libraries: Vec<Library>,
}

/// Which linear solvers can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LinearSolvers {
    /// MUMPS, by [`solve`](crate::solve); found out by solving.
    pub mumps: bool,
    /// One's own, by [`solve_with`](crate::solve_with).
    pub own: bool,
}

/// A shared library that the process has loaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Library {
    /// What it is: Ipopt, MUMPS, BLAS or LAPACK.
    pub name: &'static str,
    /// The file, links resolved. Its directory tells one BLAS from another on Debian.
    pub path: PathBuf,
    /// The version in its file name: of MUMPS and OpenBLAS their own, else of the interface.
    pub version: Option<String>,
}

/// Finds out what this process solves with, by solving a problem of one variable.
pub fn versions() -> Versions {
    let start = Start::at(vec![1.0]);
    let solution = solve(&mut Parabola, &Options::default(), &start, |_| Control::Continue);
    Versions {
        ipopt: righting_ipopt_sys::VERSION,
        linear_solvers: LinearSolvers {
            mumps: solution.is_ok_and(|solution| solution.status == Status::Solved),
            own: righting_ipopt_sys::HAS_MA57_SLOT,
        },
        libraries: loaded_libraries(),
    }
}

const PREFIXES: [(&str, &str); 8] = [
    ("libipopt", "Ipopt"),
    ("libdmumps", "MUMPS"),
    ("libcoinmumps", "MUMPS"),
    ("liblapack", "LAPACK"),
    ("libblas", "BLAS"),
    ("libopenblas", "BLAS"),
    ("libblis", "BLAS"),
    ("libmkl_rt", "BLAS"),
];

fn loaded_libraries() -> Vec<Library> {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap_or_default();
    let mut libraries: Vec<Library> = maps
        .lines()
        .filter_map(|line| line.find('/').map(|start| Path::new(&line[start..])))
        .filter_map(library)
        .collect();
    libraries.sort_by(|a, b| a.path.cmp(&b.path));
    libraries.dedup();
    libraries
}

fn library(path: &Path) -> Option<Library> {
    let file = path.file_name()?.to_str()?;
    let (_, name) = PREFIXES.iter().find(|(prefix, _)| file.starts_with(prefix))?;
    Some(Library { name, path: path.to_owned(), version: version_in(file) })
}

/// `5.5` in `libdmumps_seq-5.5.so`, `0.3.21` in `libopenblasp-r0.3.21.so`, `3.11.0` in
/// `libblas.so.3.11.0`.
fn version_in(file: &str) -> Option<String> {
    let (stem, suffix) = file.split_once(".so")?;
    let in_stem = stem.rsplit_once('-').map(|(_, version)| version.trim_start_matches('r'));
    [in_stem, suffix.strip_prefix('.')]
        .into_iter()
        .flatten()
        .find(|version| version.starts_with(|c: char| c.is_ascii_digit()))
        .map(str::to_owned)
}

/// min x², the least that a linear solver is needed for.
struct Parabola;

impl Problem for Parabola {
    fn dimensions(&self) -> Dimensions {
        Dimensions { variables: 1, constraints: 0 }
    }

    fn bounds(&self, _: &mut Bounds) {}

    fn jacobian_structure(&self) -> TripletStructure {
        TripletStructure::default()
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

    fn constraints(&mut self, _: &[f64], _: bool, _: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }

    fn jacobian(&mut self, _: &[f64], _: bool, _: &mut [f64]) -> Result<(), EvaluationError> {
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
    fn the_version_is_read_from_the_file_name() {
        let version = |file| version_in(file).unwrap_or_default();
        assert_eq!(version("libdmumps_seq-5.5.so"), "5.5");
        assert_eq!(version("libdmumps_seq-5.5.so.1"), "5.5");
        assert_eq!(version("libopenblasp-r0.3.21.so"), "0.3.21");
        assert_eq!(version("libblas.so.3.11.0"), "3.11.0");
        assert_eq!(version("libipopt.so"), "");
    }

    #[test]
    #[cfg(all(target_os = "linux", ipopt_ma57_slot))]
    fn the_libraries_in_use_are_found() {
        let Versions { ipopt, linear_solvers, libraries } = versions();
        assert!(ipopt.starts_with("3."));
        assert!(linear_solvers.mumps);
        // As Debian links them.
        for name in ["Ipopt", "MUMPS", "BLAS", "LAPACK"] {
            let found = libraries.iter().find(|library| library.name == name);
            assert!(found.is_some_and(|library| library.path.exists()), "{name}: {libraries:?}");
        }
    }
}
