//! Finds the installed Ipopt with pkg-config; nothing is ever downloaded or built.
//!
//! Only `ipopt` itself is linked. Its .pc file on Debian also lists the C, Fortran and MUMPS
//! libraries and the directories of the compiler that built it; the shared library brings its own
//! dependencies, and those directories need not exist here.

use std::path::{Path, PathBuf};
use std::process::exit;

const OLDEST: &str = "3.11";

fn main() {
    println!("cargo:rustc-check-cfg=cfg(ipopt_bool, ipopt_ma57_slot)");
    println!("cargo:rerun-if-changed=build.rs");

    let library = pkg_config::Config::new()
        .cargo_metadata(false)
        .atleast_version(OLDEST)
        .probe("ipopt")
        .unwrap_or_else(|error| refuse(&error));

    for directory in search_directories(&library.link_paths) {
        println!("cargo:rustc-link-search=native={}", directory.display());
    }
    println!("cargo:rustc-link-lib=ipopt");

    if version_number(&library.version) >= (3, 14) {
        println!("cargo:rustc-cfg=ipopt_bool");
    } else {
        println!("cargo:rustc-cfg=ipopt_ma57_slot");
        // For the build scripts of dependents, as DEP_IPOPT_MA57_SLOT.
        println!("cargo:ma57_slot=yes");
    }
    println!("cargo:rustc-env=IPOPT_VERSION={}", library.version);
    let include = std::env::join_paths(&library.include_paths).unwrap_or_default();
    println!("cargo:rustc-env=IPOPT_INCLUDE_PATH={}", include.to_string_lossy());
}

fn refuse(error: &pkg_config::Error) -> ! {
    let reason = match error {
        pkg_config::Error::ProbeFailure { .. } => {
            format!("pkg-config knows no `ipopt` of version {OLDEST} or newer")
        }
        pkg_config::Error::Command { .. } => "pkg-config itself could not be run".to_owned(),
        other => other.to_string().lines().next().unwrap_or_default().to_owned(),
    };
    eprintln!(
        "Ipopt was not found: {reason}.\n\
         Install it with:  apt-get install coinor-libipopt-dev pkg-config\n\
         (or let PKG_CONFIG_PATH name the directory that holds ipopt.pc)"
    );
    exit(1)
}

/// The directories that really hold the library and that the linker would not search by itself.
fn search_directories(listed: &[PathBuf]) -> Vec<PathBuf> {
    let mut directories: Vec<PathBuf> = listed
        .iter()
        .filter_map(|directory| directory.canonicalize().ok())
        .filter(|directory| holds_ipopt(directory) && !is_system_directory(directory))
        .collect();
    directories.sort();
    directories.dedup();
    directories
}

fn holds_ipopt(directory: &Path) -> bool {
    ["libipopt.so", "libipopt.dylib", "libipopt.a"].iter().any(|file| directory.join(file).exists())
}

fn is_system_directory(directory: &Path) -> bool {
    let multiarch = |root: &str| {
        directory.parent() == Some(Path::new(root))
            && directory.file_name().is_some_and(|name| name.to_string_lossy().ends_with("-gnu"))
    };
    directory == Path::new("/usr/lib")
        || directory == Path::new("/lib")
        || multiarch("/usr/lib")
        || multiarch("/lib")
}

fn version_number(version: &str) -> (u32, u32) {
    let mut parts = version.split('.').map(|part| part.parse().unwrap_or(0));
    (parts.next().unwrap_or(0), parts.next().unwrap_or(0))
}
