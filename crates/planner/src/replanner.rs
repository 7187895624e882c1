//! The rest of a maneuver planned anew, time and again, from where it is.

use std::time::{Duration, Instant};

use nalgebra::Vector3;
use righting_multibody::{Quaternion, State};
use righting_ocp::{
    Control, Grid, InitialGuess, Iteration, LinearSolverChoice, OcpError, OcpStart, Optimizer,
    PrimalDualPoint, Samples, Settings, close_guess_settings, warm_start_settings,
};
use righting_results::Trajectory;
use righting_scenario::Scenario;
use righting_scenario::error::ShapeError;
use righting_scenario::file::Formulation;

use crate::formulation::StageLimits;
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
const WAYPOINTS: &str = "maneuver.waypoints: slews with waypoints are not planned anew on the way";

/// Where a maneuver is.
#[derive(Clone, Copy, Debug)]
pub struct Measured<'a> {
    /// Attitude of the base, body → inertial.
    pub attitude: Quaternion<f64>,
    /// Joint angles (j), rad.
    pub joint_angles_rad: &'a [f64],
    /// Joint rates (j), rad/s.
    pub joint_rates_rad_s: &'a [f64],
}

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
/// last solution, with its multipliers; momentum is that of the scenario's start, which nothing changes. Solves
/// are the interior solver's ([`Optimizer::Interior`]), so that many replanners may work at a time.
pub struct Replanner {
    scaling: Scaling,
    /// In units of its own.
    scenario: Scenario,
    model: Model,
    settings: Settings,
    /// The asked grid.
    grid: Grid,
    /// The solution over what was left at the last solve.
    point: PrimalDualPoint,
}

impl Replanner {
    /// Of a plan of the scenario, which is solved again for its multipliers.
    ///
    /// # Errors
    /// [`PlanError::Shape`] when the plan is of other joints or another grid, [`PlanError::Ocp`] when it is
    /// not near a solution, [`PlanError::NotReplanned`] when jerks are limited or there are
    /// waypoints.
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
        let fixed = match scenario.free_duration() {
            Some(_) => scenario.clone().with_duration(plan.end().time_s),
            None => scenario.clone(),
        };
        let (scenario, scaling) = Scaling::applied(&fixed)?;
        let substeps = substeps_of_spin(&scenario);
        let mut model =
            Model::compile(&scenario, Formulation::Reduced, substeps, &StageLimits::asked())?;
        model.take_substeps(substeps)?;
        let settings = Settings {
            optimizer: Optimizer::Interior,
            linear_solver: LinearSolverChoice::Stage,
            ..settings::delivered(&scenario)
        };
        let grid = Grid::new(scenario.horizon().duration_s, scenario.horizon().steps)?;
        let guess = along(&model, &scaling.trajectory(plan));
        let from_plan = settings::from_own_plan(settings.clone());
        let solution = model.solve(grid, guess, &from_plan, |_| Control::Continue)?;
        let point = solution.point;
        Ok(Self { scaling, scenario, model, settings, grid, point })
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
        let steps = self.grid.steps() - node;
        let start = self.point.after(self.point.steps() - steps);
        let grid = Grid::new(self.grid.step_s() * steps as f64, steps)?;
        let mut program = self.model.program_from(grid, &self.state(node, measured))?;
        let is_late = || deadline.is_some_and(|deadline| started.elapsed() > deadline);
        let watch = |_: &Iteration| if is_late() { Control::Stop } else { Control::Continue };
        let mut solution =
            program.solve(&OcpStart::Warm(start.clone()), &self.warm_settings(), watch)?;
        if !solution.status.is_success() && !is_late() {
            // Where multipliers mislead, the motion that the last controls make is a start without any.
            let (_, controls) = program.trajectory(&start);
            let guess = self.simulated(program.full_initial_state(), controls);
            let settings = close_guess_settings(&self.settings);
            solution = program.solve(&OcpStart::Guess(guess), &settings, watch)?;
        }
        let is_new = solution.status.is_success();
        self.point = if is_new { solution.point.clone() } else { start };
        Ok(is_new.then(|| Replan {
            accelerations_rad_s2: {
                let rows = solution.controls.rows();
                rows.map(|row| self.scaling.accelerations(row)).collect()
            },
            iterations: solution.iterations(),
            time: started.elapsed(),
        }))
    }

    /// The motion from a state under controls.
    fn simulated(&self, from: &[f64], controls: Samples) -> InitialGuess {
        let steps = controls.len();
        let guess = InitialGuess { states: Samples::repeated(from, steps + 1), controls };
        let substeps = self.model.asked_functions().substeps().get();
        self.model.initial_guesses(&self.scenario, steps).simulated_in(
            self.grid.step_s(),
            guess,
            substeps,
        )
    }

    fn warm_settings(&self) -> Settings {
        let mut settings = warm_start_settings(&self.settings, BARRIER);
        settings.ipopt.tolerance = settings.ipopt.tolerance.max(TOLERANCE);
        settings.ipopt.max_iterations = settings.ipopt.max_iterations.min(ITERATIONS);
        settings
    }

    /// The state at a node as the problem has it.
    fn state(&self, node: usize, measured: &Measured<'_>) -> Vec<f64> {
        let time_s = self.scaling.units.time_s;
        let state = State {
            position: Vector3::zeros(),
            attitude: measured.attitude,
            velocity: Vector3::zeros(),
            angular_rate: Vector3::zeros(),
            joint_angles: measured.joint_angles_rad.to_vec(),
            joint_rates: measured.joint_rates_rad_s.iter().map(|rate| rate * time_s).collect(),
        };
        let time = self.scenario.horizon().time_s(node);
        self.model.coordinates.of_free_floating_state(&state, time)
    }
}

/// A motion node by node, as a guess.
fn along(model: &Model, plan: &Trajectory) -> InitialGuess {
    let joints = plan.joints();
    let mut guess = InitialGuess::constant(&model.initial, joints, plan.steps());
    for (index, node) in plan.nodes().iter().enumerate().skip(1) {
        let state = model.coordinates.of_free_floating_state(&node.state(), node.time_s);
        guess.states.row_mut(index).copy_from_slice(&state);
    }
    for (step, interval) in plan.intervals().iter().enumerate() {
        guess.controls.row_mut(step).copy_from_slice(&interval.joint_accelerations_rad_s2);
    }
    guess
}
