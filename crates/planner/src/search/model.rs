use righting_ocp::{
    Control, Curvature, Grid, InitialGuess, MeshRefinement, MultipleShooting, OcpError,
    OcpSolution, OcpStart, ReducedHessian, Samples, Settings, StageFunctions,
};
use righting_results::solution::IterationRecord;
use righting_scenario::file::Formulation;
use righting_scenario::scenario::Scenario;

use crate::formulation::{Coordinates, FormulatedManeuver, StageLimits};
use crate::initial_guess::InitialGuesses;
use crate::planned::record;

/// A form of the problem with its compiled functions.
pub(super) struct Model {
    pub(super) coordinates: Coordinates,
    /// x_0.
    pub(super) initial: Vec<f64>,
    pub(super) functions: StageFunctions,
}

impl Model {
    pub(super) fn compile(
        scenario: &Scenario,
        formulation: Formulation,
        stage_limits: &StageLimits,
    ) -> Result<Self, OcpError> {
        let FormulatedManeuver { problem, coordinates, initial } =
            FormulatedManeuver::in_form(scenario, formulation, stage_limits);
        Ok(Self { functions: StageFunctions::compile(&problem)?, coordinates, initial })
    }

    pub(super) fn initial_guesses<'a>(
        &'a self,
        scenario: &'a Scenario,
        steps: usize,
    ) -> InitialGuesses<'a> {
        InitialGuesses { scenario, coordinates: &self.coordinates, initial: &self.initial, steps }
    }

    pub(super) fn solve(
        &self,
        grid: Grid,
        guess: InitialGuess,
        settings: &Settings,
        mut on_iteration: impl FnMut(IterationRecord) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        let mut program = MultipleShooting::new(&self.functions, grid, &self.initial)?;
        program
            .solve(&OcpStart::Guess(guess), settings, |iteration| on_iteration(record(iteration)))
    }

    pub(super) fn refine(
        &self,
        grid: Grid,
        between: &[usize],
        coarse: OcpSolution,
        settings: &Settings,
        mut on_iteration: impl FnMut(IterationRecord) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        let on_iteration = |iteration: &righting_ocp::Iteration| on_iteration(record(iteration));
        let Self { functions, initial, .. } = self;
        MeshRefinement { functions, initial, grid, between, settings }
            .refine(coarse.point, on_iteration)
    }

    /// How the Lagrangian curves at a solution on `grid`.
    pub(super) fn curvature(
        &self,
        grid: Grid,
        solution: &OcpSolution,
    ) -> Result<Curvature, OcpError> {
        if solution.reduced_hessian == Some(ReducedHessian::PositiveDefinite) {
            return Ok(Curvature::Positive);
        }
        MultipleShooting::new(&self.functions, grid, &self.initial)?.curvature(&solution.point)
    }

    /// The motion of a solution in another model's form, as a guess for this one.
    pub(super) fn guess_from(&self, other: &Model, solution: &OcpSolution) -> InitialGuess {
        let mut states = Samples::new(self.coordinates.dimension());
        for row in solution.states.rows() {
            let state = other.coordinates.free_floating_state(row);
            states.push(&self.coordinates.of_free_floating_state(&state));
        }
        InitialGuess { states, controls: solution.controls.clone() }
    }
}
