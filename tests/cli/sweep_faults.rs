//! Sweeps that are killed, starved and cut off: nothing recorded is lost, nothing wrong is recorded.
#![cfg(target_os = "linux")]

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rustix::process::{Pid, Signal, kill_process};

use crate::program::{command, files_in, righting};
use crate::sweep::{folder_with_sweep, results, small_sweep, sweep};

const KILLS: usize = 20;

fn records(folder: &Path) -> usize {
    let text = std::fs::read(folder.join("out/records/1-of-1.jsonl")).unwrap_or_default();
    text.iter().filter(|&&byte| byte == b'\n').count()
}

fn kill(pid: i32) {
    let pid = Pid::from_raw(pid).expect("a process");
    // It may have ended in the meantime.
    let _ = kill_process(pid, Signal::KILL);
}

/// The worker processes of a sweep.
fn workers(parent: &Child) -> Vec<i32> {
    let mut workers = Vec::new();
    for entry in std::fs::read_dir("/proc").expect("processes").flatten() {
        let Some(pid) = entry.file_name().to_str().and_then(|name| name.parse::<i32>().ok()) else {
            continue;
        };
        let status = std::fs::read_to_string(entry.path().join("stat")).unwrap_or_default();
        // pid (name) state parent …
        let fields = status.rsplit(')').next().unwrap_or_default();
        if fields.split_whitespace().nth(1) == Some(&parent.id().to_string()) {
            workers.push(pid);
        }
    }
    workers
}

/// Waits for so many records; whether the sweep is still running then.
fn wait_for(records_wanted: usize, folder: &Path, parent: &mut Child) -> bool {
    while parent.try_wait().expect("a child").is_none() {
        if records(folder) >= records_wanted {
            return true;
        }
        sleep(Duration::from_millis(1));
    }
    false
}

#[test]
fn twenty_kills_of_workers_and_parents_change_nothing() {
    let sweep_file = small_sweep(50);
    let folder = folder_with_sweep(&sweep_file);
    assert_eq!(sweep(folder.path(), "undisturbed", &["--jobs", "2"]).code, 0);
    let expected = results(folder.path(), "undisturbed");
    assert_eq!(expected.len(), 1 + 100);

    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut kills = 0;
    let mut folder = folder_with_sweep(&sweep_file);
    while kills < KILLS {
        let mut parent = command(folder.path())
            .args(["sweep", "sweep.json", "--out", "out", "--jobs", "2", "--resume"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        // One worker, then the parent: a case that loses two workers in one run has failed.
        let before = records(folder.path());
        if wait_for(before + random.random_range(0..4), folder.path(), &mut parent) {
            let workers = workers(&parent);
            if !workers.is_empty() {
                kill(workers[random.random_range(0..workers.len())]);
                kills += 1;
            }
        }
        let before = records(folder.path());
        let finished = !wait_for(before + random.random_range(0..4), folder.path(), &mut parent);
        if !finished {
            kill(parent.id() as i32);
            kills += 1;
        }
        parent.wait().expect("a child");
        if finished {
            assert_eq!(results(folder.path(), "out"), expected);
            folder = folder_with_sweep(&sweep_file);
        }
    }
    assert_eq!(sweep(folder.path(), "out", &["--jobs", "2", "--resume"]).code, 0);
    assert_eq!(results(folder.path(), "out"), expected);
}

#[test]
fn a_killed_parent_leaves_no_worker_behind() {
    let folder = folder_with_sweep(&small_sweep(50));
    let mut parent = command(folder.path())
        .args(["sweep", "sweep.json", "--out", "out", "--jobs", "2"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    assert!(wait_for(2, folder.path(), &mut parent));
    let workers = workers(&parent);
    assert_eq!(workers.len(), 2);
    kill(parent.id() as i32);
    parent.wait().expect("a child");
    let runs = |pid: &i32| {
        let status = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
        let state = status.rsplit(") ").next().and_then(|rest| rest.chars().next());
        // A zombie has ended; who adopted it has not looked yet.
        state.is_some_and(|state| state != 'Z')
    };
    while workers.iter().any(runs) {
        sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_file_that_cannot_grow_stops_the_sweep_cleanly() {
    assert_stops_where_files_cannot_grow();
}

/// A limit on the size of files: what a full disk is without one.
pub fn assert_stops_where_files_cannot_grow() {
    let folder = folder_with_sweep(&small_sweep(25));
    let limited = |blocks: &str, out: &str| {
        let script = format!(
            "trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" sweep sweep.json --out {out} --jobs 2"
        );
        let mut sh = Command::new("sh");
        sh.args(["-c", &script, env!("CARGO_BIN_EXE_righting")]).current_dir(folder.path());
        crate::program::Run::from(sh.stdin(Stdio::null()).output().expect("a shell"))
    };
    // Room for the plan, but not for all records.
    let run = limited("16", "out");
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert!(
        run.stderr.starts_with("error: out/records/1-of-1.jsonl: cannot be written: "),
        "{}",
        run.stderr
    );
    assert!(run.stderr.contains("hint: what is recorded is safe"), "{}", run.stderr);
    let shown = righting(folder.path(), &["sweep", "show", "out", "--json"]).json();
    let recorded = shown["recorded"].as_u64().expect("a number");
    assert!((1..50).contains(&recorded), "{recorded}");

    assert_eq!(sweep(folder.path(), "out", &["--resume"]).code, 0);
    assert_eq!(sweep(folder.path(), "undisturbed", &[]).code, 0);
    assert_eq!(results(folder.path(), "out"), results(folder.path(), "undisturbed"));

    // No room for the plan itself.
    let run = limited("1", "none");
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert!(run.stderr.contains("none/sweep.json: cannot be written"), "{}", run.stderr);
    assert_eq!(files_in(&folder.path().join("none")), ["records"]);
}

#[test]
fn two_sweeps_do_not_write_the_same_records() {
    let folder = folder_with_sweep(&small_sweep(50));
    let mut first = command(folder.path())
        .args(["sweep", "sweep.json", "--out", "out", "--jobs", "1"])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    assert!(wait_for(1, folder.path(), &mut first));
    // Stopped, so that it is still there however slow the machine is.
    let pid = Pid::from_raw(first.id() as i32).expect("a process");
    kill_process(pid, Signal::STOP).expect("stopped");
    sweep(folder.path(), "out", &["--resume"]).assert_refused("another process is writing it");
    kill(first.id() as i32);
    first.wait().expect("a child");
}
