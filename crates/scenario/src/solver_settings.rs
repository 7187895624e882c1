//! How a scenario is solved.

use std::time::Duration;

use crate::error::Error;
use crate::file::{self, Formulation, Guess, LinearSolverChoice, NamedGuess, Optimizer};
use crate::json::{Bounds, Location};

/// The most iterations the optimizer may be given.
pub const MAX_ITERATIONS: usize = 1_000_000;
/// The most low-discrepancy starts.
pub const MAX_STARTS: u64 = 1000;

const ITERATIONS: Bounds = Bounds::Whole(1.0, MAX_ITERATIONS as f64);
const TIME_LIMIT_S: Bounds = Bounds::Above(0.0, 1e6);
const TOLERANCE: Bounds = Bounds::Between(1e-14, 1e-2);

/// How to solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolverSettings {
    /// States of the optimal control problem.
    pub formulation: Formulation,
    /// Initial guess.
    pub guess: Guess,
    /// Who makes the iterations.
    pub optimizer: Optimizer,
    /// Linear solver inside the optimizer.
    pub linear_solver: LinearSolverChoice,
    /// Largest number of iterations.
    pub max_iterations: usize,
    /// Convergence tolerance.
    pub tolerance: f64,
    /// Wall time after which a plan is stopped.
    pub time_limit: Option<Duration>,
}

impl SolverSettings {
    /// Checks settings that were read from `place`, defaults filled in.
    pub(crate) fn from_file(
        solver: &file::Solver,
        place: &Location,
    ) -> Result<SolverSettings, Error> {
        let max_iterations = solver.max_iterations.unwrap_or(3000.0);
        let tolerance = solver.tolerance.unwrap_or(1e-8);
        if let Some(Guess::Starts(random)) = solver.guess
            && !(1..=MAX_STARTS).contains(&random.starts)
        {
            let allowed = format!("a whole number from 1 to {MAX_STARTS}");
            return Err(place.key("guess").key("starts").refuse(random.starts, allowed));
        }
        Ok(SolverSettings {
            formulation: solver.formulation.unwrap_or_default(),
            guess: solver.guess.unwrap_or(Guess::Named(NamedGuess::Auto)),
            optimizer: match solver.optimizer.unwrap_or_default() {
                Optimizer::Auto => Optimizer::Ipopt,
                named => named,
            },
            linear_solver: solver.linear_solver.unwrap_or_default(),
            max_iterations: place.key("max_iterations").within(max_iterations, ITERATIONS)?
                as usize,
            tolerance: place.key("tolerance").within(tolerance, TOLERANCE)?,
            time_limit: match solver.time_limit_s {
                Some(limit_s) => {
                    let limit_s = place.key("time_limit_s").within(limit_s, TIME_LIMIT_S)?;
                    Some(Duration::from_secs_f64(limit_s))
                }
                None => None,
            },
        })
    }

    /// Whether they ask for the paper's solve, which is made as it is: from its constant guess, in the units of
    /// the file, with limits at the nodes alone.
    pub fn is_paper(&self) -> bool {
        self.guess == Guess::Named(NamedGuess::Constant)
    }

    pub(crate) fn to_file(self) -> file::Solver {
        file::Solver {
            formulation: Some(self.formulation),
            guess: Some(self.guess),
            optimizer: Some(self.optimizer),
            linear_solver: Some(self.linear_solver),
            max_iterations: Some(self.max_iterations as f64),
            tolerance: Some(self.tolerance),
            time_limit_s: self.time_limit.map(|limit| limit.as_secs_f64()),
        }
    }
}
