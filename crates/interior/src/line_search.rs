//! How far to go along a step. (Wächter & Biegler 2006, sections 2.3, 2.4 and 3.2.)

use righting_nlp::{LinearSolver, Problem};

use crate::barrier::{dual_step, primal_step};
use crate::filter::Reference;
use crate::method::Method;
use crate::point::{Point, Step};
use crate::{GivesUp, largest};

/// What a step is shortened by.
const REDUCTION: f64 = 0.5;
/// A correction must leave less than this of the violation for another one to be tried.
const KAPPA_SOC: f64 = 0.99;
/// Relative steps below this are as small as rounding errors …
const TINY_STEP: f64 = 10.0 * f64::EPSILON;
/// … where the constraints are satisfied to this.
const TINY_STEP_VIOLATION: f64 = 1e-4;
/// And those of the multipliers below this.
const TINY_STEP_OF_MULTIPLIERS: f64 = 1e-2;

/// The part of a step that was taken.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Taken {
    pub(crate) primal: f64,
    pub(crate) dual: f64,
    /// Step lengths tried.
    pub(crate) trials: usize,
}

/// Counts shortened steps, and after enough of them takes full ones for a while.
#[derive(Debug, Default)]
pub(crate) struct Watchdog {
    shortened: u32,
    origin: Option<Box<Origin>>,
}

/// Where the watchdog began, to go back to.
#[derive(Debug)]
struct Origin {
    point: Point,
    y: Vec<f64>,
    z: Vec<f64>,
    step: Step,
    reference: Reference,
    /// Steps since.
    steps: u32,
}

impl Watchdog {
    /// Whether it is at work and takes this step whatever it does; at most so many.
    fn goes_on(&mut self, most: u32) -> bool {
        let Some(origin) = self.origin.as_mut().filter(|origin| origin.steps < most) else {
            return false;
        };
        origin.steps += 1;
        true
    }
}

/// How to backtrack.
struct Backtracking {
    reference: Reference,
    /// Whether the full step has been tried.
    skips_first: bool,
    /// Whether the factorisation is that of the point, which corrections solve with.
    may_correct: bool,
}

/// How it ended.
enum Backtracked {
    Accepted(f64),
    /// Not accepted; the last step length tried.
    Rejected(f64),
    /// A function was not defined at the last point tried.
    Undefined,
}

impl<P, L> Method<'_, P, L>
where
    P: Problem + ?Sized,
    L: LinearSolver + ?Sized,
{
    /// Leaves the point to go on from as the trial point, with its multipliers in place.
    pub(crate) fn line_search(&mut self) -> Result<Taken, GivesUp> {
        let mut search = if self.is_tiny() {
            let Some(reference) = self.return_to_origin() else { return self.take_tiny_step() };
            Backtracking { reference, skips_first: false, may_correct: false }
        } else {
            let origin = self.watchdog.origin.as_ref();
            let reference = origin.map_or_else(|| self.reference(), |origin| origin.reference);
            Backtracking { reference, skips_first: false, may_correct: true }
        };
        self.was_tiny = false;
        self.start_watchdog(search.reference);
        let mut shortened = 0;
        let primal = loop {
            match self.backtrack(&search, &mut shortened)? {
                Backtracked::Accepted(length) => {
                    self.watchdog.origin = None;
                    break length;
                }
                Backtracked::Rejected(length)
                    if self.watchdog.goes_on(self.options.watchdog_trial_iter_max) =>
                {
                    break length;
                }
                Backtracked::Rejected(_) | Backtracked::Undefined => {
                    let reference = self.return_to_origin().ok_or(GivesUp::NeedsRestoration)?;
                    search = Backtracking { reference, skips_first: true, may_correct: false };
                }
            }
        };
        self.watchdog.shortened = if shortened == 0 { 0 } else { self.watchdog.shortened + 1 };
        Ok(self.step_multipliers(primal, shortened + 1))
    }

    /// Starts the watchdog here if enough steps were shortened and it is not at work.
    fn start_watchdog(&mut self, reference: Reference) {
        let trigger = self.options.watchdog_shortened_iter_trigger;
        if trigger > 0 && self.watchdog.origin.is_none() && self.watchdog.shortened >= trigger {
            self.watchdog.origin = Some(Box::new(Origin {
                point: self.point.clone(),
                y: self.y.clone(),
                z: self.z.clone(),
                step: self.step.clone(),
                reference,
                steps: 0,
            }));
        }
    }

    /// Goes along the step without looking at what that does to the functions.
    fn take_tiny_step(&mut self) -> Result<Taken, GivesUp> {
        let length = self.longest_step();
        if self.was_tiny || !self.try_step(length)? {
            return Err(GivesUp::TinySteps);
        }
        self.was_tiny = largest(&self.step.y) < TINY_STEP_OF_MULTIPLIERS;
        self.watchdog.shortened = 0;
        Ok(self.step_multipliers(length, 0))
    }

    fn step_multipliers(&mut self, primal: f64, trials: usize) -> Taken {
        let dual = dual_step(&self.z, &self.step.z, self.tau);
        let Self { y, z, step, .. } = self;
        y.iter_mut().zip(&step.y).for_each(|(y, dy)| *y += primal * dy);
        z.iter_mut().zip(&step.z).for_each(|(z, dz)| *z += dual * dz);
        Taken { primal, dual, trials }
    }

    fn reference(&self) -> Reference {
        Reference { merit: self.point.merit(self.mu), slope: self.slope() }
    }

    /// Whether the step is lost in the rounding of the variables.
    fn is_tiny(&self) -> bool {
        let relative = |(step, w): (&f64, &f64)| step.abs() <= TINY_STEP * (1.0 + w.abs());
        self.point.violation <= TINY_STEP_VIOLATION
            && self.step.w.iter().zip(&self.point.w).all(relative)
    }

    /// Back to where the watchdog began, if it had. Derivatives and factorisation stay those of the
    /// point that is left.
    fn return_to_origin(&mut self) -> Option<Reference> {
        let origin = self.watchdog.origin.take()?;
        (self.point, self.y, self.z, self.step) = (origin.point, origin.y, origin.z, origin.step);
        self.watchdog.shortened = 0;
        Some(origin.reference)
    }

    fn backtrack(
        &mut self,
        search: &Backtracking,
        shortened: &mut usize,
    ) -> Result<Backtracked, GivesUp> {
        let Backtracking { reference, skips_first, may_correct } = search;
        let watches = self.watchdog.origin.is_some();
        let longest = self.longest_step();
        let least = if watches { longest } else { self.filter.least_step(reference) };
        let mut length = if *skips_first { REDUCTION * longest } else { longest };
        let mut is_defined = true;
        while length > least || *shortened == 0 {
            is_defined = self.try_step(length)?;
            if is_defined {
                let merit = self.trial.merit(self.mu);
                let forced = usize::try_from(self.options.accept_after_max_steps)
                    .is_ok_and(|most| *shortened >= most);
                if forced {
                    self.filter.reset();
                }
                if forced || self.filter.accepts(reference, length, &merit) {
                    self.filter.step_taken(reference, length, &merit);
                    return Ok(Backtracked::Accepted(length));
                }
            }
            if watches {
                break;
            }
            let increases = is_defined && self.trial.violation >= self.point.violation;
            if increases
                && *may_correct
                && length == longest
                && let Some(corrected) = self.correct(reference, length)?
            {
                return Ok(Backtracked::Accepted(corrected));
            }
            length *= REDUCTION;
            *shortened += 1;
        }
        Ok(if is_defined { Backtracked::Rejected(length) } else { Backtracked::Undefined })
    }

    /// Second-order corrections of the first trial step; the length of the one that is accepted.
    fn correct(&mut self, reference: &Reference, tested: f64) -> Result<Option<f64>, GivesUp> {
        if self.options.max_soc == 0 {
            return Ok(None);
        }
        let step = self.step.clone();
        let mut residuals = self.point.residuals.clone();
        let mut length = tested;
        let mut violation_before = f64::INFINITY;
        for _ in 0..self.options.max_soc {
            if self.trial.violation > KAPPA_SOC * violation_before {
                break;
            }
            violation_before = self.trial.violation;
            for (c, trial) in residuals.iter_mut().zip(&self.trial.residuals) {
                *c = trial + length * *c;
            }
            self.solve_for_step(&residuals);
            length = self.longest_step();
            if !self.step.is_finite() || !self.try_step(length)? {
                break;
            }
            let merit = self.trial.merit(self.mu);
            if self.filter.accepts(reference, tested, &merit) {
                self.filter.step_taken(reference, tested, &merit);
                return Ok(Some(length));
            }
        }
        self.step = step;
        Ok(None)
    }

    fn longest_step(&self) -> f64 {
        primal_step(&self.program.bounds, &self.point.distances, &self.step.w, self.tau)
    }

    /// Evaluates the functions so far along the step; false where one is not defined.
    fn try_step(&mut self, length: f64) -> Result<bool, GivesUp> {
        let Self { trial, point, step, .. } = self;
        for ((trial, w), dw) in trial.w.iter_mut().zip(&point.w).zip(&step.w) {
            *trial = w + length * dw;
        }
        match trial.evaluate(&mut self.program, &self.z, self.mu) {
            Ok(()) => Ok(true),
            Err(GivesUp::Undefined) => Ok(false),
            Err(other) => Err(other),
        }
    }
}
