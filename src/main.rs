//! `righting`: plans how a free-floating spacecraft turns itself with nothing but its robot arm.
//!
//! One file a subcommand. Results go to files and stdout, everything else to stderr; exit codes are
//! those of [`failure::Failure`].
#![forbid(unsafe_code)]

mod build;
mod compare;
mod completions;
mod doctor;
mod envelope;
mod explain;
mod export;
mod failure;
mod figures;
mod fly;
mod hint;
mod import;
mod interrupt;
mod json_path;
mod manpages;
mod optimizer;
mod output;
mod output_folder;
mod plan_folder;
mod power;
mod progress;
mod reach;
mod readable_json;
mod report;
mod scenario_input;
mod schema;
mod solve;
mod sweep;
mod verify;
mod warm_start;
mod wheels;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::failure::Failure;
use crate::output::Label;

/// Plans how a free-floating spacecraft turns itself with nothing but its robot arm.
#[derive(Parser)]
#[command(name = NAME, version = build::VERSION, after_help = exit_codes())]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// Name of the program.
const NAME: &str = "righting";

const EXIT_CODES: [(u8, &str); 5] = [
    (0, "done and verified"),
    (2, "bad input or usage"),
    (3, "no acceptable plan, or none is possible"),
    (4, "a plan was found but failed its verification"),
    (130, "interrupted"),
];

/// The exit codes as the help lists them.
fn exit_codes() -> String {
    let rows = EXIT_CODES.map(|(code, meaning)| format!("\n  {code:<3}  {meaning}"));
    format!("Exit codes:{}", rows.concat())
}

#[derive(Subcommand)]
enum Command {
    Solve(solve::Arguments),
    Verify(verify::Arguments),
    Reach(reach::Arguments),
    Report(report::Arguments),
    Compare(compare::Arguments),
    Explain(explain::Arguments),
    Envelope(envelope::Arguments),
    Power(power::Arguments),
    Sweep(sweep::Arguments),
    /// Evaluate the cases of a sweep that a parent process sends.
    #[command(hide = true)]
    SweepWorker,
    Fly(fly::Arguments),
    Figures(figures::Arguments),
    Export(export::Arguments),
    Import(import::Arguments),
    Schema(schema::Arguments),
    Doctor(doctor::Arguments),
    Completions(completions::Arguments),
    Manpages(manpages::Arguments),
}

fn main() -> ExitCode {
    let command = Arguments::parse().command;
    if command.solves() {
        optimizer::prepare();
    }
    let json = command.prints_json();
    if json {
        output::never_in_color();
    }
    let result = match command {
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Reach(arguments) => reach::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Envelope(arguments) => envelope::run(&arguments),
        Command::Power(arguments) => power::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::SweepWorker => sweep::work(),
        Command::Fly(arguments) => fly::run(&arguments),
        Command::Figures(arguments) => figures::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Import(arguments) => import::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
        Command::Doctor(arguments) => doctor::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Manpages(arguments) => manpages::run(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => complain(&failure, json),
    }
}

impl Command {
    /// Whether it solves anything in this process.
    fn solves(&self) -> bool {
        matches!(
            self,
            Self::Solve(_) | Self::Reach(_) | Self::Fly(_) | Self::SweepWorker | Self::Doctor(_)
        )
    }

    fn prints_json(&self) -> bool {
        match self {
            Self::Solve(arguments) => arguments.json,
            Self::Verify(arguments) => arguments.json,
            Self::Reach(arguments) => arguments.json,
            Self::Report(arguments) => arguments.json,
            Self::Compare(arguments) => arguments.json,
            Self::Explain(arguments) => arguments.json,
            Self::Envelope(arguments) => arguments.json,
            Self::Power(arguments) => arguments.json,
            Self::Fly(arguments) => arguments.json,
            Self::Sweep(arguments) => arguments.prints_json(),
            Self::Figures(_)
            | Self::Export(_)
            | Self::Import(_)
            | Self::SweepWorker
            | Self::Schema(_)
            | Self::Completions(_)
            | Self::Manpages(_) => false,
            Self::Doctor(arguments) => arguments.json,
        }
    }
}

/// Says on stderr what went wrong; who asked for JSON gets one object whatever happens.
fn complain(failure: &Failure, json: bool) -> ExitCode {
    output::say(Label::Error, &failure.to_string());
    if let Some(hint) = failure.hint() {
        output::say(Label::Hint, hint);
    }
    if json && !failure.follows_results() {
        let object = serde_json::json!({
            "error": failure.to_string(),
            "exit_code": failure.exit_code(),
        });
        // Stdout itself may be what failed: there is nobody left to tell.
        let _ = output::print_json(&object);
    }
    ExitCode::from(failure.exit_code())
}
