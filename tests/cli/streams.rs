//! Pipes, full disks and signals.

use std::fs::File;
use std::io::Read;
use std::process::Stdio;

use serde_json::json;

use crate::program::{Run, command, files_in, folder_with, righting, small_slew};

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    for arguments in [&["schema"][..], &["solve", "scenario.json", "--out", "out"], &["--help"]] {
        let folder = folder_with(&small_slew());
        let mut child = command(folder.path())
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        drop(child.stdout.take());
        let mut stderr = String::new();
        let mut pipe = child.stderr.take().expect("piped");
        pipe.read_to_string(&mut stderr).expect("readable");
        let code = child.wait().expect("it ends").code();
        assert_eq!((code, stderr.as_str()), (Some(0), ""), "{arguments:?}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_behind_stdout_is_said() {
    let folder = folder_with(&small_slew());
    let full = File::options().write(true).open("/dev/full").expect("Linux has it");
    let output = command(folder.path()).arg("schema").stdout(full).output().expect("it starts");
    Run::from(output).assert_refused("cannot print results");
}

#[test]
#[cfg(target_os = "linux")]
fn a_plan_outlives_what_cannot_be_drawn() {
    let folder = folder_with(&small_slew());
    // The page alone is longer than 200 blocks; with the signal ignored, writing it fails.
    let script = "trap '' XFSZ; ulimit -f 200; exec \"$0\" solve scenario.json --out out --json";
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", script, env!("CARGO_BIN_EXE_righting")]).current_dir(folder.path());
    let run = Run::from(shell.output().expect("it starts"));
    run.assert_refused("the plan in out is whole, but not what shows it: out/report.html: ");
    assert_eq!(run.json()["exit_code"], 2);
    let files = files_in(&folder.path().join("out"));
    assert!(files.contains(&"attitude.svg".to_owned()), "{files:?}");
    assert!(!files.contains(&"report.html".to_owned()), "{files:?}");
    for again in ["verify", "report", "figures"] {
        let run = righting(folder.path(), &[again, "out"]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    }
}

#[test]
#[cfg(unix)]
fn an_interrupted_solve_ends_cleanly() {
    for guess in ["constant", "auto"] {
        let mut long = small_slew();
        long["horizon"] = json!({ "duration_s": 500.0, "steps": 20_000 });
        long["solver"] = json!({ "formulation": "full", "guess": guess, "tolerance": 1e-14 });
        let folder = folder_with(&long);
        let child = command(folder.path())
            .args(["solve", "scenario.json", "--out", "out", "--json"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        // The folder is made once the signal is watched for.
        while !folder.path().join("out").exists() {
            std::thread::yield_now();
        }
        let pid = rustix::process::Pid::from_child(&child);
        rustix::process::kill_process(pid, rustix::process::Signal::INT).expect("it is running");
        let run = Run::from(child.wait_with_output().expect("it ends"));
        // How far it is then is the machine's to say.
        let has_plan = match run.stderr.as_str() {
            "error: interrupted\n" => false,
            "error: interrupted: the plan until then is verified, but not optimal\n" => true,
            other => panic!("{guess}: {other}"),
        };
        assert_eq!((run.code, &run.json()["status"]), (130, &json!("interrupted")), "{guess}");
        let files = files_in(&folder.path().join("out"));
        assert!(files.contains(&"solution.json".to_owned()), "{guess}: {files:?}");
        assert_eq!(files.contains(&"trajectory.csv".to_owned()), has_plan, "{guess}: {files:?}");
    }
}
