//! The watchdog (W&B section 3.2; Chamberlain, Powell, Lemaréchal & Pedersen, *Mathematical
//! Programming Studies* 16, 1982): after enough shortened steps in a row full ones are taken for a
//! while, whatever they do to θ and φ. If none leads to a point that is acceptable to where it
//! began, the search goes back there.

use righting_nlp::{Options, Problem};

use crate::filter::ReferencePoint;
use crate::primal_point::PrimalPoint;
use crate::search_direction::SearchDirection;
use crate::state::State;

/// Counts shortened steps and keeps where the watchdog began.
#[derive(Debug, Default)]
pub(crate) struct Watchdog {
    /// Line searches in a row that did not accept their first trial point.
    shortened: u32,
    stored: Option<Box<StoredIterate>>,
}

/// Where the watchdog began, to go back to.
#[derive(Debug)]
struct StoredIterate {
    point: PrimalPoint,
    y: Vec<f64>,
    z: Vec<f64>,
    direction: SearchDirection,
    reference: ReferencePoint,
    /// Steps since.
    trials: u32,
}

impl Watchdog {
    /// Whether it is at work.
    pub(crate) fn is_active(&self) -> bool {
        self.stored.is_some()
    }

    /// What trial points are measured against while it is at work.
    pub(crate) fn reference(&self) -> Option<ReferencePoint> {
        self.stored.as_ref().map(|stored| stored.reference)
    }

    /// Starts it at this iterate if enough steps were shortened (option
    /// `watchdog_shortened_iter_trigger`) and it is not at work.
    pub(crate) fn start<P: Problem + ?Sized, L: ?Sized>(
        &mut self,
        state: &State<'_, P, L>,
        reference: ReferencePoint,
    ) {
        let trigger = state.options.watchdog_shortened_iter_trigger;
        if trigger > 0 && !self.is_active() && self.shortened >= trigger {
            self.stored = Some(Box::new(StoredIterate {
                point: state.iterate.point.clone(),
                y: state.iterate.y.clone(),
                z: state.iterate.z.clone(),
                direction: state.direction.clone(),
                reference,
                trials: 0,
            }));
        }
    }

    /// Whether it takes this step, whatever that does (option `watchdog_trial_iter_max`).
    pub(crate) fn takes_step(&mut self, options: &Options) -> bool {
        let most = options.watchdog_trial_iter_max;
        let Some(stored) = self.stored.as_mut().filter(|stored| stored.trials < most) else {
            return false;
        };
        stored.trials += 1;
        true
    }

    /// Ends it: a step was accepted.
    pub(crate) fn succeed(&mut self) {
        self.stored = None;
    }

    /// Back to where it began, if it had. Derivatives and factorisation stay those of the point
    /// that is left.
    pub(crate) fn restore<P: Problem + ?Sized, L: ?Sized>(
        &mut self,
        state: &mut State<'_, P, L>,
    ) -> Option<ReferencePoint> {
        let stored = *self.stored.take()?;
        let iterate = &mut state.iterate;
        (iterate.point, iterate.y, iterate.z) = (stored.point, stored.y, stored.z);
        state.direction = stored.direction;
        self.shortened = 0;
        Some(stored.reference)
    }

    /// Counts a line search that shortened its step so many times.
    pub(crate) fn count(&mut self, reductions: usize) {
        self.shortened = if reductions == 0 { 0 } else { self.shortened + 1 };
    }
}
