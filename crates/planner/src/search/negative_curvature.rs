//! Stationary points that are no minimum, and the direction of negative curvature that leads out.

use righting_ocp::{Curvature, InitialGuess, OcpError, OcpSolution, Samples, Settings};

use super::{Search, portfolio, settings};
use crate::formulation::Coordinates;
use crate::initial_guess::InitialGuesses;

/// Guesses tried at a time.
const GUESSES: usize = 6;
/// How many times.
const ROUNDS: usize = 2;
/// How many of the better coarse solutions of a round are refined.
const REFINED: usize = 2;
/// How far the first step along a direction of negative curvature takes the joint that moves most, rad.
const FIRST_STEP_RAD: f64 = 0.5;

impl Search<'_> {
    /// The solution itself if it is a minimum; otherwise a better one, reached along the direction in
    /// which the Lagrangian curves downwards, or from other guesses. False beside it says that there
    /// was none.
    pub(super) fn leave_saddle(
        &mut self,
        solution: OcpSolution,
    ) -> Result<(OcpSolution, bool), OcpError> {
        if !solution.status.is_success() {
            return Ok((solution, true));
        }
        let direction = match self.model.curvature(self.grid, &solution)? {
            Curvature::Positive => return Ok((solution, true)),
            Curvature::Negative { direction } => Some(direction),
            Curvature::Zero => None,
        };
        for round in 0..ROUNDS {
            let direction = direction.as_ref().filter(|_| round == 0);
            let mut coarse = self.better_coarse_solutions(&solution, direction, round * GUESSES)?;
            coarse.sort_by(|a, b| a.objective.total_cmp(&b.objective));
            for start in coarse.into_iter().take(REFINED) {
                if self.is_interrupted() {
                    return Ok((solution, false));
                }
                if let Some(found) = self.refined(start)?
                    && found.objective < solution.objective
                    && self.model.curvature(self.grid, &found)? == Curvature::Positive
                {
                    self.notes.push(format!(
                        "left a stationary point that is no minimum (objective {:.6e}) by moving \
                         the arm",
                        solution.objective
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
        Ok((solution, false))
    }

    /// Solutions on the coarse grid with a smaller objective.
    fn better_coarse_solutions(
        &mut self,
        saddle: &OcpSolution,
        direction: Option<&Samples>,
        first: usize,
    ) -> Result<Vec<OcpSolution>, OcpError> {
        let grid = self.ranking.grid(&self.grid)?;
        let model = self.ranking_model.as_ref().unwrap_or(&self.model);
        let guesses = model.initial_guesses(&self.ranked, grid.steps());
        let asked_steps = self.ranking.asked_steps;
        let cold = settings::coarse(self.scenario);
        let others = portfolio::guesses_beside_saddle(&self.ranked, &guesses, ROUNDS * GUESSES);
        let starts: Vec<(InitialGuess, Settings)> = direction
            .into_iter()
            .flat_map(|direction| {
                [1.0, -1.0].map(|sign| displaced(&guesses, saddle, direction, asked_steps, sign))
            })
            .chain(others.into_iter().skip(first).take(GUESSES))
            .map(|start| (start, cold.clone()))
            .collect();
        let mut solutions = self.converged(grid, starts)?;
        solutions.retain(|solution| solution.objective < saddle.objective);
        Ok(solutions)
    }
}

/// The first steps of a plan with its controls changed along `direction`, one way or the other.
fn displaced(
    guesses: &InitialGuesses<'_>,
    plan: &OcpSolution,
    direction: &Samples,
    asked_steps: usize,
    sign: f64,
) -> InitialGuess {
    let mut guess = guesses.constant();
    let steps = guess.controls.len();
    let change = averaged(direction, asked_steps, steps);
    let step_s = guesses.scenario.horizon().duration_s / steps as f64;
    let share = sign * FIRST_STEP_RAD / largest_turn(guesses.coordinates, &change, step_s);
    guess.controls = averaged(&plan.controls, asked_steps, steps);
    for step in 0..steps {
        let controls = guess.controls.row_mut(step);
        controls.iter_mut().zip(change.row(step)).for_each(|(u, change)| *u += share * change);
    }
    guesses.simulated(guess)
}

/// The first `fine_steps` controls on a coarser grid: means over its steps.
fn averaged(controls: &Samples, fine_steps: usize, steps: usize) -> Samples {
    let mut means = Samples::new(controls.width());
    for step in 0..steps {
        let fine = step * fine_steps / steps..(step + 1) * fine_steps / steps;
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
fn largest_turn(coordinates: &Coordinates, controls: &Samples, step_s: f64) -> f64 {
    let mut x = vec![0.0; coordinates.dimension()];
    let mut largest: f64 = 0.0;
    for row in controls.rows() {
        coordinates.move_driven(&mut x, row, step_s);
        let turned = coordinates.joint_angles(&x).iter().map(|angle| angle.abs());
        largest = largest.max(turned.fold(0.0, f64::max));
    }
    largest
}
