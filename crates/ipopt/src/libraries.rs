//! What a process solves with, as far as that can be told without solving.

use righting_ipopt_sys as sys;
use std::ffi::c_int;
use std::path::{Path, PathBuf};

/// What this process solves with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Versions {
    /// The version of Ipopt. Until something is solved, that which this program was built for; the
    /// name of the library's file where the library in use is another one and does not say.
    pub ipopt: String,
    /// Ipopt, MUMPS, MPI, BLAS and LAPACK as the process has loaded them: none before the first
    /// solve, and none where the system does not say (only Linux does).
    pub libraries: Vec<LoadedLibrary>,
}

/// A shared library that the process has loaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LoadedLibrary {
    /// What it is: Ipopt, MUMPS, MPI, BLAS or LAPACK.
    pub name: &'static str,
    /// The file, links resolved. Its directory tells one BLAS from another on Debian.
    pub path: PathBuf,
    /// The version in its file name: of MUMPS and OpenBLAS their own, else of the interface.
    pub version: Option<String>,
}

/// What this process solves with, without solving anything or loading what is not loaded yet.
pub fn versions() -> Versions {
    let libraries = loaded_libraries();
    Versions { ipopt: ipopt_version(&libraries), libraries }
}

fn ipopt_version(libraries: &[LoadedLibrary]) -> String {
    if let Some(get) = sys::api_in_use().and_then(|ipopt| ipopt.GetIpoptVersion) {
        let (mut major, mut minor, mut release): (c_int, c_int, c_int) = (0, 0, 0);
        // SAFETY: it writes one number to each.
        unsafe { get(&raw mut major, &raw mut minor, &raw mut release) };
        return format!("{major}.{minor}.{release}");
    }
    // On Debian, one version has one file.
    let ipopt = libraries.iter().find(|library| library.name == "Ipopt");
    let file = ipopt.and_then(|library| library.path.file_name()).and_then(|file| file.to_str());
    match (file, sys::LIBRARY_FILE) {
        (Some(used), Some(built_for)) if used != built_for => used.to_owned(),
        _ => sys::VERSION.to_owned(),
    }
}

const PREFIXES: [(&str, &str); 9] = [
    ("libipopt", "Ipopt"),
    ("libdmumps", "MUMPS"),
    ("libcoinmumps", "MUMPS"),
    ("libmpi.", "MPI"),
    ("liblapack", "LAPACK"),
    ("libblas", "BLAS"),
    ("libopenblas", "BLAS"),
    ("libblis", "BLAS"),
    ("libmkl_rt", "BLAS"),
];

fn loaded_libraries() -> Vec<LoadedLibrary> {
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap_or_default();
    let mut libraries: Vec<LoadedLibrary> = maps
        .lines()
        .filter_map(|line| line.find('/').map(|start| Path::new(&line[start..])))
        .filter_map(library)
        .collect();
    libraries.sort_by(|a, b| a.path.cmp(&b.path));
    libraries.dedup();
    libraries
}

fn library(path: &Path) -> Option<LoadedLibrary> {
    let file = path.file_name()?.to_str()?;
    let (_, name) = PREFIXES.iter().find(|(prefix, _)| file.starts_with(prefix))?;
    Some(LoadedLibrary { name, path: path.to_owned(), version: version_in(file) })
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
    fn another_file_is_not_said_to_be_the_version_built_for() {
        let library = |file: &str| LoadedLibrary {
            name: "Ipopt",
            path: Path::new("/usr/lib").join(file),
            version: None,
        };
        assert_eq!(ipopt_version(&[]), sys::VERSION);
        if let Some(file) = sys::LIBRARY_FILE {
            assert_eq!(ipopt_version(&[library(file)]), sys::VERSION);
            assert_eq!(ipopt_version(&[library("libipopt.so.9")]), "libipopt.so.9");
        }
    }
}
