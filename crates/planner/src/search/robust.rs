//! The last solve of a plan that shall not depend on masses more than it must.

use righting_ocp::{
    InitialGuess, MultipleShooting, OcpSolution, OcpStart, RungeKutta4, Samples, StageFunctions,
    close_guess_settings,
};
use righting_scenario::Robustness;
use righting_scenario::file::Formulation;

use super::{Search, settings, stoppable};
use crate::formulation::{FormulatedManeuver, Spread};
use crate::planner::PlanError;

/// What masses that are not known exactly do to the attitude at the end of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SpreadOfEnd {
    /// Standard deviation of the attitude at the end, rad, …
    pub(crate) deviation_rad: f64,
    /// … that of the plan that does not care, …
    pub(crate) without_rad: f64,
    /// … and the objective of both, but for what the spread costs.
    pub(crate) cost: f64,
    pub(crate) cost_without: f64,
}

impl Search<'_> {
    /// A solution that trades effort for a smaller spread of the end, from one that does not; none if the solve fails.
    pub(super) fn made_robust(
        &mut self,
        robustness: Robustness,
        solution: &OcpSolution,
    ) -> Result<Option<(OcpSolution, SpreadOfEnd)>, PlanError> {
        let spread = Spread::new(self.scenario, robustness)?;
        let guess = self.with_spread(&spread, &solution.states, &solution.controls);
        let variance = |states: &Samples| {
            let (x, z) = states.row(states.len() - 1).split_at(solution.states.width());
            spread.variance(x, z)
        };
        let without = variance(&guess.states);
        let weight = robustness.weight * solution.objective / without.max(f64::MIN_POSITIVE);
        let maneuver =
            FormulatedManeuver::in_form(self.scenario, Formulation::Reduced, &self.stage_limits);
        let (rates, cost) = (spread.clone(), spread.clone());
        let problem = maneuver.problem.with_more_states(
            spread.states(),
            move |x, z, u| rates.rates(x, z, u),
            move |x, z| cost.variance(x, z) * weight,
        );
        let substeps = self.model.asked_functions().substeps();
        let functions = StageFunctions::compile(&problem)?.with_substeps(substeps)?;
        let initial = guess.states.row(0).to_vec();
        let mut program = MultipleShooting::new(&functions, self.grid, &initial)?;
        let settings = close_guess_settings(&settings::delivered(self.scenario));
        let mut on_iteration = stoppable(self.on_iteration, &self.stop);
        let mut robust = program.solve(&OcpStart::Guess(guess), &settings, |iteration| {
            on_iteration(crate::planned::record(iteration))
        })?;
        self.attempts.append(&mut robust.attempts);
        if !robust.status.is_success() {
            return Ok(None);
        }
        let with = variance(&robust.states);
        let found = SpreadOfEnd {
            deviation_rad: with.sqrt(),
            without_rad: without.sqrt(),
            cost: robust.objective - weight * with,
            cost_without: solution.objective,
        };
        let mut states = Samples::new(solution.states.width());
        robust.states.rows().for_each(|row| states.push(&row[..solution.states.width()]));
        Ok(Some((OcpSolution { states, ..robust }, found)))
    }

    /// A motion with the attitudes beside it, as its controls make them.
    fn with_spread(&self, spread: &Spread, states: &Samples, controls: &Samples) -> InitialGuess {
        let substeps = self.model.asked_functions().substeps().get();
        let step_s = self.grid.step_s() / substeps as f64;
        let width = states.width();
        let mut z = spread.start(states.row(0));
        let mut with = Samples::new(width + z.len());
        let mut x = [states.row(0), &z].concat();
        with.push(&x);
        let mut point = x.clone();
        let mut method = RungeKutta4::new(x.len());
        for (step, u) in controls.rows().enumerate() {
            for _ in 0..substeps {
                let next = method.step(step_s, &x, |stage| {
                    stage.write_point(&mut point);
                    let (x, z) = point.split_at(width);
                    let rates = self.model.coordinates.rates(x, u);
                    stage.set_rates(&[rates, spread.rates(x, z, u)].concat());
                });
                x.copy_from_slice(next);
            }
            z.copy_from_slice(&x[width..]);
            // The nodes' own states are those of the solution.
            x = [states.row(step + 1), &z].concat();
            with.push(&x);
        }
        InitialGuess { states: with, controls: controls.clone() }
    }
}
