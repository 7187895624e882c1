//! What may help after a failure.

use std::io::ErrorKind;

use righting_planner::ReachError;
use righting_report::ReportError;
use righting_results::Status;
use righting_scenario::Error;
use righting_scenario::json::FileKind;
use righting_sweep::SweepError;

use crate::failure::Failure;

impl Failure {
    /// What may help, where that is not plain from the message.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Input(error) => hint_of_input(error, FileKind::Scenario),
            Self::InputOf { kind, error } => hint_of_input(error, *kind),
            Self::Sweep(SweepError::Input(error)) => hint_of_input(error, FileKind::Sweep),
            Self::Sweep(SweepError::Occupied { .. }) => {
                Some("add --resume to go on from there, or name another folder with --out")
            }
            Self::Sweep(SweepError::Write { source, .. }) => Some(match source.kind() {
                ErrorKind::ReadOnlyFilesystem | ErrorKind::PermissionDenied => {
                    "what is recorded is safe: make it writable, then go on (a whole sweep with --resume)"
                }
                _ => {
                    "what is recorded is safe: make room, then go on (a whole sweep with --resume)"
                }
            }),
            Self::Report(ReportError::NoPng) => {
                Some("build it with `cargo build --release --features png`")
            }
            Self::Report(ReportError::NoFonts) => {
                Some("install some, such as Debian's fonts-dejavu-core, or leave --png out")
            }
            Self::NotShown { .. } => {
                Some("`righting figures` and `righting report` make the rest, from that folder")
            }
            Self::OtherArm { .. } => Some("a warm start is an earlier plan of the scenario's arm"),
            Self::OutputFolder { .. } => Some("name another folder"),
            Self::NoPlan { status: Status::IterationLimit, .. } => {
                Some("raise solver.max_iterations, or try solver.guess \"auto\"")
            }
            Self::NotOptimal { status: Status::IterationLimit } => {
                Some("raise solver.max_iterations for the optimum")
            }
            Self::NotOptimal { status: Status::TimeLimit } => {
                Some("give it more time for the optimum")
            }
            Self::NoPlan { has_notes: true, .. } => {
                Some("the notes say what stood in the way, and what was tried")
            }
            Self::Impossible(_) => Some("`righting explain` says what this arm can do"),
            Self::NotSearched(ReachError::NoAngle(_)) => Some("vary the duration instead"),
            Self::OutOfReach { .. } => Some(
                "wider limits, a smaller weights.control or more --starts may make it possible",
            ),
            Self::Unproven { falls_short: true, .. } => {
                Some("it misses its target: the notes say why, and what was tried")
            }
            Self::Unproven { .. } => Some("do not use this plan"),
            _ => None,
        }
    }
}

/// About a file that should be of a kind.
fn hint_of_input(error: &Error, kind: FileKind) -> Option<&'static str> {
    match (error, kind) {
        (Error::Kind { found, expected, .. }, _) => hint_of_kinds(*found, *expected),
        (Error::Field { .. }, FileKind::Scenario) => {
            Some("`righting schema` prints the format with every field")
        }
        (Error::Field { .. }, FileKind::System | FileKind::SystemOrScenario) => {
            Some("`righting schema system` prints the format with every field")
        }
        (Error::Field { .. }, FileKind::Sweep) => {
            Some("`righting schema sweep` prints the format with every field")
        }
        (Error::Field { .. }, FileKind::Wheels) => {
            Some("`righting schema wheels` prints the format with every field")
        }
        (Error::Field { .. }, FileKind::Solution) => {
            Some("`righting schema solution` prints the format with every field")
        }
        _ => None,
    }
}

/// What to do with a file of one kind that was given where another was expected.
fn hint_of_kinds(found: FileKind, expected: FileKind) -> Option<&'static str> {
    match (found, expected) {
        (FileKind::System, FileKind::Scenario) => {
            Some("name it in the field `system` of a scenario")
        }
        (FileKind::Scenario, FileKind::System) => {
            Some("the `system` of a scenario is a system file, or the system itself")
        }
        (FileKind::Scenario, FileKind::Sweep) => {
            Some("`righting solve` plans it; a sweep names it in its field `scenario`")
        }
        (FileKind::Sweep, _) => Some("`righting sweep` runs it"),
        (FileKind::PlannedSweep, _) => Some("`righting sweep run` works on the folder it is in"),
        (FileKind::Solution, _) => Some("its field `scenario` is the scenario that was solved"),
        (FileKind::Wheels, _) => {
            Some("`righting envelope` and `righting power` take it with --wheels")
        }
        _ => None,
    }
}
