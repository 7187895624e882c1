//! A long detumble of a fast spin: the arm moves in the beginning of the horizon and holds still in the rest.
//!
//! With the arm at rest about the axis of largest inertia the base turns evenly, so nothing is lost by waiting
//! there; and an optimizer does not get through hundreds of turns, over which everything that happens early
//! decides the last attitude.

use righting_ocp::{Curvature, OcpError, OcpSolution};

use super::Search;

/// So far may the base turn in a Runge–Kutta step while the arm holds still, rad: what is off adds up over
/// many turns.
const HOLD_TURN_RAD: f64 = 0.02;

impl Search<'_> {
    /// The coarse solution of the horizon's beginning carried to the steps and form asked for, and the arm
    /// held still in the rest of the horizon; none if that fails on the way.
    pub(super) fn held_after(
        &mut self,
        coarse: OcpSolution,
    ) -> Result<Option<OcpSolution>, OcpError> {
        let beginning = self.ranking.asked_grid(&self.grid)?;
        let Some(solution) = self.refined_to(beginning, coarse)? else { return Ok(None) };
        let solution = self.integrated_well(solution, beginning)?;
        let (solution, _) = self.hold_between_nodes(beginning, solution, true)?;
        let is_minimum = self.model.curvature(beginning, &solution)? == Curvature::Positive;
        if !solution.status.is_success() || !is_minimum {
            return Ok(None);
        }
        let guesses = self.model.initial_guesses(self.scenario, self.grid.steps());
        let mut motion = guesses.constant();
        let moved = beginning.steps();
        if moved == self.grid.steps() {
            return Ok(Some(solution));
        }
        for step in 0..moved {
            motion.states.row_mut(step + 1).copy_from_slice(solution.states.row(step + 1));
            motion.controls.row_mut(step).copy_from_slice(solution.controls.row(step));
        }
        // What is left of the joints' rates is stopped in what follows.
        let coordinates = &self.model.coordinates;
        let rates = coordinates.joint_rates(solution.states.row(moved));
        for (step, share) in coordinates.stop(self.grid.step_s()).iter().enumerate() {
            if moved + step == self.grid.steps() {
                return Ok(None);
            }
            let controls = motion.controls.row_mut(moved + step);
            controls.iter_mut().zip(rates).for_each(|(u, rate)| *u = share * rate);
        }
        let end = coordinates.free_floating_state(solution.states.row(moved));
        let turn_rad = end.angular_rate.norm() * self.grid.step_s();
        let substeps = ((turn_rad / HOLD_TURN_RAD).ceil() as usize).max(1);
        guesses.simulate(&mut motion, moved, guesses.step_s(), substeps);
        let asked = &self.scenario.resolved().horizon;
        let time_s = asked.duration_s.longest_s() * moved as f64 / asked.steps;
        self.notes.push(format!(
            "the arm moves in the first {time_s:.6} s and holds still in the rest: only the beginning is \
             optimized, as no longer motion turns the base slower"
        ));
        Ok(Some(OcpSolution { states: motion.states, controls: motion.controls, ..solution }))
    }
}
