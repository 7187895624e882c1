//! Stationary points that are no minimum, and the way out.

use righting_ocp::{Curvature, Guess, OcpError, Samples, Settings, Solution};

use super::parallel::Batch;
use super::{SCREENED_SWINGS, Search, coarse_settings};
use crate::starts::Swings;
use righting_scenario::scenario::Maneuver;

/// Swings tried at a time.
const SWINGS: usize = 6;
/// How many times.
const ROUNDS: usize = 2;
/// How far the first step along a direction of negative curvature takes the joint that moves most, rad.
const WAY_DOWN_RAD: f64 = 0.5;

impl Search<'_> {
    /// The plan itself if it is a minimum; otherwise a better one, reached along the direction in
    /// which the Lagrangian curves downwards, or from swings of the arm that break the symmetry.
    /// False beside it says that there was none.
    pub(crate) fn off_saddles(&mut self, plan: Solution) -> Result<(Solution, bool), OcpError> {
        if !plan.status.is_success() {
            return Ok((plan, true));
        }
        let way_down = match self.model.curvature(self.grid, &plan)? {
            Curvature::Upward => return Ok((plan, true)),
            Curvature::Downward { controls } => Some(controls),
            Curvature::Flat => None,
        };
        for round in 0..ROUNDS {
            let way_down = way_down.as_ref().filter(|_| round == 0);
            let mut coarse = self.downhill_of(&plan, way_down, round * SWINGS)?;
            coarse.sort_by(|a, b| a.objective.total_cmp(&b.objective));
            for start in coarse.into_iter().take(2) {
                if self.is_interrupted() {
                    return Ok((plan, false));
                }
                if let Some(found) = self.refined(start)?
                    && found.objective < plan.objective
                    && self.model.curvature(self.grid, &found)? == Curvature::Upward
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

    /// Solutions on the coarse grid with a smaller objective.
    fn downhill_of(
        &mut self,
        plan: &Solution,
        way_down: Option<&Samples>,
        first: usize,
    ) -> Result<Vec<Solution>, OcpError> {
        let grid = self.coarse_grid()?;
        let model = self.scout.as_ref().unwrap_or(&self.model);
        let swings = model.swings(self.scenario, grid.steps());
        let cold = coarse_settings(self.scenario);
        let swung: Vec<Guess> = match self.scenario.maneuver() {
            Maneuver::Detumble => swings.slowest(SCREENED_SWINGS, ROUNDS * SWINGS),
            Maneuver::Slew(_) => {
                let all = swings.from(0).take(ROUNDS * SWINGS);
                all.map(|swing| swings.rolled_out(swing)).collect()
            }
        };
        let starts: Vec<(Guess, Settings)> = way_down
            .into_iter()
            .flat_map(|way| [1.0, -1.0].map(|sign| displaced(&swings, plan, way, sign)))
            .chain(swung.into_iter().skip(first).take(SWINGS))
            .map(|start| (start, cold.clone()))
            .collect();
        let batch = Batch { model, grid, starts: &starts };
        let mut solutions = batch.solve(self.threads, self.on_iteration, &self.stop)?;
        for solution in &mut solutions {
            self.attempts.append(&mut solution.attempts);
        }
        let is_better = |solution: &Solution| {
            solution.status.is_success() && solution.objective < plan.objective
        };
        Ok(solutions.into_iter().filter(is_better).collect())
    }
}

/// The motion of a plan with its controls changed along `way`, one way or the other.
fn displaced(swings: &Swings<'_>, plan: &Solution, way: &Samples, sign: f64) -> Guess {
    let mut guess = swings.constant();
    let steps = guess.controls.len();
    let change = averaged(way, steps);
    let step_s = swings.scenario.horizon().duration_s / steps as f64;
    let share = sign * WAY_DOWN_RAD / largest_turn(&change, step_s);
    guess.controls = averaged(&plan.controls, steps);
    for step in 0..steps {
        let controls = guess.controls.row_mut(step);
        controls.iter_mut().zip(change.row(step)).for_each(|(u, change)| *u += share * change);
    }
    swings.rolled_out(guess)
}

/// Controls on a coarser grid: means over its steps.
fn averaged(controls: &Samples, steps: usize) -> Samples {
    let mut means = Samples::new(controls.width());
    for step in 0..steps {
        let fine = step * controls.len() / steps..(step + 1) * controls.len() / steps;
        let share = 1.0 / fine.len() as f64;
        let mut mean = vec![0.0; controls.width()];
        for k in fine {
            mean.iter_mut().zip(controls.row(k)).for_each(|(mean, u)| *mean += share * u);
        }
        means.push(&mean);
    }
    means
}

/// How far these controls turn the joint that they turn most, from rest, rad.
fn largest_turn(controls: &Samples, step_s: f64) -> f64 {
    let (mut angles, mut rates) = (vec![0.0; controls.width()], vec![0.0; controls.width()]);
    let mut largest: f64 = 0.0;
    for row in controls.rows() {
        for ((angle, rate), u) in angles.iter_mut().zip(&mut rates).zip(row) {
            *angle += step_s * (*rate + 0.5 * step_s * u);
            *rate += step_s * u;
            largest = largest.max(angle.abs());
        }
    }
    largest
}
