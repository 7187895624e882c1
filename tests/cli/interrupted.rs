//! Ctrl-C and termination: what there is by then is saved if it is a plan, and nothing that is none.

use std::path::Path;
use std::process::{Child, Stdio};
use std::time::Duration;

use rustix::process::{Pid, Signal, kill_process};
use serde_json::{Value, json};

use crate::program::{Run, command, files_in, folder_with, righting, small_slew};

/// A slew whose last solve takes seconds, and everything before it a moment.
fn long_slew() -> Value {
    let mut scenario = small_slew();
    scenario["horizon"]["steps"] = json!(12000);
    scenario
}

fn start(folder: &Path) -> Child {
    let mut solve = command(folder);
    solve.args(["solve", "scenario.json", "--out", "out", "--json", "--no-report"]);
    solve.args(["--figures", "none"]);
    solve.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts")
}

/// Sends a signal to a process of ours that has not been waited for.
fn send(signal: Signal, child: &Child) {
    let id = i32::try_from(child.id()).ok().and_then(Pid::from_raw).expect("a process");
    kill_process(id, signal).expect("it is ours");
}

/// Ends a solve by a signal after ever longer until it leaves a plan. How long that takes is the machine's: what is
/// left must be right whenever the signal comes.
fn interrupted_with_plan(signal: Signal) -> (tempfile::TempDir, Run) {
    let folder = folder_with(&long_slew());
    let mut wait = Duration::from_millis(20);
    loop {
        let child = start(folder.path());
        std::thread::sleep(wait);
        send(signal, &child);
        let output = child.wait_with_output().expect("it ends");
        if output.status.code().is_none() {
            // It came before the program listened, and ended it as any other.
            wait *= 2;
            continue;
        }
        let run = Run::from(output);
        assert_eq!(run.code, 130, "{}", run.stderr);
        let (files, verified) =
            (files_in(&folder.path().join("out")), righting(folder.path(), &["verify", "out"]));
        if files == ["solution.json", "trajectory.csv"] {
            assert_eq!(verified.code, 0, "{}", verified.stderr);
            return (folder, run);
        }
        assert_eq!(files, ["solution.json"], "after {wait:?}");
        assert_eq!(verified.code, 2);
        assert!(run.stderr.starts_with("error: interrupted\n"), "{}", run.stderr);
        wait = wait * 5 / 4;
        assert!(wait < Duration::from_secs(60), "no solve was interrupted with a plan");
    }
}

#[test]
fn both_signals_save_the_plan_until_then_marked_as_what_it_is() {
    for signal in [Signal::INT, Signal::TERM] {
        let (folder, run) = interrupted_with_plan(signal);
        assert!(
            run.stderr
                .contains("error: interrupted: the plan until then is verified, but not optimal\n"),
            "{}",
            run.stderr
        );
        let solution = run.json();
        assert_eq!(solution["status"], "interrupted", "{signal:?}");
        assert_eq!(solution["verification"]["passed"], true, "{signal:?}");
        assert!(solution["terminal"]["attitude_error"].as_f64().is_some_and(|e| e <= 1e-3));
        let verified = righting(folder.path(), &["verify", "out"]);
        assert!(verified.stdout.contains("Verified, but not optimal"), "{}", verified.stdout);
    }
}

#[test]
fn a_second_signal_ends_the_program_at_once_and_leaves_the_earlier_plan() {
    let folder = folder_with(&small_slew());
    assert_eq!(righting(folder.path(), &["solve", "scenario.json", "--out", "out"]).code, 0);
    let before = std::fs::read(folder.path().join("out/trajectory.csv")).expect("a plan");
    let mut much = long_slew();
    much["horizon"]["steps"] = json!(60000);
    std::fs::write(folder.path().join("scenario.json"), much.to_string()).expect("writable");
    let mut wait = Duration::from_millis(100);
    loop {
        let mut child = start(folder.path());
        std::thread::sleep(wait);
        // As many as it takes: one that comes while the last is being delivered is the same one.
        while child.try_wait().expect("a process").is_none() {
            send(Signal::TERM, &child);
        }
        let output = child.wait_with_output().expect("it ends");
        match output.status.code() {
            Some(code) => {
                assert_eq!(code, 130);
                break;
            }
            None => wait *= 2,
        }
    }
    let after = std::fs::read(folder.path().join("out/trajectory.csv")).expect("the plan");
    assert!(before == after);
    assert_eq!(righting(folder.path(), &["verify", "out"]).code, 0);
}
