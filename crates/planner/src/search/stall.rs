//! Solves that get nowhere: they are given up by progress, not after thousands of iterations.

use righting_ocp::Control;
use righting_results::IterationRecord;

/// So many iterations in a row may pass without progress.
const PATIENCE: usize = 120;
/// Progress is an error, or an objective, smaller by this share.
const SHARE: f64 = 0.05;
const OBJECTIVE_SHARE: f64 = 1e-5;

/// What was best so far, by which progress is told.
#[derive(Debug)]
pub(super) struct StallCheck {
    primal: f64,
    dual: f64,
    objective: f64,
    barrier: f64,
    progressed_at: usize,
}

impl Default for StallCheck {
    fn default() -> Self {
        let infinite = f64::INFINITY;
        Self {
            primal: infinite,
            dual: infinite,
            objective: infinite,
            barrier: infinite,
            progressed_at: 0,
        }
    }
}

impl StallCheck {
    /// Shows an iteration to `on_iteration`, and says whether both want to go on.
    pub(super) fn watched(
        &mut self,
        record: IterationRecord,
        on_iteration: &mut impl FnMut(IterationRecord) -> Control,
    ) -> Control {
        match (self.after(&record), on_iteration(record)) {
            (Control::Continue, Control::Continue) => Control::Continue,
            _ => Control::Stop,
        }
    }

    /// Whether to go on after an iteration. A new solve begins with iteration 0.
    pub(super) fn after(&mut self, record: &IterationRecord) -> Control {
        if record.iteration == 0 {
            *self = Self::default();
        }
        let mut has_progressed = false;
        let mut lower = |best: &mut f64, value: f64, by: f64| {
            if value < *best - by * best.abs().min(f64::MAX) {
                *best = value;
                has_progressed = true;
            }
        };
        lower(&mut self.primal, record.primal_infeasibility, SHARE);
        lower(&mut self.dual, record.dual_infeasibility, SHARE);
        lower(&mut self.objective, record.objective, OBJECTIVE_SHARE);
        lower(&mut self.barrier, record.barrier_parameter, SHARE);
        if has_progressed {
            self.progressed_at = record.iteration;
        }
        match record.iteration - self.progressed_at > PATIENCE {
            true => Control::Stop,
            false => Control::Continue,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(iteration: usize, objective: f64, dual_infeasibility: f64) -> IterationRecord {
        IterationRecord {
            iteration,
            objective,
            primal_infeasibility: 1e-9,
            dual_infeasibility,
            barrier_parameter: 1e-6,
            primal_step: 1.0,
            dual_step: 1.0,
        }
    }

    #[test]
    fn a_solve_that_improves_slowly_goes_on() {
        let mut check = StallCheck::default();
        for iteration in 0..2000 {
            let objective = 1.0 + (-(iteration as f64) / 500.0).exp();
            assert_eq!(check.after(&record(iteration, objective, 1.0)), Control::Continue);
        }
    }

    #[test]
    fn a_solve_that_wanders_is_given_up_and_the_next_begins_anew() {
        let mut check = StallCheck::default();
        let ended = (0..2000).find(|&iteration| {
            let wandering = 1.0 + 0.1 * (iteration as f64).sin();
            check.after(&record(iteration, wandering, 1.0 + wandering)) == Control::Stop
        });
        assert!(ended.is_some_and(|ended| ended > PATIENCE && ended < PATIENCE + 60), "{ended:?}");
        assert_eq!(check.after(&record(0, 5.0, 5.0)), Control::Continue);
    }
}
