//! What a solve does to its process: it reads no file and prints nothing.

mod support;

use righting_ipopt::*;
use std::process::{Command, Output};
use support::hock_schittkowski::*;

const CHILD: &str = "RIGHTING_IPOPT_TEST_CHILD";

/// Runs one test of this file in a process of its own, in a directory that holds an `ipopt.opt`.
fn run_child(test: &str) -> Output {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("ipopt.opt"), "max_iter 1\nprint_level 5\n").unwrap();
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", test, "--nocapture", "--test-threads=1"])
        .env(CHILD, "yes")
        .current_dir(directory.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    output
}

fn is_child() -> bool {
    std::env::var_os(CHILD).is_some()
}

#[test]
fn child_solves() {
    if is_child() {
        assert!(std::path::Path::new("ipopt.opt").exists());
        let solution = support::solve_from(&mut Dense(Hs071), Hs071::START, &Options::default());
        assert_eq!(solution.status, Status::Solved);
        assert!(solution.iterations > 1);
        let extra = vec![("no_such_option".to_owned(), OptionValue::Integer(1))];
        let options = Options { extra, ..Options::default() };
        let start = Start::at(Hs071::START.to_vec());
        let refused = solve(&mut Dense(Hs071), &options, &start, |_| Control::Continue);
        assert!(refused.is_err());
    }
}

#[test]
fn child_prints() {
    if is_child() {
        let options = Options { print_level: 3, ..Options::default() };
        support::solve_from(&mut Dense(Hs071), Hs071::START, &options);
    }
}

#[test]
fn an_options_file_in_the_working_directory_has_no_effect() {
    run_child("child_solves");
}

#[test]
fn nothing_is_printed_unless_asked_for() {
    let printed = |test| String::from_utf8(run_child(test).stdout).unwrap();
    // Between these two lines of the test harness there is nothing.
    let silent = printed("child_solves");
    assert!(silent.contains("running 1 test\ntest child_solves ... ok\n"), "{silent}");
    let loud = printed("child_prints");
    assert!(loud.contains("Number of Iterations"), "{loud}");
    assert!(!loud.contains("Eclipse Public License"), "{loud}");
}
