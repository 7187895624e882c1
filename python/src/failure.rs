//! Errors of the libraries as the exceptions of `righting.errors`.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use righting_export::ExportError;
use righting_ipopt::LoadError;
use righting_planner::{PlanError, ReachError};
use righting_results::{Check, Status};
use righting_scenario::Error;
use righting_scenario::error::{FieldProblem, ShapeError};
use righting_scenario::json::FileKind;
use righting_sweep::SweepError;

/// Why something was not done.
pub enum Failure {
    /// An input or a file is wrong.
    Input {
        /// What it should be.
        kind: FileKind,
        /// What is wrong with it.
        error: Box<Error>,
    },
    /// An argument is wrong.
    Argument {
        /// Its name.
        name: &'static str,
        /// What was given.
        found: String,
        /// What would be right.
        expected: &'static str,
    },
    /// There is nothing to optimize, or no motion of the arm makes the maneuver.
    Plan(PlanError),
    /// The optimizer ended without a plan.
    NoPlan(Status),
    /// A plan does not do what it claims: the first check that failed.
    Unproven(Check),
    /// There is no optimizer.
    NoOptimizer(LoadError),
    /// A sweep cannot start or go on.
    Sweep(SweepError),
    /// A plan cannot be put into another format.
    Export(ExportError),
    /// A solve was asked for where none can be made.
    NoTurn {
        /// Why.
        reason: &'static str,
        /// What to do instead.
        hint: &'static str,
    },
    /// A callback or a signal handler raised this, or it is to be raised as it is.
    Python(PyErr),
}

/// What a function of the package gives.
pub type Outcome<T> = Result<T, Failure>;

impl Failure {
    /// An input of a kind that is wrong.
    pub fn of_input(kind: FileKind) -> impl Fn(Error) -> Self {
        move |error| Self::Input { kind, error: Box::new(error) }
    }

    fn message(&self) -> String {
        match self {
            Self::Input { error, .. } => error.to_string(),
            Self::Argument { name, found, expected } => {
                format!("{name}: found {found}, expected {expected}")
            }
            Self::Plan(PlanError::Impossible(reason)) => format!("impossible: {reason}"),
            Self::Plan(error) => format!("no acceptable plan: {error}"),
            Self::NoPlan(status) => {
                format!("no acceptable plan: {}", righting_report::status_phrase(*status))
            }
            Self::Unproven(check) => format!("the plan failed its verification: {check}"),
            Self::NoOptimizer(error) => format!("not ready to solve: {error}"),
            Self::Sweep(error) => error.to_string(),
            Self::Export(error) => error.to_string(),
            Self::NoTurn { reason, .. } => format!("not ready to solve: {reason}"),
            Self::Python(error) => error.to_string(),
        }
    }

    /// Name of the exception in `righting.errors`.
    fn class(&self) -> &'static str {
        match self {
            Self::Input { error, .. } => match **error {
                Error::Read { .. } | Error::Write { .. } | Error::Remove { .. } => "FileError",
                _ => "InputError",
            },
            Self::Argument { .. } | Self::Export(_) => "InputError",
            Self::Sweep(SweepError::Worker { .. }) => "NotReadyError",
            Self::Sweep(_) => "FileError",
            Self::Plan(PlanError::Impossible(_)) => "ImpossibleError",
            Self::Plan(_) | Self::NoPlan(_) => "NoPlanError",
            Self::Unproven(_) => "VerificationError",
            Self::NoOptimizer(_) | Self::NoTurn { .. } | Self::Python(_) => "NotReadyError",
        }
    }

    /// What may help, where that is not plain from the message.
    fn hint(&self) -> Option<String> {
        match self {
            Self::Input { kind, error } => hint_of_input(error, *kind),
            Self::NoPlan(Status::IterationLimit) => {
                Some("raise solver.max_iterations, or try solver.guess \"auto\"".to_owned())
            }
            Self::NoPlan(_) => {
                Some("plan.notes say what stood in the way, and what was tried".to_owned())
            }
            Self::Unproven(_) => {
                Some("plan.verification has every check, plan.notes what was tried".to_owned())
            }
            Self::Sweep(SweepError::Occupied { .. }) => {
                Some("resume=True goes on from there; or name another folder".to_owned())
            }
            Self::NoTurn { hint, .. } => Some((*hint).to_owned()),
            _ => None,
        }
    }

    /// What else the exception says: names and values of its attributes.
    fn attributes(&self, attributes: &Bound<'_, PyDict>) -> PyResult<()> {
        match self {
            Self::Input { error, .. } => attributes_of_input(error, attributes)?,
            Self::Argument { name, found, expected } => {
                attributes.set_item("field", name)?;
                attributes.set_item("found", found)?;
                attributes.set_item("expected", expected)?;
            }
            Self::NoPlan(status) => {
                attributes.set_item("status", crate::json::word(status))?;
            }
            Self::Unproven(check) => attributes.set_item("check", check.name.clone())?,
            _ => {}
        }
        attributes.set_item("hint", self.hint())
    }

    fn raised(&self, py: Python<'_>) -> PyResult<PyErr> {
        let class = py.import("righting.errors")?.getattr(self.class())?;
        let attributes = PyDict::new(py);
        self.attributes(&attributes)?;
        Ok(PyErr::from_value(class.call((self.message(),), Some(&attributes))?))
    }
}

fn attributes_of_input(error: &Error, attributes: &Bound<'_, PyDict>) -> PyResult<()> {
    let file = match error {
        Error::Read { file, .. }
        | Error::Directory { file, .. }
        | Error::TooLarge { file, .. }
        | Error::NotJson { file, .. }
        | Error::Kind { file, .. }
        | Error::Field { file, .. }
        | Error::Cell { file, .. }
        | Error::Table { file, .. }
        | Error::Write { file, .. }
        | Error::Remove { file, .. } => Some(file.display().to_string()),
        _ => None,
    };
    attributes.set_item("file", file)?;
    let Error::Field { field, .. } = error else { return Ok(()) };
    attributes.set_item("field", &field.path)?;
    match &field.problem {
        FieldProblem::Mismatch(mismatch) => {
            attributes.set_item("found", &mismatch.found)?;
            attributes.set_item("expected", &mismatch.expected)
        }
        FieldProblem::Missing { expected } => attributes.set_item("expected", expected),
        _ => Ok(()),
    }
}

fn hint_of_input(error: &Error, kind: FileKind) -> Option<String> {
    let format = match (error, kind) {
        (Error::Kind { found, .. }, _) => {
            let reader = match found {
                FileKind::System => "righting.System reads it",
                FileKind::Scenario => "righting.Scenario reads it",
                FileKind::Sweep => "righting.sweep runs it",
                FileKind::Solution => "righting.Plan.read takes the folder that it is in",
                _ => return None,
            };
            return Some(reader.to_owned());
        }
        (Error::Field { .. }, FileKind::Scenario) => "scenario",
        (Error::Field { .. }, FileKind::System) => "system",
        (Error::Field { .. }, FileKind::Wheels) => "wheels",
        (Error::Field { .. }, FileKind::Sweep) => "sweep",
        (Error::Field { .. }, FileKind::Solution) => "solution",
        _ => return None,
    };
    Some(format!("righting.schema(\"{format}\") is the format with every field"))
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Python(error) => error,
            failure => Python::attach(|py| failure.raised(py).unwrap_or_else(|error| error)),
        }
    }
}

impl From<PyErr> for Failure {
    fn from(error: PyErr) -> Self {
        Self::Python(error)
    }
}

impl From<PlanError> for Failure {
    fn from(error: PlanError) -> Self {
        Self::Plan(error)
    }
}

impl From<ReachError> for Failure {
    fn from(error: ReachError) -> Self {
        match error {
            ReachError::Plan(error) => Self::Plan(error),
            ReachError::Scenario(error) => Self::of_input(FileKind::Scenario)(error),
            error => Self::Argument {
                name: "what",
                found: format!("\"angle\" ({error})"),
                expected: "\"duration\"",
            },
        }
    }
}

impl From<SweepError> for Failure {
    fn from(error: SweepError) -> Self {
        match error {
            SweepError::Input(error) => Self::of_input(FileKind::Sweep)(error),
            error => Self::Sweep(error),
        }
    }
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        Self::Export(error)
    }
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        Self::NoOptimizer(error)
    }
}

impl From<ShapeError> for Failure {
    fn from(error: ShapeError) -> Self {
        Self::of_input(FileKind::Solution)(error.into())
    }
}
