//! Sweeps on a disk that is full or read-only: a small file system of their own, mounted where only
//! they see it.
#![cfg(target_os = "linux")]

use std::path::Path;
use std::process::{Command, Stdio};

use crate::program::Run;
use crate::sweep::{folder_with_sweep, results, small_sweep, sweep};
use crate::sweep_faults::assert_stops_where_files_cannot_grow;

/// 1 MiB of memory, of which 16 KiB are left: room for the plan and some of the records. What runs
/// leaves its exit code and what it said in a file a step.
const SCRIPT: &str = r#"
    set -e
    mkdir disk read_only
    mount -t tmpfs -o size=1m tmpfs disk
    head -c 1008K /dev/zero >disk/other
    step() {
        name=$1; shift
        code=0
        "$RIGHTING" sweep "$@" >"$name.out" 2>"$name.err" || code=$?
        echo $code >"$name.code"
    }
    step full sweep.json --out disk/out --jobs 2
    step still_full run disk/out
    step shown show disk/out --json
    rm disk/other
    step resumed sweep.json --out disk/out --jobs 2 --resume
    mkdir out
    cp disk/out/results.csv out
    mount --bind disk read_only
    mount -o remount,bind,ro read_only
    step again sweep.json --out read_only/out --resume
    step run run read_only/out
    step merged merge read_only/out
"#;

/// What a step of the script did.
fn step(folder: &Path, name: &str) -> Run {
    let read = |end: &str| {
        let path = folder.join(format!("{name}.{end}"));
        std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path:?}: {error}"))
    };
    let code = read("code").trim().parse().expect("an exit code");
    Run { code, stdout: read("out"), stderr: read("err") }
}

/// A shell that may mount what it likes: nobody else sees it, and it goes when the shell ends.
fn shell(folder: &Path, script: &str) -> Run {
    let mut unshare = Command::new("unshare");
    unshare.args(["--map-root-user", "--mount", "sh", "-c", script]);
    unshare.env("RIGHTING", env!("CARGO_BIN_EXE_righting"));
    Run::from(unshare.current_dir(folder).stdin(Stdio::null()).output().expect("util-linux"))
}

#[test]
fn a_full_or_read_only_disk_stops_the_sweep_and_changes_no_result() {
    let folder = folder_with_sweep(&small_sweep(25));
    let permitted = shell(folder.path(), "mount -t tmpfs tmpfs .");
    if permitted.code != 0 {
        eprintln!("no file system can be mounted here, a limit on file sizes stands in");
        return assert_stops_where_files_cannot_grow();
    }
    let run = shell(folder.path(), SCRIPT);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let step = |name: &str| step(folder.path(), name);

    for name in ["full", "still_full"] {
        let Run { code, stderr, .. } = step(name);
        let message = "error: disk/out/records/1-of-1.jsonl: cannot be written: the disk is full\n  \
                       hint: what is recorded is safe: make room, ";
        assert!(code == 2 && stderr.contains(message), "{name}: {code}: {stderr}");
    }
    let recorded = step("shown").json()["recorded"].as_u64().expect("a number");
    assert!((1..50).contains(&recorded), "{recorded}");

    let resumed = step("resumed");
    assert_eq!(resumed.code, 0, "{}", resumed.stderr);
    assert_eq!(sweep(folder.path(), "undisturbed", &["--jobs", "2"]).code, 0);
    assert_eq!(results(folder.path(), "out"), results(folder.path(), "undisturbed"));

    step("again")
        .assert_refused("read_only/out: cannot hold results: the file system is read-only");
    step("run").assert_refused(
        "read_only/out/records/1-of-1.jsonl: cannot be written: the file system is read-only\n  \
         hint: what is recorded is safe: make it writable, ",
    );
    step("merged").assert_refused("read_only/out/results.csv: cannot be written");
}
