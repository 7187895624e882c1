//! Stationary points that are no minimum, and the way out.

use righting_ocp::{Guess, OcpError, Settings, Solution};

use super::parallel::Batch;
use super::{SCREENED_SWINGS, Search, coarse_settings};
use crate::scenario::Maneuver;

/// Swings tried at a time.
const SWINGS: usize = 6;
/// How many times.
const ROUNDS: usize = 2;

/// Whether a solve ended where the Lagrangian curves downwards along the constraints: Ipopt adds to
/// the Hessian's diagonal exactly when the inertia of the linear system says so.
fn is_saddle(solution: &Solution) -> bool {
    solution.status.is_success()
        && solution.history.last().is_some_and(|last| last.regularization > 0.0)
}

impl Search<'_> {
    /// The plan itself if it is a minimum; otherwise a better one, reached from swings of the arm
    /// that break the symmetry. False beside it says that there was none.
    pub(crate) fn off_saddles(&mut self, plan: Solution) -> Result<(Solution, bool), OcpError> {
        // A cold solve that ends on its first point has not looked for a way down.
        let has_looked = plan.iterations() > 0 || self.rungs.len() > 1;
        if !plan.status.is_success() || (has_looked && !is_saddle(&plan)) {
            return Ok((plan, true));
        }
        for round in 0..ROUNDS {
            let mut coarse = self.downhill_of(&plan, round * SWINGS)?;
            coarse.sort_by(|a, b| a.objective.total_cmp(&b.objective));
            for start in coarse.into_iter().take(2) {
                if self.is_interrupted() {
                    return Ok((plan, false));
                }
                if let Some(found) = self.refined(start)?
                    && !is_saddle(&found)
                    && found.objective < plan.objective
                {
                    self.notes.push(format!(
                        "left a stationary point that is no minimum (objective {:.6e}) by \
                         swinging the arm",
                        plan.objective
                    ));
                    return Ok((found, true));
                }
            }
        }
        self.notes.push(
            "may be a stationary point that is no minimum: the objective curves downwards or not \
             at all in some direction, but no start found a better plan"
                .to_owned(),
        );
        Ok((plan, false))
    }

    /// Minima on the coarse grid with a smaller objective.
    fn downhill_of(&mut self, plan: &Solution, first: usize) -> Result<Vec<Solution>, OcpError> {
        let grid = self.coarse_grid()?;
        let model = self.scout.as_ref().unwrap_or(&self.model);
        let swings = model.swings(self.scenario, grid.steps());
        let cold = coarse_settings(self.scenario);
        let rolled: Vec<Guess> = match self.scenario.maneuver() {
            Maneuver::Detumble => swings.slowest(SCREENED_SWINGS, ROUNDS * SWINGS),
            Maneuver::Slew(_) => {
                let all = swings.from(0).take(ROUNDS * SWINGS);
                all.map(|swing| swings.rolled_out(swing)).collect()
            }
        };
        let starts: Vec<(Guess, Settings)> = rolled
            .into_iter()
            .skip(first)
            .take(SWINGS)
            .map(|swing| (swing, cold.clone()))
            .collect();
        let batch = Batch { model, grid, starts: &starts };
        let solutions = batch.solve(self.threads, self.on_iteration, &self.stop)?;
        self.rungs.extend(solutions.iter().map(|solution| super::rung(grid, solution)));
        let is_better = |solution: &Solution| {
            solution.status.is_success()
                && !is_saddle(solution)
                && solution.objective < plan.objective
        };
        Ok(solutions.into_iter().filter(is_better).collect())
    }
}
