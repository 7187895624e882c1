//! Solving again where a solution passes its limits between the nodes.

use righting_ocp::{Grid, InitialGuess, OcpError, OcpSolution, close_guess_settings};

use super::model::Model;
use super::{Search, compiled, settings, stoppable};
use crate::between_nodes::{PassedLimits, passed_limits};
use crate::formulation::StageLimits;

/// How often limits are added, at most.
const ROUNDS: usize = 4;
/// Parts of a step between which a clearance or a cone is stated, at most.
const MOST_PARTS: usize = 24;
/// Parts of a step at whose ends loads are stated, at most.
const MOST_LOAD_PARTS: usize = 8;
/// How many coarse solutions are tried in place of one in which things go through each other.
const MOST_CANDIDATES: usize = 4;
/// Iterations after which a solve that goes on from a solution is given up.
const MOST_ITERATIONS: u32 = 200;

impl Search<'_> {
    /// A solution on `grid`, the asked one or its beginning: itself if its motion keeps the limits between
    /// the nodes too; otherwise one of the problem that states those it passes within the steps as well, or
    /// the solution all the same if there is none.
    pub(super) fn hold_between_nodes(
        &mut self,
        grid: Grid,
        solution: OcpSolution,
        is_minimum: bool,
    ) -> Result<(OcpSolution, bool), OcpError> {
        let (mut solution, mut is_minimum) = (solution, is_minimum);
        // The paper states its limits at the nodes.
        if self.scenario.solver().is_paper() {
            return Ok((solution, is_minimum));
        }
        let mut passed = self.passed_limits(&solution);
        for _ in 0..ROUNDS {
            let is_done = passed.is_empty() || !solution.status.is_success();
            if is_done || self.is_interrupted() || !self.state_within_steps(&passed) {
                break;
            }
            self.compile_again()?;
            match self.solved_again(grid, &solution, passed.is_crossing())? {
                Some(again) => {
                    solution = self.integrated_well(again, grid)?;
                    if grid == self.grid {
                        (solution, is_minimum) = self.leave_saddle(solution)?;
                    }
                }
                // The same limits are stated at more places.
                None => continue,
            }
            passed = self.passed_limits(&solution);
        }
        if !self.stage_limits.is_as_asked() {
            let stated = self.stated_within_steps();
            self.notes.push(match passed.is_empty() {
                true => format!(
                    "limits that the nodes alone did not keep are stated within the steps too: \
                     {stated}"
                ),
                false => format!(
                    "passes limits between its nodes, and no plan was found that keeps them: \
                     {stated}"
                ),
            });
        }
        Ok((solution, is_minimum))
    }

    pub(super) fn passed_limits(&self, solution: &OcpSolution) -> PassedLimits {
        self.passed_by(&self.model, self.grid, solution)
    }

    /// What a solution of a model passes between the nodes of its grid.
    fn passed_by(&self, model: &Model, grid: Grid, solution: &OcpSolution) -> PassedLimits {
        let joint_limits = &self.scenario.system().joint_limits;
        let OcpSolution { states, controls, .. } = solution;
        let Model { coordinates, .. } = model;
        let step_s = grid.step_s() * coordinates.duration_share(states.row(0));
        let kept = (&self.clearances, &self.loads, &self.cones);
        passed_limits(joint_limits, kept, coordinates, states, controls, step_s)
    }

    /// Adds limits; false if that changes nothing. Whoever is passed again is stated at more places.
    fn state_within_steps(&mut self, passed: &PassedLimits) -> bool {
        let before = self.stage_limits.clone();
        let limits = &mut self.stage_limits;
        // What is kept from one joint may be taken from another: no third time.
        let every = !limits.joints.is_empty() && !passed.joints.is_empty();
        for (joint, of_joint) in self.scenario.system().joint_limits.iter().enumerate() {
            let has_limit = (of_joint.angle_min_rad.is_finite()
                || of_joint.angle_max_rad.is_finite())
                && !self.model.coordinates.is_locked(joint);
            if passed.joints.contains(&joint) || every && has_limit {
                limits.joints.insert(joint, StageLimits::curves(of_joint, self.grid.step_s()));
            }
        }
        for (&place, passed) in &passed.clearances {
            let stated = limits.clearances.entry(place).or_insert(1);
            *stated = passed.parts.max(2 * *stated).min(MOST_PARTS);
        }
        for (&place, passed) in &passed.cones {
            let stated = limits.cones.entry(place).or_insert(1);
            *stated = passed.parts.max(2 * *stated).min(MOST_PARTS);
        }
        if passed.has_load {
            limits.load_parts = (2 * limits.load_parts).min(MOST_LOAD_PARTS);
        }
        *limits != before
    }

    fn compile_again(&mut self) -> Result<(), OcpError> {
        let substeps = self.model.asked_functions().substeps();
        let is_ranked_apart = self.ranking_model.is_some();
        (self.model, self.ranking_model) =
            compiled(self.scenario, self.ranking, &self.stage_limits, substeps, is_ranked_apart)?;
        Ok(())
    }

    /// From the solution that passes limits, and where that does not converge from others. Where things go
    /// through each other the other way around: no small change parts them, and no gradient says where
    /// to.
    fn solved_again(
        &mut self,
        grid: Grid,
        solution: &OcpSolution,
        is_crossing: bool,
    ) -> Result<Option<OcpSolution>, OcpError> {
        for from_others in [is_crossing, !is_crossing] {
            let again = match from_others {
                true => self.restarted_from_others(grid)?,
                false => self.continued_from(grid, solution)?,
            };
            if again.is_some() || self.is_interrupted() {
                return Ok(again);
            }
        }
        Ok(None)
    }

    fn continued_from(
        &mut self,
        grid: Grid,
        solution: &OcpSolution,
    ) -> Result<Option<OcpSolution>, OcpError> {
        let guess =
            InitialGuess { states: solution.states.clone(), controls: solution.controls.clone() };
        let mut settings = close_guess_settings(&settings::delivered(self.scenario));
        settings.ipopt.max_iterations = settings.ipopt.max_iterations.min(MOST_ITERATIONS);
        settings.retry_at_iteration_limit = false;
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut again = self.model.solve(grid, guess, &settings, on_iteration)?;
        self.attempts.append(&mut again.attempts);
        self.keep(&again);
        Ok(again.status.is_success().then_some(again))
    }

    /// From the solutions that the initial guesses led to on the coarse grid.
    fn restarted_from_others(&mut self, grid: Grid) -> Result<Option<OcpSolution>, OcpError> {
        let coarse = self.ranking.grid(&self.grid)?;
        let mut candidates: Vec<(bool, OcpSolution)> =
            self.coarse.iter().map(|s| (self.is_crossing(coarse, s), s.clone())).collect();
        // Sorted by their objectives already, and the sort keeps that order.
        candidates.sort_by_key(|(is_crossing, _)| *is_crossing);
        let mut starts = Vec::new();
        for (_, candidate) in candidates.into_iter().take(MOST_CANDIDATES) {
            starts.extend(self.coarse_again(coarse, candidate)?);
        }
        starts.sort_by(|a, b| a.objective.total_cmp(&b.objective));
        for start in starts {
            if self.is_interrupted() {
                break;
            }
            let found = self.refined_to(grid, start)?;
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    /// A solution on the coarse grid with the limits within the steps; none if things go through each
    /// other all the same.
    fn coarse_again(
        &mut self,
        grid: Grid,
        candidate: OcpSolution,
    ) -> Result<Option<OcpSolution>, OcpError> {
        let model = self.ranking_model.as_ref().unwrap_or(&self.model);
        let guess = InitialGuess { states: candidate.states, controls: candidate.controls };
        let mut settings = close_guess_settings(&settings::coarse(self.scenario));
        settings.ipopt.max_iterations = settings.ipopt.max_iterations.min(MOST_ITERATIONS);
        let on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut solution = model.solve(grid, guess, &settings, on_iteration)?;
        self.attempts.append(&mut solution.attempts);
        let is_apart = solution.status.is_success() && !self.is_crossing(grid, &solution);
        Ok(is_apart.then_some(solution))
    }

    /// Whether things go through each other in a solution on the coarse grid.
    fn is_crossing(&self, grid: Grid, solution: &OcpSolution) -> bool {
        let model = self.ranking_model.as_ref().unwrap_or(&self.model);
        self.passed_by(model, grid, solution).is_crossing()
    }

    fn stated_within_steps(&self) -> String {
        let limits = &self.stage_limits;
        let names = &self.scenario.system().names;
        let joints = limits.joints.keys();
        let joints = joints.map(|&joint| format!("the angle of {}", names.joint(joint)));
        let at_places = |parts: usize| {
            let places = if parts == 2 { "place" } else { "places" };
            format!("(at {} {places} in every step)", parts - 1)
        };
        let distances = limits.clearances.iter().map(|(&place, &parts)| {
            let between = names.between(&self.clearances.between(place));
            format!("the clearance of {between} {}", at_places(parts))
        });
        let cones = limits.cones.iter().map(|(&place, &parts)| {
            format!("the cone of \"{}\" {}", self.cones.get(place).name, at_places(parts))
        });
        let places = limits.load_parts - 1;
        let loads = (places > 0).then(|| {
            let ends = if places == 1 { "a place" } else { "places" };
            format!("loads (at {ends} between the ends of every step)")
        });
        let stated: Vec<String> = joints.chain(distances).chain(cones).chain(loads).collect();
        stated.join(", ")
    }
}
