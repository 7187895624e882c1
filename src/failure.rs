//! Everything that ends a command with an exit code other than 0.

use std::io;
use std::path::PathBuf;

use righting_analysis::Impossible;
use righting_export::ExportError;
use righting_flight::ConversationError;
use righting_ipopt::LoadError;
use righting_planner::{PlanError, ReachError};
use righting_report::{ReportError, status_phrase};
use righting_results::{Solution, Status};
use righting_scenario::error::Mismatch;
use righting_scenario::json::FileKind;
use righting_sweep::SweepError;
use righting_verifier::ATTITUDE_ERROR;

/// Why a command did not do what was asked. Messages are read at one glance.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A file of the user's is wrong or cannot be read or written.
    #[error(transparent)]
    Input(#[from] righting_scenario::Error),
    /// The same of a file that is no scenario.
    #[error("{error}")]
    InputOf {
        /// What the file should be.
        kind: FileKind,
        /// What is wrong with it.
        #[source]
        error: righting_scenario::Error,
    },
    /// A file stands where a folder is expected.
    #[error("{}: {}", path.display(), Mismatch::new("a file", expected))]
    NotAFolder {
        /// The file.
        path: PathBuf,
        /// Such as "the folder of a plan".
        expected: &'static str,
    },
    /// The output folder cannot take results; found out before solving.
    #[error("{}: cannot hold results: {problem}", folder.display())]
    OutputFolder {
        /// The folder asked for.
        folder: PathBuf,
        /// What is in the way.
        problem: String,
    },
    /// An earlier plan to start from is of an arm with more or fewer joints.
    #[error(
        "{}: {}",
        folder.display(),
        Mismatch::new(format_args!("a plan of {found} joints"), expected)
    )]
    OtherArm {
        /// The folder of the earlier plan.
        folder: PathBuf,
        /// How many joints its arm has.
        found: usize,
        /// How many the scenario's has.
        expected: usize,
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
    /// A plan could not be put into another format.
    #[error(transparent)]
    Export(#[from] ExportError),
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
    /// The machine lacks something, as its diagnosis says.
    #[error("not ready to solve: {problem}")]
    NotReady {
        /// What, and what to do about it.
        problem: String,
    },
    /// There is no optimizer.
    #[error("not ready to solve: {0}")]
    NoOptimizer(#[from] LoadError),
    /// The optimizer ended without a plan.
    #[error("no acceptable plan: {}", status_phrase(*status))]
    NoPlan {
        /// How it ended.
        status: Status,
        /// Whether its notes say why.
        has_notes: bool,
    },
    /// The optimizer ended without an optimum, but with a plan that passes every check.
    #[error("the plan is verified, but not optimal: {}", status_phrase(*status))]
    NotOptimal {
        /// How it ended.
        status: Status,
    },
    /// The optimizer had nothing to start from.
    #[error("no acceptable plan: {0}")]
    NotPlanned(#[source] PlanError),
    /// No motion of the arm makes the maneuver.
    #[error("impossible: {0}")]
    Impossible(#[source] Impossible),
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
    /// A joint was named that the arm does not have.
    #[error("--stick: {}", Mismatch::new(format_args!("joint {found}"), format_args!("one of joints 1 to {joints}")))]
    NoSuchJoint {
        /// Which, counted from one.
        found: usize,
        /// How many there are.
        joints: usize,
    },
    /// A plant at the other end of a pipe does not answer as it should.
    #[error(transparent)]
    Conversation(#[from] ConversationError),
    /// The user asked to stop flying.
    #[error("interrupted: the table has the {flown} flights until then")]
    FlightsInterrupted {
        /// How many were flown.
        flown: usize,
    },
    /// The user asked to stop.
    #[error("interrupted{}", if *has_plan { ": the plan until then is verified, but not optimal" } else { "" })]
    Interrupted {
        /// Whether a verified plan was written all the same.
        has_plan: bool,
    },
}

impl From<PlanError> for Failure {
    fn from(error: PlanError) -> Self {
        match error {
            PlanError::Impossible(reason) => Self::Impossible(reason),
            PlanError::NotReplanned(what) | PlanError::NoFeedback(what) => Self::Usage(what),
            error => Self::NotPlanned(error),
        }
    }
}

impl From<ReachError> for Failure {
    fn from(error: ReachError) -> Self {
        match error {
            ReachError::Plan(error) => error.into(),
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
            | Self::InputOf { .. }
            | Self::NotAFolder { .. }
            | Self::OtherArm { .. }
            | Self::OutputFolder { .. }
            | Self::Usage(_)
            | Self::Sweep(_)
            | Self::Report(_)
            | Self::Export(_)
            | Self::NotShown { .. }
            | Self::Stdout(_)
            | Self::NotReady { .. }
            | Self::NoOptimizer(_)
            | Self::NotSearched(_)
            | Self::NoSuchJoint { .. }
            | Self::Conversation(_) => 2,
            Self::NoPlan { .. }
            | Self::NotOptimal { .. }
            | Self::NotPlanned(_)
            | Self::Impossible(_)
            | Self::OutOfReach { .. } => 3,
            Self::Unproven { .. } => 4,
            Self::Interrupted { .. } | Self::FlightsInterrupted { .. } => 130,
        }
    }

    /// Whether the command printed its results all the same.
    pub fn follows_results(&self) -> bool {
        matches!(
            self,
            Self::NotReady { .. }
                | Self::NoPlan { .. }
                | Self::NotOptimal { .. }
                | Self::OutOfReach { .. }
                | Self::Unproven { .. }
                | Self::Interrupted { .. }
                | Self::FlightsInterrupted { .. }
        )
    }
}
