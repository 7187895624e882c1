//! Finds the installed Ipopt with pkg-config; nothing is ever downloaded, and no part of Ipopt built.
//!
//! With the feature `dlopen` the name of its shared library is noted, to be opened when it is first
//! needed. Without, it is linked: `ipopt` alone. Its .pc file on Debian also lists the C, Fortran
//! and MUMPS libraries and the directories of the compiler that built it; the shared library brings
//! its own dependencies, and those directories need not exist here.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::exit;

use elf::ElfBytes;
use elf::abi::{DT_NEEDED, DT_SONAME};
use elf::endian::AnyEndian;

const OLDEST: &str = "3.11";

fn main() {
    println!("cargo:rustc-check-cfg=cfg(ipopt_bool, ipopt_hsl_loader, ipopt_mpi)");
    println!("cargo:rerun-if-changed=build.rs");

    let found = pkg_config::Config::new()
        .cargo_metadata(false)
        .atleast_version(OLDEST)
        .probe("ipopt")
        .unwrap_or_else(|error| refuse(&reason(&error)));
    let directories = directories(&found.link_paths);

    if env::var_os("CARGO_FEATURE_DLOPEN").is_some() {
        note_library(&directories);
    } else {
        for directory in directories.iter().filter(|directory| !is_system_directory(directory)) {
            println!("cargo:rustc-link-search=native={}", directory.display());
        }
        println!("cargo:rustc-link-lib=ipopt");
    }

    if version_number(&found.version) >= (3, 14) {
        println!("cargo:rustc-cfg=ipopt_bool");
        if env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "linux") {
            build_ma57_library();
        }
    } else {
        println!("cargo:rustc-cfg=ipopt_hsl_loader");
    }
    println!("cargo:rustc-env=IPOPT_VERSION={}", found.version);
    let include = env::join_paths(&found.include_paths).unwrap_or_default();
    println!("cargo:rustc-env=IPOPT_INCLUDE_PATH={}", include.to_string_lossy());
}

fn reason(error: &pkg_config::Error) -> String {
    match error {
        pkg_config::Error::ProbeFailure { .. } => {
            format!("pkg-config knows no `ipopt` of version {OLDEST} or newer")
        }
        pkg_config::Error::Command { .. } => "pkg-config itself could not be run".to_owned(),
        other => other.to_string().lines().next().unwrap_or_default().to_owned(),
    }
}

fn refuse(reason: &str) -> ! {
    eprintln!(
        "Ipopt was not found: {reason}.\n\
         Install it with:  apt-get install coinor-libipopt-dev pkg-config\n\
         (or let PKG_CONFIG_PATH name the directory that holds ipopt.pc)"
    );
    exit(1)
}

/// The directories that hold the library, the one that ipopt.pc calls its own first.
fn directories(listed: &[PathBuf]) -> Vec<PathBuf> {
    let own = pkg_config::get_variable("ipopt", "libdir").ok().map(PathBuf::from);
    let mut directories: Vec<PathBuf> = Vec::new();
    for directory in own.iter().chain(listed) {
        let Ok(directory) = directory.canonicalize() else { continue };
        if holds_ipopt(&directory) && !directories.contains(&directory) {
            directories.push(directory);
        }
    }
    directories
}

const SHARED: [&str; 2] = ["libipopt.so", "libipopt.dylib"];

fn holds_ipopt(directory: &Path) -> bool {
    SHARED.iter().chain(&["libipopt.a"]).any(|file| directory.join(file).exists())
}

/// Tells the crate what to open: the name that programs linked to the library would ask for, the
/// file that has it now, and its directory unless every program finds that by itself.
fn note_library(directories: &[PathBuf]) {
    let shared = directories
        .iter()
        .flat_map(|directory| SHARED.iter().map(|file| directory.join(file)))
        .find(|path| path.exists());
    let Some(link) = shared else {
        refuse(&format!("its shared library is in none of {directories:?}"));
    };
    println!("cargo:rerun-if-changed={}", link.display());
    let directory = link.parent().unwrap_or(Path::new("")).to_owned();
    let file = link.canonicalize().unwrap_or_else(|_| link.clone());
    let file_name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let entries = entries(&file).unwrap_or_default();
    let of = |tag| entries.iter().filter(move |entry| entry.0 == tag).map(|entry| &entry.1);
    let name = of(DT_SONAME).next().unwrap_or(&file_name);
    if of(DT_NEEDED).any(|needed| needed.starts_with("libmpi.so")) {
        println!("cargo:rustc-cfg=ipopt_mpi");
    }
    println!("cargo:rustc-env=IPOPT_LIBRARY={name}");
    println!("cargo:rustc-env=IPOPT_FILE={file_name}");
    let to_name = if is_system_directory(&directory) { PathBuf::new() } else { directory };
    println!("cargo:rustc-env=IPOPT_DIRECTORY={}", to_name.display());
}

/// Tag and name of what an ELF library calls itself and of what it needs.
fn entries(file: &Path) -> Option<Vec<(i64, String)>> {
    let bytes = fs::read(file).ok()?;
    let elf = ElfBytes::<AnyEndian>::minimal_parse(&bytes).ok()?;
    let (_, names) = elf.dynamic_symbol_table().ok()??;
    let named = elf
        .dynamic()
        .ok()??
        .into_iter()
        .filter(|entry| matches!(entry.d_tag, DT_SONAME | DT_NEEDED));
    let name = |at: u64| names.get(usize::try_from(at).ok()?).ok().map(str::to_owned);
    named.map(|entry| Some((entry.d_tag, name(entry.d_val())?))).collect()
}

/// Builds the shared library that stands in for the HSL's: see `src/hsl.rs`.
fn build_ma57_library() {
    const SOURCE: &str = "src/hsl/ma57_library.c";
    println!("cargo:rerun-if-changed={SOURCE}");
    let library = Path::new(&env::var_os("OUT_DIR").unwrap_or_default()).join("ma57_library.so");
    let mut command = cc::Build::new().pic(true).opt_level(2).get_compiler().to_command();
    // Two kilobytes instead of thirteen: a limit on the size of files holds for files in memory too.
    command.args(["-shared", "-nostdlib", "-s", "-Wl,-z,noseparate-code,-z,norelro", "-o"]);
    command.arg(&library).arg(SOURCE);
    match command.status() {
        Ok(status) if status.success() => {}
        outcome => {
            eprintln!("{SOURCE} cannot be compiled: {command:?}: {outcome:?}");
            exit(1)
        }
    }
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
