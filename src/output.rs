//! Printing without panics: a reader may go away at any time.

use std::io::{self, ErrorKind, Write};

use anstream::ColorChoice;
use anstyle::{AnsiColor, Style};
use serde::Serialize;

use crate::failure::Failure;

/// Prints results on stdout. A reader that has had enough (`| head`) is no failure.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Stdout(error)),
        _ => Ok(()),
    }
}

/// Prints one JSON object on stdout.
pub fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    print(&to_json(value)?)
}

/// One JSON object as text that ends with a line.
pub fn to_json(value: &impl Serialize) -> Result<String, Failure> {
    let mut text = serde_json::to_string_pretty(value)
        .map_err(|error| Failure::Stdout(io::Error::other(error)))?;
    text.push('\n');
    Ok(text)
}

/// Prints a line on stderr, if anyone listens.
pub fn complain(line: &str) {
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// What a line on stderr is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Label {
    /// Why the command did not do what was asked.
    Error,
    /// What may help.
    Hint,
    /// What was left out or may be wrong.
    Warning,
    /// What a reader should know.
    Note,
}

impl Label {
    /// The word, what stands before it, and its colour on a terminal.
    fn shown(self) -> (&'static str, &'static str, Style) {
        match self {
            Self::Error => ("", "error", AnsiColor::Red.on_default().bold()),
            Self::Hint => ("  ", "hint", AnsiColor::Cyan.on_default().bold()),
            Self::Warning => ("", "warning", AnsiColor::Yellow.on_default().bold()),
            Self::Note => ("", "note", AnsiColor::Cyan.on_default().bold()),
        }
    }
}

/// Prints a labelled line on stderr, the label in colour where that is a terminal that takes it and
/// the environment (`NO_COLOR`, `CLICOLOR_FORCE`, `TERM`) does not say otherwise.
pub fn say(label: Label, text: &str) {
    let (indent, word, style) = label.shown();
    let line = format!("{indent}{style}{word}:{style:#} {text}\n");
    let _ = anstream::stderr().lock().write_all(line.as_bytes());
}

/// Keeps every line plain from here on: who asks for JSON may read stderr by program too.
pub fn never_in_color() {
    ColorChoice::Never.write_global();
}
