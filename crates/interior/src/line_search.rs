//! The backtracking line search (W&B section 2.3, step A-5, with the heuristics of sections 3.2 and
//! 3.9).

use righting_nlp::{LinearSolver, Problem};

use crate::barrier::longest_dual_step;
use crate::error::FailureReason;
use crate::filter::{Filter, ReferencePoint};
use crate::norm::max_norm;
use crate::primal_point::PrimalPoint;
use crate::second_order_correction::correct;
use crate::state::State;
use crate::watchdog::Watchdog;

/// What a step is shortened by (step; option `alpha_red_factor`).
const REDUCTION: f64 = 0.5;
/// Relative steps below this are as small as rounding errors (W&B section 3.9; option
/// `tiny_step_tol`) …
const TINY_STEP: f64 = 10.0 * f64::EPSILON;
/// … and those of the multipliers below this (option `tiny_step_y_tol`).
const TINY_STEP_OF_MULTIPLIERS: f64 = 1e-2;

/// The part of a direction that was taken.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepLengths {
    /// α, of w and y.
    pub(crate) primal: f64,
    /// α_z, of z.
    pub(crate) dual: f64,
    /// Step lengths tried.
    pub(crate) trials: usize,
}

impl StepLengths {
    /// Before the first step.
    pub(crate) const NONE: Self = Self { primal: 0.0, dual: 0.0, trials: 0 };
}

/// What the line search remembers from step to step.
#[derive(Debug)]
pub(crate) struct LineSearch {
    filter: Filter,
    watchdog: Watchdog,
    trial: PrimalPoint,
    /// Whether the last step was as small as rounding errors.
    was_tiny: bool,
}

/// How to backtrack.
struct Backtracking {
    reference: ReferencePoint,
    /// Whether the full step has been tried.
    skips_first: bool,
    /// Whether the factorisation is that of the iterate, which corrections solve with.
    may_correct: bool,
}

/// How it ended.
enum Outcome {
    Accepted(f64),
    /// Not accepted; the last step length tried.
    Rejected(f64),
    /// A function was not defined at the last point tried.
    Undefined,
}

impl LineSearch {
    pub(crate) fn new(point: &PrimalPoint) -> Self {
        Self {
            filter: Filter::default(),
            watchdog: Watchdog::default(),
            trial: point.clone(),
            was_tiny: false,
        }
    }

    /// Forgets what belongs to the last barrier problem (step A-3).
    pub(crate) fn reset(&mut self) {
        self.filter.reset();
        self.watchdog = Watchdog::default();
    }

    /// Moves the iterate along its direction; its derivatives stay behind.
    pub(crate) fn search<P, L>(
        &mut self,
        state: &mut State<'_, P, L>,
    ) -> Result<StepLengths, FailureReason>
    where
        P: Problem + ?Sized,
        L: LinearSolver + ?Sized,
    {
        let mut search = if is_tiny(state) {
            let Some(reference) = self.watchdog.restore(state) else {
                return self.take_tiny_step(state);
            };
            Backtracking { reference, skips_first: false, may_correct: false }
        } else {
            let reference = self.watchdog.reference().unwrap_or_else(|| state.reference());
            Backtracking { reference, skips_first: false, may_correct: true }
        };
        self.was_tiny = false;
        self.watchdog.start(state, search.reference);
        let mut reductions = 0;
        let length = loop {
            match self.backtrack(state, &search, &mut reductions)? {
                Outcome::Accepted(length) => {
                    self.watchdog.succeed();
                    break length;
                }
                Outcome::Rejected(length) if self.watchdog.takes_step(state.options) => {
                    break length;
                }
                Outcome::Rejected(_) | Outcome::Undefined => {
                    let reference =
                        self.watchdog.restore(state).ok_or(FailureReason::RestorationNeeded)?;
                    search = Backtracking { reference, skips_first: true, may_correct: false };
                }
            }
        };
        self.watchdog.count(reductions);
        Ok(self.accept(state, length, reductions + 1))
    }

    /// Goes along the direction without looking at what that does to the functions.
    fn take_tiny_step<P: Problem + ?Sized, L: ?Sized>(
        &mut self,
        state: &mut State<'_, P, L>,
    ) -> Result<StepLengths, FailureReason> {
        let length = state.longest_step();
        if self.was_tiny || !state.try_step(length, &mut self.trial)? {
            return Err(FailureReason::TinySteps);
        }
        self.was_tiny = max_norm(&state.direction.y) < TINY_STEP_OF_MULTIPLIERS;
        self.watchdog.count(0);
        Ok(self.accept(state, length, 0))
    }

    /// Makes the trial point and its multipliers the iterate (W&B eq. 14).
    fn accept<P: Problem + ?Sized, L: ?Sized>(
        &mut self,
        state: &mut State<'_, P, L>,
        primal: f64,
        trials: usize,
    ) -> StepLengths {
        let State { iterate, direction, barrier, .. } = state;
        let dual = longest_dual_step(&iterate.z, &direction.z, barrier.tau);
        iterate.y.iter_mut().zip(&direction.y).for_each(|(y, dy)| *y += primal * dy);
        iterate.z.iter_mut().zip(&direction.z).for_each(|(z, dz)| *z += dual * dz);
        std::mem::swap(&mut iterate.point, &mut self.trial);
        StepLengths { primal, dual, trials }
    }

    fn backtrack<P, L>(
        &mut self,
        state: &mut State<'_, P, L>,
        search: &Backtracking,
        reductions: &mut usize,
    ) -> Result<Outcome, FailureReason>
    where
        P: Problem + ?Sized,
        L: LinearSolver + ?Sized,
    {
        let Backtracking { reference, skips_first, may_correct } = search;
        let Self { filter, watchdog, trial, .. } = self;
        let longest = state.longest_step();
        let least = if watchdog.is_active() { longest } else { filter.least_step(reference) };
        let mut length = if *skips_first { REDUCTION * longest } else { longest };
        let mut is_defined = true;
        while length > least || *reductions == 0 {
            is_defined = state.try_step(length, trial)?;
            if is_defined {
                let measures = trial.measures(state.barrier.mu);
                let forced = usize::try_from(state.options.accept_after_max_steps)
                    .is_ok_and(|most| *reductions >= most);
                if forced {
                    // The filter may forbid this point, and with it all that come after.
                    filter.reset();
                }
                if forced || filter.accepts(reference, length, &measures) {
                    filter.augment(reference, length, &measures);
                    return Ok(Outcome::Accepted(length));
                }
            }
            if watchdog.is_active() {
                break;
            }
            let increases = is_defined && trial.violation >= state.iterate.point.violation;
            if increases
                && *may_correct
                && length == longest
                && let Some(corrected) = correct(state, trial, filter, reference, length)?
            {
                return Ok(Outcome::Accepted(corrected));
            }
            length *= REDUCTION;
            *reductions += 1;
        }
        Ok(if is_defined { Outcome::Rejected(length) } else { Outcome::Undefined })
    }
}

/// Whether the direction is lost in the rounding of the variables, at a point that the termination
/// test would call feasible (option `constr_viol_tol`). At any other a direction that does not
/// reduce the violation is nothing to accept unseen.
fn is_tiny<P: Problem + ?Sized, L: ?Sized>(state: &State<'_, P, L>) -> bool {
    let point = &state.iterate.point;
    let relative = |(step, w): (&f64, &f64)| step.abs() <= TINY_STEP * (1.0 + w.abs());
    point.violation <= state.options.constr_viol_tol
        && state.direction.w.iter().zip(&point.w).all(relative)
}
