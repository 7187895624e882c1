//! The help of every command as one page of Markdown.

use clap::{Arg, Command};

/// The page: a section a command, in the order of the help.
pub fn page(whole: &Command) -> String {
    let mut text = "# Commands\n\n".to_owned();
    for command in shown(whole) {
        section(command, whole.get_name(), 2, &mut text);
    }
    text.push_str("## Exit codes\n\n| code | meaning |\n| --- | --- |\n");
    for (code, meaning) in crate::EXIT_CODES {
        text.push_str(&format!("| {code} | {meaning} |\n"));
    }
    text
}

fn shown(command: &Command) -> impl Iterator<Item = &Command> {
    command.get_subcommands().filter(|part| !part.is_hide_set())
}

/// A command, what it takes, and the commands in it.
fn section(command: &Command, parent: &str, level: usize, text: &mut String) {
    let name = format!("{parent} {}", command.get_name());
    let about = command.get_long_about().or(command.get_about());
    let usage = command.clone().render_usage().to_string();
    let usage = usage.trim_start_matches("Usage: ");
    let about = about.map(|about| escaped(&about.to_string())).unwrap_or_default();
    text.push_str(&format!("{} {name}\n\n{about}\n\n```text\n{usage}\n```\n\n", "#".repeat(level)));
    let arguments = command.get_arguments();
    let arguments =
        arguments.filter(|argument| !argument.is_hide_set() && argument.get_id() != "help");
    let rows: String = arguments.map(row).collect();
    if !rows.is_empty() {
        text.push_str(&format!("| argument | meaning |\n| --- | --- |\n{rows}\n"));
    }
    for part in shown(command) {
        section(part, &name, level + 1, text);
    }
}

/// An argument as it is typed, and its help with what it may be and is by default.
fn row(argument: &Arg) -> String {
    let help = argument.get_long_help().or(argument.get_help());
    let mut help = help.map(ToString::to_string).unwrap_or_default();
    let values: Vec<String> = argument
        .get_possible_values()
        .iter()
        .filter(|value| !value.is_hide_set())
        .map(|value| value.get_name().to_owned())
        .collect();
    if !values.is_empty() && argument.get_action().takes_values() {
        help.push_str(&format!("; one of {}", values.join(", ")));
    }
    let defaults: Vec<_> =
        argument.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    if !defaults.is_empty() && argument.get_action().takes_values() {
        help.push_str(&format!("; {} by default", defaults.join(" ")));
    }
    let help = escaped(&help).replace('\n', " ").replace('|', "\\|");
    format!("| `{}` | {help} |\n", argument.to_string().replace('|', "\\|"))
}

/// Text in which nothing is taken for an element of HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}
