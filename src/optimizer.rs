//! Ipopt, loaded by the commands that solve and by no other: loading it takes longer than most of them.

use std::process::Command;

use crate::failure::Failure;

/// Open MPI's choice of how its processes talk to each other. It is one process here, which by default
/// would make 16 MiB of shared memory, leave them behind if it is killed, and complain where there is no
/// room for them.
const TALKS_TO: (&str, &str) = ("OMPI_MCA_btl", "self");

/// Starts the process over with what Ipopt's libraries read from the environment when they are loaded;
/// to be called before anything else is done.
///
/// Where the system cannot do so Ipopt works too.
pub fn prepare() {
    let (name, value) = TALKS_TO;
    if !righting_ipopt::STARTS_MPI || std::env::var_os(name).is_some() {
        return;
    }
    let Ok(program) = std::env::current_exe() else { return };
    let mut command = Command::new(program);
    command.args(std::env::args_os().skip(1)).env(name, value);
    replace_process(&mut command);
}

/// Returns only if that fails.
#[cfg(unix)]
fn replace_process(command: &mut Command) {
    use std::os::unix::process::CommandExt;
    if let Some(name) = std::env::args_os().next() {
        command.arg0(name);
    }
    let _ = command.exec();
}

#[cfg(not(unix))]
fn replace_process(_: &mut Command) {}

/// Loads Ipopt, so that a machine without it says so before anything is written.
///
/// Its BLAS gets one thread: more of them make the small fronts of these problems slower and the
/// rounding depend on the machine.
pub fn load() -> Result<(), Failure> {
    righting_ipopt::keep_freed_memory();
    righting_ipopt::prefer_huge_pages();
    Ok(righting_ipopt::use_one_blas_thread()?)
}
