//! Everything that ends a command with an exit code other than 0.

use std::io::{self, ErrorKind};
use std::path::PathBuf;

use righting_maneuver::verifier::ATTITUDE_ERROR;
use righting_maneuver::{PlanError, ReachError, Solution, Status};
use righting_report::{ReportError, status_phrase};
use righting_sweep::SweepError;

/// Why a command did not do what was asked. Messages are read at one glance.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A file of the user's is wrong or cannot be read or written.
    #[error(transparent)]
    Input(#[from] righting_maneuver::Error),
    /// The output folder cannot take results; found out before solving.
    #[error("{}: cannot hold results: {problem}", folder.display())]
    OutputFolder {
        /// The folder asked for.
        folder: PathBuf,
        /// What is in the way.
        problem: String,
    },
    /// Arguments that contradict each other, beyond what the parser sees.
    #[error("{0}")]
    Usage(&'static str),
    /// A sweep cannot start or go on.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A figure could not be written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A plan is written, but not everything that shows it.
    #[error("the plan in {} is whole, but not what shows it: {cause}", folder.display())]
    NotShown {
        /// The folder of the plan.
        folder: PathBuf,
        /// What is in the way.
        #[source]
        cause: Box<Failure>,
    },
    /// Stdout does not take what is printed.
    #[error("cannot print results: {0}")]
    Stdout(io::Error),
    /// The machine lacks something.
    #[error("not ready to solve: {problem}")]
    NotReady {
        /// What, and what to do about it.
        problem: &'static str,
    },
    /// The optimizer ended without a plan.
    #[error("no acceptable plan: {}", status_phrase(*status))]
    NoPlan {
        /// How it ended.
        status: Status,
    },
    /// The optimizer had nothing to start from.
    #[error("no acceptable plan: {0}")]
    NotPlanned(#[from] PlanError),
    /// A search for what is possible could not begin or go on.
    #[error("nothing to search: {0}")]
    NotSearched(#[source] ReachError),
    /// Not even the easiest maneuver tried succeeds.
    #[error("no acceptable plan: not even {easiest}")]
    OutOfReach {
        /// Such as "in 480 s".
        easiest: String,
    },
    /// There is a plan, but it does not do what it claims.
    #[error("the plan failed its verification: {reason}")]
    Unproven {
        /// The first check that failed.
        reason: String,
        /// Whether the plan falls short of its target rather than of what it claims.
        falls_short: bool,
    },
    /// The user asked to stop.
    #[error("interrupted")]
    Interrupted,
}

impl From<ReachError> for Failure {
    fn from(error: ReachError) -> Self {
        match error {
            ReachError::Plan(error) => Self::NotPlanned(error),
            ReachError::Scenario(error) => Self::Input(error),
            error => Self::NotSearched(error),
        }
    }
}

impl Failure {
    /// The failure that a solution's verification amounts to, if it is one.
    pub fn of_verification(solution: &Solution) -> Option<Self> {
        let check = solution.verification.failures().next()?;
        let falls_short = solution.terminal.attitude_error > ATTITUDE_ERROR;
        Some(Self::Unproven { reason: check.to_string(), falls_short })
    }

    /// The exit code, as the command line's help lists them.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Input(_)
            | Self::OutputFolder { .. }
            | Self::Usage(_)
            | Self::Sweep(_)
            | Self::Report(_)
            | Self::NotShown { .. }
            | Self::Stdout(_)
            | Self::NotReady { .. }
            | Self::NotSearched(_) => 2,
            Self::NoPlan { .. } | Self::NotPlanned(_) | Self::OutOfReach { .. } => 3,
            Self::Unproven { .. } => 4,
            Self::Interrupted => 130,
        }
    }

    /// What may help, where that is not plain from the message.
    pub fn hint(&self) -> Option<&'static str> {
        match self {
            Self::Input(righting_maneuver::Error::Field { .. }) => {
                Some("`righting schema` prints the format with every field")
            }
            Self::Sweep(SweepError::Input(righting_maneuver::Error::Field { .. })) => {
                Some("`righting schema sweep` prints the format with every field")
            }
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
            Self::OutputFolder { .. } => Some("name another folder with --out"),
            Self::NoPlan { status: Status::Infeasible } => {
                Some("a longer duration, a smaller angle or wider limits may make it possible")
            }
            Self::NoPlan { status: Status::IterationLimit } => {
                Some("raise solver.max_iterations, or try solver.guess \"auto\"")
            }
            Self::NoPlan { .. } => Some("another solver.guess or a longer duration may help"),
            Self::NotSearched(ReachError::NoAngle(_)) => Some("vary the duration instead"),
            Self::OutOfReach { .. } => Some(
                "wider limits, a smaller weights.control or more --starts may make it possible",
            ),
            Self::Unproven { falls_short: true, .. } => {
                Some("it misses its target: a longer duration or a smaller angle may help")
            }
            Self::Unproven { .. } => Some("do not use this plan"),
            _ => None,
        }
    }

    /// Whether the command printed its results all the same.
    pub fn follows_results(&self) -> bool {
        matches!(
            self,
            Self::NotReady { .. }
                | Self::NoPlan { .. }
                | Self::OutOfReach { .. }
                | Self::Unproven { .. }
                | Self::Interrupted
        )
    }
}
