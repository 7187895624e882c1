use std::num::NonZeroUsize;

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
use crate::search::stall::StallCheck;

/// Two steps whose lengths differ by no more than this share are as long.
const SAME_STEP: f64 = 1e-9;

/// A form of the problem with its compiled functions.
pub(crate) struct Model {
    pub(crate) coordinates: Coordinates,
    /// x_0.
    pub(crate) initial: Vec<f64>,
    /// With one Runge–Kutta step in each step of the grid.
    plain: StageFunctions,
    /// With several, for coarser grids than the asked one, if their steps need them.
    ranking: Option<StageFunctions>,
    /// The same for the asked grid.
    asked: Option<StageFunctions>,
    /// Length of a step of the asked grid.
    asked_step_s: f64,
}

impl Model {
    /// A form, with so many Runge–Kutta steps in a step of the grids of ranking, and limits that are stated
    /// within the steps too.
    pub(crate) fn compile(
        scenario: &Scenario,
        formulation: Formulation,
        substeps: NonZeroUsize,
        stage_limits: &StageLimits,
    ) -> Result<Self, OcpError> {
        let FormulatedManeuver { problem, coordinates, initial } =
            FormulatedManeuver::in_form(scenario, formulation, stage_limits);
        let plain = StageFunctions::compile(&problem)?;
        let needs_several = substeps > NonZeroUsize::MIN;
        Ok(Self {
            ranking: needs_several.then(|| plain.with_substeps(substeps)).transpose()?,
            plain,
            asked: None,
            asked_step_s: scenario.horizon().step_s(),
            coordinates,
            initial,
        })
    }

    pub(crate) fn initial_guesses<'a>(
        &'a self,
        scenario: &'a Scenario,
        steps: usize,
    ) -> InitialGuesses<'a> {
        InitialGuesses {
            scenario,
            coordinates: &self.coordinates,
            initial: &self.initial,
            steps,
            substeps: self.ranking_functions().substeps().get(),
        }
    }

    pub(crate) fn solve(
        &self,
        grid: Grid,
        guess: InitialGuess,
        settings: &Settings,
        on_iteration: impl FnMut(IterationRecord) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        solve_from(guess, &mut self.program(grid)?, settings, on_iteration)
    }

    /// The program on a grid.
    pub(super) fn program(&self, grid: Grid) -> Result<MultipleShooting<'_>, OcpError> {
        // Steps as long as those of the asked grid need as many Runge–Kutta steps.
        let is_as_coarse = grid.step_s() < self.asked_step_s * (1.0 + SAME_STEP);
        let functions =
            if is_as_coarse { self.asked_functions() } else { self.ranking_functions() };
        MultipleShooting::new(functions, grid, &self.initial)
    }

    /// The program of the asked form from another state, on a grid with the asked grid's steps.
    pub(crate) fn program_from(
        &self,
        grid: Grid,
        initial: &[f64],
    ) -> Result<MultipleShooting<'_>, OcpError> {
        MultipleShooting::new(self.asked_functions(), grid, initial)
    }

    /// What coarser grids than the asked one are solved with.
    fn ranking_functions(&self) -> &StageFunctions {
        self.ranking.as_ref().unwrap_or(&self.plain)
    }

    /// What the asked grid is solved with.
    pub(crate) fn asked_functions(&self) -> &StageFunctions {
        self.asked.as_ref().unwrap_or(&self.plain)
    }

    /// From here on, each step of the asked grid is integrated in so many Runge–Kutta steps.
    pub(crate) fn take_substeps(&mut self, substeps: NonZeroUsize) -> Result<(), OcpError> {
        self.asked = Some(self.plain.with_substeps(substeps)?);
        Ok(())
    }

    /// By how much the attitude at the end of a solution on the asked grid may be off for its steps, rad.
    pub(super) fn integration_error_rad(
        &self,
        grid: Grid,
        solution: &OcpSolution,
    ) -> Result<f64, OcpError> {
        let functions = self.asked_functions();
        let mut program = MultipleShooting::new(functions, grid, &self.initial)?;
        let twice = functions.substeps().saturating_mul(NonZeroUsize::MIN.saturating_add(1));
        let errors = program.step_errors(&solution.point, twice);
        let attitude = self.coordinates.attitude();
        let of_step = |row: &[f64]| row[attitude.clone()].iter().map(|e| e * e).sum::<f64>().sqrt();
        // An error of a unit quaternion is half an angle.
        Ok(errors.rows().map(|row| 2.0 * of_step(row)).sum())
    }

    pub(super) fn refine(
        &self,
        grid: Grid,
        between: &[usize],
        coarse: OcpSolution,
        settings: &Settings,
        mut on_iteration: impl FnMut(IterationRecord) -> Control,
    ) -> Result<OcpSolution, OcpError> {
        let mut stall = StallCheck::default();
        let on_iteration = |iteration: &righting_ocp::Iteration| {
            stall.watched(record(iteration), &mut on_iteration)
        };
        let (functions, last_functions) = (self.ranking_functions(), self.asked_functions());
        let initial = &self.initial;
        MeshRefinement { functions, last_functions, initial, grid, between, settings }
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
        MultipleShooting::new(self.asked_functions(), grid, &self.initial)?
            .curvature(&solution.point)
    }

    /// A motion in another model's form, as a guess for this one.
    pub(super) fn guess_along(
        &self,
        other: &Model,
        motion: &Samples,
        controls: &Samples,
    ) -> InitialGuess {
        let mut states = Samples::new(self.coordinates.dimension());
        for row in motion.rows() {
            let state = other.coordinates.free_floating_state(row);
            let time = other.coordinates.time_of(row);
            let mut x = self.coordinates.of_free_floating_state(&state, time);
            x[self.coordinates.driven_states()]
                .copy_from_slice(&row[other.coordinates.driven_states()]);
            states.push(&x);
        }
        InitialGuess { states, controls: controls.clone() }
    }
}

/// Solves a program from a guess.
pub(super) fn solve_from(
    guess: InitialGuess,
    program: &mut MultipleShooting<'_>,
    settings: &Settings,
    mut on_iteration: impl FnMut(IterationRecord) -> Control,
) -> Result<OcpSolution, OcpError> {
    let mut stall = StallCheck::default();
    program.solve(&OcpStart::Guess(guess), settings, |iteration| {
        stall.watched(record(iteration), &mut on_iteration)
    })
}
