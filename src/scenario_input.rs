//! The scenario to plan: a file, or standard input.

use std::io::{self, IsTerminal};
use std::path::Path;

use righting_scenario::{Scenario, file_io};

use crate::failure::Failure;
use crate::output::{self, Label};

/// The path that stands for standard input.
const STANDARD_INPUT: &str = "-";
/// What standard input is called in messages.
const NAME: &str = "standard input";

/// Reads and checks the scenario at `path`; at `-`, what another program writes. A relative system
/// path in it is then relative to the working folder.
pub fn read(path: &Path) -> Result<Scenario, Failure> {
    if path != Path::new(STANDARD_INPUT) {
        return Ok(Scenario::read(path)?);
    }
    let source = io::stdin().lock();
    if source.is_terminal() {
        output::say(Label::Note, "the scenario is read from standard input, up to Ctrl-D");
    }
    let text = file_io::read_from(source, name(path), file_io::JSON_LIMIT_BYTES)?;
    Ok(Scenario::parse(&text, name(path))?)
}

/// What the file of a scenario at `path` is called in messages.
pub fn name(path: &Path) -> &Path {
    if path == Path::new(STANDARD_INPUT) { Path::new(NAME) } else { path }
}
