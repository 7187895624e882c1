//! What a refusal must be like.

use std::fmt::Display;

/// Longer messages are not read.
const LONGEST: usize = 2000;

/// A message of an error about a file: one line that begins with the file's name and goes on, without signs that
/// move a terminal's cursor.
pub(crate) fn well_said(message: &str, file: impl Display) -> Result<(), String> {
    let file = file.to_string();
    let Some(rest) = message.strip_prefix(&file) else {
        return Err(format!("an error that does not begin with {file}: {message:?}"));
    };
    let problem = match rest {
        "" | ":" | ": " => "an error that says nothing",
        _ if message.chars().any(char::is_control) => "an error with control characters",
        _ if message.len() > LONGEST + file.len() => "an error that is too long to read",
        _ => return Ok(()),
    };
    Err(format!("{problem}: {message:?}"))
}

/// The same reader's answer to the same input.
pub(crate) fn same_twice<T>(
    first: Result<T, String>,
    second: Result<T, String>,
) -> Result<Result<T, String>, String> {
    match (&first, &second) {
        (Err(a), Err(b)) if a == b => Ok(first),
        (Ok(_), Ok(_)) => Ok(first),
        (a, b) => {
            let said = |answer: &Result<T, String>| answer.as_ref().err().cloned();
            Err(format!("two answers to one input: {:?} and {:?}", said(a), said(b)))
        }
    }
}
