//! The inputs of a fixed seed, few enough for every run of the tests: `make fuzz` runs a million.

use std::process::Command;

fn run(targets: &[&str], inputs: u32) {
    let mut fuzz = Command::new(env!("CARGO_BIN_EXE_righting-fuzz"));
    fuzz.args(targets).args(["--seed", "20261130", "--inputs", &inputs.to_string()]);
    let output = fuzz.output().expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{:?}: {said}", output.status);
    let counts = String::from_utf8_lossy(&output.stdout);
    assert_eq!(counts.lines().count(), targets.len(), "{counts}");
}

#[test]
fn readers_refuse_or_take_whatever_comes() {
    run(&["scenario", "system", "wheels", "sweep", "urdf", "trajectory", "journal"], 500);
}

#[test]
fn folders_of_plans_are_verified_whatever_they_hold() {
    run(&["solution"], 200);
}

#[test]
fn solves_of_random_systems_end_in_a_status() {
    run(&["solve"], 60);
}
