//! One BLAS thread: more of them make the small fronts of these problems slower and the rounding
//! depend on the machine.

use std::process::Command;

/// What the common threaded libraries read, once, when they are loaded.
const VARIABLES: [&str; 4] =
    ["OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS"];
const THREADED: [&str; 3] = ["openblas", "libmkl_", "libblis"];

/// Starts the process over with one BLAS thread if a threaded BLAS is loaded and free to use more.
///
/// A library reads its environment before `main` does, so that setting it here would be too late.
/// With the reference BLAS, or where the system does not tell what is loaded, nothing happens.
pub fn use_one_thread() {
    if VARIABLES.iter().all(|name| std::env::var_os(name).is_some_and(|value| value == "1")) {
        return;
    }
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap_or_default();
    let threaded = maps.lines().any(|line| THREADED.iter().any(|name| line.contains(name)));
    let Ok(program) = std::env::current_exe() else { return };
    if threaded {
        let mut command = Command::new(program);
        command.args(std::env::args_os().skip(1)).envs(VARIABLES.map(|name| (name, "1")));
        replace_process(&mut command);
    }
}

/// Returns only if that fails; the solve is then right but may be slow.
#[cfg(unix)]
fn replace_process(command: &mut Command) {
    use std::os::unix::process::CommandExt;
    if let Some(name) = std::env::args_os().next() {
        command.arg0(name);
    }
    let error = command.exec();
    let problem = format!("could not restrict BLAS to one thread: {error}");
    crate::output::say(crate::output::Label::Warning, &problem);
}

#[cfg(not(unix))]
fn replace_process(_: &mut Command) {}
