//! Failures in colour: on a terminal, and nowhere else.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::Command;

use rustix::pty::{OpenptFlags, ioctl_tiocgptpeer, openpt, unlockpt};
use serde_json::json;

use crate::program::{command, folder_with, small_slew};

const ERROR: &str = "\u{1b}[1m\u{1b}[31merror:\u{1b}[0m ";
const HINT: &str = "\u{1b}[1m\u{1b}[36mhint:\u{1b}[0m ";

/// What a command says where stderr is a terminal.
fn on_a_terminal(command: &mut Command) -> String {
    let flags = OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC;
    let controller = openpt(flags).expect("a terminal");
    unlockpt(&controller).expect("its own");
    let terminal = ioctl_tiocgptpeer(&controller, flags).expect("its other end");
    let mut child = command
        .stderr(terminal)
        .env_remove("NO_COLOR")
        .env_remove("CLICOLOR")
        // Where a service builds and tests, output is coloured whatever TERM says.
        .env_remove("CI")
        .env("TERM", "xterm-256color")
        .spawn()
        .expect("the program starts");
    // The terminal hangs up once nobody holds its other end, which the command does too.
    command.stderr(std::process::Stdio::null());
    let mut said = Vec::new();
    match File::from(controller).read_to_end(&mut said) {
        Err(error) if error.raw_os_error() == Some(rustix::io::Errno::IO.raw_os_error()) => {}
        ended => drop(ended.expect("readable")),
    }
    assert_eq!(child.wait().expect("it ends").code(), Some(2));
    String::from_utf8(said).expect("UTF-8").replace("\r\n", "\n")
}

fn refused(folder: &Path, more: &[&str]) -> Command {
    let mut command = command(folder);
    command.args(["solve", "scenario.json", "--out", "out"]).args(more);
    command.stdout(std::process::Stdio::null());
    command
}

#[test]
fn a_terminal_shows_error_and_hint_in_colour_unless_told_otherwise() {
    let mut scenario = small_slew();
    scenario["horizon"]["steps"] = json!(0);
    let folder = folder_with(&scenario);
    let at = folder.path();
    let message = "scenario.json: horizon.steps: found 0, expected a whole number from 1 to 100000";
    let hint = "`righting schema` prints the format with every field";

    let colored = on_a_terminal(&mut refused(at, &[]));
    assert_eq!(colored, format!("{ERROR}{message}\n  {HINT}{hint}\n"));

    let plain = format!("error: {message}\n  hint: {hint}\n");
    assert_eq!(on_a_terminal(&mut refused(at, &["--json"])), plain);
    let without = |name: &str, value: &str| {
        let mut command = Command::new("env");
        command.arg(format!("{name}={value}")).arg(env!("CARGO_BIN_EXE_righting"));
        command.args(["solve", "scenario.json", "--out", "out"]).current_dir(at);
        on_a_terminal(&mut command)
    };
    assert_eq!(without("NO_COLOR", "1"), plain);
    assert_eq!(without("TERM", "dumb"), plain);

    let piped = refused(at, &[]).output().expect("it starts");
    assert_eq!(String::from_utf8(piped.stderr).expect("UTF-8"), plain);
}

#[test]
fn what_is_not_a_terminal_is_coloured_on_request() {
    let folder = folder_with(&json!({}));
    let mut command = refused(folder.path(), &[]);
    let output = command.env("CLICOLOR_FORCE", "1").env_remove("NO_COLOR").output();
    let said = String::from_utf8(output.expect("it starts").stderr).expect("UTF-8");
    assert!(said.starts_with(ERROR), "{said}");
}
