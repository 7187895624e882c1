//! What a search leaves that may be a plan although it did not end with one: it was stopped, or gave up.

use righting_ocp::{OcpSolution, Samples};

use super::Search;

/// How many coarse solutions are looked at, the best first.
const MOST_COARSE: usize = 4;

/// A motion on the asked grid, in the states and controls of the asked form.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    /// N + 1 rows.
    pub(crate) states: Samples,
    /// N rows.
    pub(crate) controls: Samples,
}

impl Motion {
    pub(crate) fn of(solution: &OcpSolution) -> Self {
        Self { states: solution.states.clone(), controls: solution.controls.clone() }
    }

    fn is_finite(&self) -> bool {
        self.states.first_not_finite().is_none() && self.controls.first_not_finite().is_none()
    }
}

impl Search<'_> {
    /// Keeps where a solve on the asked grid ended, converged or not.
    pub(super) fn keep(&mut self, solution: &OcpSolution) {
        if solution.controls.len() == self.grid.steps() {
            self.kept.push(Motion::of(solution));
        }
    }

    /// The motions at which solves of the asked grid ended, `last` among them, then those that the best coarse
    /// solutions make. Each of the first comes a second time as its controls move it: with what an iterate
    /// leaves of its equations taken out.
    pub(super) fn incumbents(&self, last: &OcpSolution) -> Vec<Motion> {
        let mut motions = self.kept.clone();
        motions.push(Motion::of(last));
        let followed: Vec<Motion> = motions.iter().map(|motion| self.followed(motion)).collect();
        motions.extend(followed);
        // What is ranked may be the beginning of the horizon alone.
        if self.ranking.asked_steps == self.grid.steps() {
            let coarse = self.coarse.iter().take(MOST_COARSE);
            motions.extend(coarse.map(|solution| self.followed_on_asked_grid(solution)));
        }
        motions.retain(Motion::is_finite);
        motions
    }

    /// The motion that the controls make from the first state on.
    fn followed(&self, motion: &Motion) -> Motion {
        let guesses = self.model.initial_guesses(self.scenario, self.grid.steps());
        let mut guess = guesses.constant();
        guess.states.row_mut(0).copy_from_slice(motion.states.row(0));
        guess.controls = motion.controls.clone();
        let substeps = self.model.asked_functions().substeps().get();
        guesses.simulate(&mut guess, 0, guesses.step_s(), substeps);
        Motion { states: guess.states, controls: guess.controls }
    }

    /// The motion on the asked grid that the controls of a coarse solution make.
    fn followed_on_asked_grid(&self, coarse: &OcpSolution) -> Motion {
        let guesses = self.model.initial_guesses(self.scenario, self.grid.steps());
        let mut states = guesses.constant().states;
        let ranking = &self.ranking_model.as_ref().unwrap_or(&self.model).coordinates;
        if let (Some(here), Some(there)) = (self.model.coordinates.duration(), ranking.duration()) {
            states.row_mut(0)[here] = coarse.states.row(0)[there];
        }
        let controls = spread(&coarse.controls, self.grid.steps());
        self.followed(&Motion { states, controls })
    }
}

/// Controls held over coarse steps as controls held over `steps` finer ones: each the mean over its step, so
/// that the joints are as fast at the end.
fn spread(coarse: &Samples, steps: usize) -> Samples {
    let ratio = coarse.len() as f64 / steps as f64;
    let mut controls = Samples::new(coarse.width());
    for step in 0..steps {
        let (from, to) = (step as f64 * ratio, (step + 1) as f64 * ratio);
        let mut mean = vec![0.0; coarse.width()];
        for k in from.floor() as usize..(to.ceil() as usize).min(coarse.len()) {
            let share = (to.min((k + 1) as f64) - from.max(k as f64)) / ratio;
            mean.iter_mut().zip(coarse.row(k)).for_each(|(mean, u)| *mean += share * u);
        }
        controls.push(&mean);
    }
    controls
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finer_controls_move_the_joints_as_far() {
        let mut coarse = Samples::new(1);
        [1.0, -3.0, 4.0].iter().for_each(|u| coarse.push(&[*u]));
        for steps in [3, 4, 7, 12] {
            let fine = spread(&coarse, steps);
            assert_eq!(fine.len(), steps);
            let sum: f64 = fine.rows().map(|row| row[0]).sum();
            assert!((sum / steps as f64 - 2.0 / 3.0).abs() < 1e-12, "{steps}: {sum}");
        }
        assert_eq!(spread(&coarse, 6).row(3), [-3.0]);
    }
}
