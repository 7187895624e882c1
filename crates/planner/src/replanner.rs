//! The rest of a maneuver planned anew, time and again, from where it is.

use std::num::NonZeroUsize;
use std::sync::Arc;
use std::time::{Duration, Instant};

use righting_ocp::{
    Control, Grid, InitialGuess, Iteration, LinearSolverChoice, OcpError, OcpStart, Optimizer,
    PrimalDualPoint, Samples, Settings, close_guess_settings, warm_start_settings,
};
use righting_results::Trajectory;
use righting_scenario::Scenario;
use righting_scenario::error::ShapeError;
use righting_scenario::file::Formulation;

use crate::formulation::StageLimits;
use crate::measured::{Measured, Measurement};
use crate::planner::PlanError;
use crate::scaling::Scaling;
use crate::search::{Model, settings, substeps_of_spin};

/// Barrier parameter of a replan, where the objective is about one.
const BARRIER: f64 = 1e-7;
/// Its tolerance.
const TOLERANCE: f64 = 1e-6;
/// Iterations after which it is given up: most need three.
const ITERATIONS: u32 = 40;

/// What is not planned anew.
const JERKS: &str =
    "links[].jerk_max_deg_s3: maneuvers with limited jerks are not planned anew on the way";
const WHEELS: &str = "wheels: maneuvers with wheels are not planned anew on the way";
const WAYPOINTS: &str = "maneuver.waypoints: slews with waypoints are not planned anew on the way";

/// What is planned for the rest of a maneuver.
#[derive(Clone, Debug, PartialEq)]
pub struct Replan {
    /// Joint accelerations of the steps that are left, rad/s²; one row a step.
    pub accelerations_rad_s2: Vec<Vec<f64>>,
    /// Iterations of the optimizer.
    pub iterations: usize,
    /// Wall time that it took.
    pub time: Duration,
}

/// Plans what is left of a maneuver from measured states, on the steps that are left of its grid.
///
/// The problem's functions are traced and compiled once. Each solve starts from the part that is left of the
/// last solution, with its multipliers; momentum is that of the plan at the node, whatever is measured. Solves
/// are the interior solver's ([`Optimizer::Interior`]), so that many replanners may work at a time.
///
/// A clone shares the compiled functions and goes its own way from where this one is.
#[derive(Clone)]
pub struct Replanner {
    problem: Arc<Problem>,
    /// The solution over what was left at the last solve.
    point: PrimalDualPoint,
}

/// What stays the same from solve to solve.
struct Problem {
    scaling: Scaling,
    /// In units of its own.
    scenario: Scenario,
    model: Model,
    settings: Settings,
    /// The asked grid.
    grid: Grid,
    /// Angular momentum at its nodes, inertial axes, as far as that is among the states.
    momenta: Samples,
}

impl Replanner {
    /// Of a plan of the scenario, which is solved again for its multipliers.
    ///
    /// # Errors
    /// [`PlanError::Shape`] when the plan is of other joints or another grid, [`PlanError::Ocp`] when it is
    /// not near a solution, [`PlanError::NotReplanned`] when jerks are limited or there are
    /// waypoints or wheels.
    pub fn new(scenario: &Scenario, plan: &Trajectory) -> Result<Self, PlanError> {
        let counts = [
            ("joints of the plan", plan.joints(), scenario.system().joint_count()),
            ("steps of the plan", plan.steps(), scenario.horizon().steps),
        ];
        for (what, found, needed) in counts {
            if found != needed {
                return Err(ShapeError { what: what.to_owned(), found, needed }.into());
            }
        }
        if scenario.system().limits_jerk() {
            return Err(PlanError::NotReplanned(JERKS));
        }
        if !scenario.waypoints().is_empty() {
            return Err(PlanError::NotReplanned(WAYPOINTS));
        }
        if !scenario.wheels().is_empty() {
            return Err(PlanError::NotReplanned(WHEELS));
        }
        let fixed = match scenario.free_duration() {
            Some(_) => scenario.clone().with_duration(plan.end().time_s),
            None => scenario.clone(),
        };
        let (scenario, scaling) = Scaling::applied(&fixed)?;
        let plain = NonZeroUsize::MIN;
        let mut model =
            Model::compile(&scenario, Formulation::Reduced, plain, &StageLimits::asked())?;
        let substeps = substeps_of_spin(&scenario);
        if substeps > plain {
            model.take_substeps(substeps)?;
        }
        let settings = Settings {
            optimizer: Optimizer::Interior,
            judges: false,
            linear_solver: LinearSolverChoice::Stage,
            ..settings::delivered(&scenario)
        };
        let grid = Grid::new(scenario.horizon().duration_s, scenario.horizon().steps)?;
        let guesses = model.initial_guesses(&scenario, grid.steps());
        let guess = guesses.along_trajectory(&scaling.trajectory(plan));
        let from_plan = settings::from_own_plan(settings.clone());
        let solution = model.solve(grid, guess, &from_plan, |_| Control::Continue)?;
        let momentum = model.coordinates.momentum();
        let mut momenta = Samples::new(momentum.len());
        solution.states.rows().for_each(|row| momenta.push(&row[momentum.clone()]));
        let problem = Problem { scaling, scenario, model, settings, grid, momenta };
        Ok(Self { problem: Arc::new(problem), point: solution.point })
    }

    /// Where the model has the maneuver from node `node` on, where it is measured, with accelerations of its joints
    /// (j a step, rad/s²): there, and after every step.
    ///
    /// # Panics
    /// There are not so many steps, or not one joint value a joint.
    pub fn ahead(
        &self,
        node: usize,
        measured: &Measured<'_>,
        accelerations: &[Vec<f64>],
    ) -> Vec<Measurement> {
        let Problem { scaling, model, grid, .. } = &*self.problem;
        let measurement = |x: &[f64]| {
            let state = scaling.state(model.coordinates.free_floating_state(x));
            Measurement {
                attitude: state.attitude.normalized(),
                joint_angles_rad: state.joint_angles,
                joint_rates_rad_s: state.joint_rates,
            }
        };
        let mut state = self.state(node, measured);
        let mut ahead = vec![measurement(&state)];
        for accelerations in accelerations {
            let controls = scaling.accelerations_measured(accelerations);
            state = model.coordinates.moved_on(&state, &controls, grid.step_s());
            ahead.push(measurement(&state));
        }
        ahead
    }

    /// The state at a node as it is measured.
    ///
    /// From a rate that is measured on a wrong model, no better momentum would follow than the plan's.
    fn state(&self, node: usize, measured: &Measured<'_>) -> Vec<f64> {
        let Problem { scaling, scenario, model, momenta, .. } = &*self.problem;
        let here = measured.state(scaling);
        let mut here =
            model.coordinates.of_free_floating_state(&here, scenario.horizon().time_s(node));
        let momentum = model.coordinates.momentum();
        here[momentum].copy_from_slice(momenta.row(node));
        here
    }

    /// The same with another model of the spacecraft, such as masses estimated on the way; it goes on from where this
    /// one is.
    ///
    /// # Errors
    /// [`PlanError::Model`] for masses beyond all measure, [`PlanError::Ocp`] where its functions cannot be compiled.
    pub fn adapted(&self, scenario: &Scenario) -> Result<Self, PlanError> {
        let before = &*self.problem;
        let fixed = match scenario.free_duration() {
            Some(_) => {
                let duration_s = before.scaling.seconds(before.grid.duration_s());
                scenario.clone().with_duration(duration_s)
            }
            None => scenario.clone(),
        };
        let (scenario, scaling) = before.scaling.clone().measured(&fixed)?;
        let mut model = Model::compile(
            &scenario,
            Formulation::Reduced,
            NonZeroUsize::MIN,
            &StageLimits::asked(),
        )?;
        let substeps = before.model.asked_functions().substeps();
        if substeps > NonZeroUsize::MIN {
            model.take_substeps(substeps)?;
        }
        let (settings, grid, momenta) =
            (before.settings.clone(), before.grid, before.momenta.clone());
        let problem = Problem { scaling, scenario, model, settings, grid, momenta };
        Ok(Self { problem: Arc::new(problem), point: self.point.clone() })
    }

    /// Plans the steps from node `node` on, where the maneuver is as measured. None where the solve does not
    /// converge, or takes longer than `deadline`: the last plan then stands.
    ///
    /// # Errors
    /// [`OcpError`] when what is measured is not finite.
    ///
    /// # Panics
    /// There is no step left, an earlier node was replanned before, or there is not one joint value a joint.
    pub fn replan(
        &mut self,
        node: usize,
        measured: &Measured<'_>,
        deadline: Option<Duration>,
    ) -> Result<Option<Replan>, OcpError> {
        let started = Instant::now();
        let Problem { scaling, scenario, model, settings, grid, .. } = &*self.problem;
        let steps = grid.steps() - node;
        let start = self.point.after(self.point.steps() - steps);
        let grid = Grid::new(grid.step_s() * steps as f64, steps)?;
        let here = self.state(node, measured);
        let mut program = model.program_from(grid, &here)?;
        let is_late = || deadline.is_some_and(|deadline| started.elapsed() > deadline);
        let watch = |_: &Iteration| if is_late() { Control::Stop } else { Control::Continue };
        let mut solution = program.solve(&OcpStart::Warm(start.clone()), &warm(settings), watch)?;
        if !solution.status.is_success() && !is_late() {
            // Where multipliers mislead, the motion that the last controls make is a start without any.
            let (_, controls) = program.trajectory(&start);
            let states = Samples::repeated(&here, steps + 1);
            let mut guess = InitialGuess { states, controls };
            let substeps = model.asked_functions().substeps().get();
            let guesses = model.initial_guesses(scenario, steps);
            guesses.simulate(&mut guess, 0, grid.step_s(), substeps);
            let settings = close_guess_settings(settings);
            solution = program.solve(&OcpStart::Guess(guess), &settings, watch)?;
        }
        let is_new = solution.status.is_success();
        self.point = if is_new { solution.point.clone() } else { start };
        Ok(is_new.then(|| Replan {
            accelerations_rad_s2: {
                let rows = solution.controls.rows();
                rows.map(|row| scaling.accelerations(row)).collect()
            },
            iterations: solution.iterations(),
            time: started.elapsed(),
        }))
    }
}

/// Settings of a start from the last solution.
fn warm(settings: &Settings) -> Settings {
    let mut settings = warm_start_settings(settings, BARRIER);
    settings.ipopt.tolerance = settings.ipopt.tolerance.max(TOLERANCE);
    settings.ipopt.max_iterations = settings.ipopt.max_iterations.min(ITERATIONS);
    settings
}
