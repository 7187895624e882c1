//! Folders that two runs want, that take no file, or that take only so many bytes: no plan is mixed or cut off.

use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::json;

use crate::program::{Run, command, files_in, folder_with, righting, small_slew, solve};

const SHORT: [&str; 7] =
    ["solve", "scenario.json", "--out", "out", "--no-report", "--figures", "none"];

#[test]
fn a_folder_belongs_to_one_run_at_a_time() {
    let folder = folder_with(&small_slew());
    let mut long = small_slew();
    long["horizon"]["steps"] = json!(60000);
    std::fs::write(folder.path().join("long.json"), long.to_string()).expect("writable");
    // The lock of a run that is at work there.
    assert_eq!(righting(folder.path(), &SHORT).code, 0);
    let held = std::fs::File::open(folder.path().join("out")).expect("made");
    held.lock().expect("free");
    let refused = righting(folder.path(), &SHORT);
    refused.assert_refused("out: cannot hold results: another run is writing there");
    drop(held);
    // A run that is killed, however far it is, gives the folder back.
    let mut first = command(folder.path())
        .args(["solve", "long.json", "--out", "out"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(std::time::Duration::from_millis(100));
    first.kill().expect("ours");
    first.wait().expect("ours");
    assert_eq!(righting(folder.path(), &SHORT).code, 0);
    assert_eq!(righting(folder.path(), &["verify", "out"]).code, 0);
}

/// Runs the program where no file may be larger than so many bytes.
fn with_file_size_limit(folder: &Path, bytes: u64) -> Run {
    let script = "ulimit -f \"$BLOCKS\"; trap '' XFSZ; exec \"$RIGHTING\" \"$@\"";
    let mut shell = Command::new("sh");
    shell.args(["-c", script, "sh"]).args(SHORT).current_dir(folder).stdin(Stdio::null());
    // The shell counts blocks of 512 bytes.
    shell.env("RIGHTING", env!("CARGO_BIN_EXE_righting")).env("BLOCKS", (bytes / 512).to_string());
    Run::from(shell.output().expect("a shell"))
}

#[test]
fn a_disk_that_is_full_at_any_byte_leaves_a_whole_plan_or_none() {
    let folder = folder_with(&small_slew());
    assert_eq!(righting(folder.path(), &SHORT).code, 0);
    let size = |name: &str| {
        std::fs::metadata(folder.path().join("out").join(name)).expect("written").len()
    };
    let largest = size("trajectory.csv").max(size("solution.json"));
    let (mut refused, mut written) = (0, 0);
    for bytes in (512..largest + 1024).step_by(512) {
        let run = with_file_size_limit(folder.path(), bytes);
        let files = files_in(&folder.path().join("out"));
        let verified = righting(folder.path(), &["verify", "out"]).code;
        match run.code {
            0 => {
                written += 1;
                assert_eq!((files.len(), verified), (2, 0), "{bytes}");
            }
            code => {
                refused += 1;
                assert_eq!(code, 2, "{bytes}: {}", run.stderr);
                assert!(run.stderr.contains(": cannot be written: "), "{}", run.stderr);
                // The earlier plan is gone, and nothing that is cut off is in its place.
                assert!(!files.contains(&"solution.json".to_owned()), "{bytes}: {files:?}");
                assert_eq!(verified, 2, "{bytes}");
            }
        }
    }
    assert!(refused >= 5 && written >= 1, "{refused} {written}");
}

#[test]
fn a_folder_that_takes_no_file_is_refused_before_anything_is_solved() {
    let folder = folder_with(&small_slew());
    // Root may write anywhere but here.
    for out in ["/proc/self", "/proc/out"] {
        let run = righting(folder.path(), &["solve", "scenario.json", "--out", out]);
        run.assert_refused("cannot hold results: ");
    }
    assert_eq!(solve(folder.path()).code, 0);
}
