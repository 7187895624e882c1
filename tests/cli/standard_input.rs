//! `solve -` and `reach -`: the scenario that another program writes.

use std::io::Write;
use std::path::Path;
use std::process::Stdio;

use serde_json::{Value, json};

use crate::program::{Run, command, folder_with, small_slew};

/// Runs the program in `folder` with a text on standard input.
fn fed(folder: &Path, arguments: &[&str], text: &[u8]) -> Run {
    let mut child = command(folder)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut input = child.stdin.take().expect("piped");
    input.write_all(text).expect("the program reads");
    drop(input);
    Run::from(child.wait_with_output().expect("it ends"))
}

const SOLVE: [&str; 5] = ["solve", "-", "--out", "out", "--json"];

#[test]
fn a_scenario_is_read_from_standard_input() {
    let folder = folder_with(&json!({}));
    let run = fed(folder.path(), &SOLVE, small_slew().to_string().as_bytes());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(run.json()["scenario"]["name"], "small");
    assert!(folder.path().join("out/trajectory.csv").is_file());
}

#[test]
fn its_system_is_looked_for_in_the_working_folder() {
    let folder = folder_with(&json!({}));
    let mut scenario = small_slew();
    let system = scenario["system"].take();
    std::fs::create_dir(folder.path().join("systems")).expect("room");
    std::fs::write(folder.path().join("systems/arm.json"), system.to_string()).expect("writable");
    scenario["system"] = json!("systems/arm.json");
    let run = fed(folder.path(), &SOLVE, scenario.to_string().as_bytes());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert_eq!(run.json()["scenario"]["system"]["name"], "two_joints");
}

#[test]
fn messages_call_it_standard_input() {
    let mut wrong = small_slew();
    wrong["horizon"]["steps"] = json!(0);
    let mut lost = small_slew();
    lost["system"] = json!("absent.json");
    let of = |value: &Value| value.to_string().into_bytes();
    let steps = "error: standard input: horizon.steps: found 0, expected a whole number from 1 to \
                 100000\n  hint: `righting schema` prints the format with every field\n";
    let system = "error: standard input: system: found \"absent.json\", expected the path of a \
                  system file (absent.json: cannot be read: no such file)\n  hint: `righting \
                  schema` prints the format with every field\n";
    let arm = "error: standard input: found a system file, expected a scenario file\n  hint: name \
               it in the field `system` of a scenario\n";
    let empty = "error: standard input: line 1, column 0: not JSON: EOF while parsing a value\n";
    let binary = "error: standard input: cannot be read: not UTF-8 text\n";
    for (text, message) in [
        (of(&wrong), steps),
        (of(&lost), system),
        (of(&small_slew()["system"]), arm),
        (Vec::new(), empty),
        (vec![0xff, 0xfe], binary),
    ] {
        for command in [&SOLVE[..4], &["reach", "-", "--out", "out"]] {
            let folder = folder_with(&json!({}));
            let run = fed(folder.path(), command, &text);
            assert_eq!((run.code, run.stderr.as_str()), (2, message));
            assert!(!folder.path().join("out").exists());
        }
    }
}

#[test]
fn reach_reads_it_too_and_varies_it() {
    let folder = folder_with(&json!({}));
    let arguments = ["reach", "-", "--resolution", "50", "--control-weight", "0.02", "--json"];
    let run = fed(folder.path(), &arguments, small_slew().to_string().as_bytes());
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert_eq!(run.json()["scenario"], "small");
    assert_eq!(run.json()["control_weight"], 0.02);
}

#[test]
fn a_file_of_that_name_is_reached_by_its_path() {
    let folder = folder_with(&json!({}));
    std::fs::write(folder.path().join("-"), small_slew().to_string()).expect("writable");
    let run = fed(folder.path(), &["solve", "./-", "--out", "out"], b"{}");
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
}
