//! The rest of a maneuver planned anew, time and again, from where it is.

mod barrier;

use std::num::{NonZeroU32, NonZeroUsize};
use std::sync::Arc;
use std::time::{Duration, Instant};

use righting_ocp::{
    Control, Grid, InitialGuess, Iteration, LinearSolverChoice, MultipleShooting, OcpError,
    OcpSolution, OcpStart, Optimizer, PrimalDualPoint, Samples, Settings, ShootingWorkspace,
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

/// Gaps that are left where a motion follows from its controls.
const GAP: f64 = 1e-9;
/// By how much the motion of a solve that was stopped may pass a limit.
const VIOLATION: f64 = 1e-4;

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
    /// The objective from here on, by the weights of the scenario.
    pub objective: f64,
    /// Iterations of the optimizer.
    pub iterations: usize,
    /// Whether it is a solution; if not, it is nearer to one than what was planned before.
    pub converged: bool,
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
    /// Iterations of a replan in real time.
    iterations: Option<NonZeroU32>,
    /// What solves work in, from one to the next.
    workspace: Option<ShootingWorkspace>,
}

/// What stays the same from solve to solve.
struct Problem {
    scaling: Scaling,
    /// In units of its own.
    scenario: Scenario,
    model: Model,
    /// Settings of a start from the last solution …
    warm: Settings,
    /// … and of one from a motion.
    from_motion: Settings,
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
            examines_curvature: false,
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
        let mut program = model.program_from(grid, &model.initial)?;
        let (barrier, solution) =
            barrier::costing_little(&mut program, scenario.maneuver(), solution, &settings)?;
        let workspace = Some(program.into_workspace());
        let (warm, from_motion) =
            (barrier::warm(&settings, barrier), barrier::from_motion(&settings, barrier));
        let problem = Problem { scaling, scenario, model, warm, from_motion, grid, momenta };
        Ok(Self { problem: Arc::new(problem), point: solution.point, iterations: None, workspace })
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
        let problem = Problem {
            scaling,
            scenario,
            model,
            warm: before.warm.clone(),
            from_motion: before.from_motion.clone(),
            grid: before.grid,
            momenta: before.momenta.clone(),
        };
        Ok(Self {
            problem: Arc::new(problem),
            point: self.point.clone(),
            iterations: self.iterations,
            workspace: None,
        })
    }

    /// In real time: a replan makes no more than so many iterations, and their controls are taken as they are (Diehl,
    /// Bock & Schlöder, *SIAM Journal on Control and Optimization* 43, 2005, make one).
    pub fn in_real_time(self, iterations: NonZeroU32) -> Self {
        Self { iterations: Some(iterations), ..self }
    }

    /// Gets ready for a replan at node `node`: what does not depend on what is measured there is done before (the
    /// preparation phase of Diehl, Bock & Schlöder). A replan that is not prepared does it itself.
    ///
    /// # Errors
    /// [`OcpError`] when the linear solver refuses the problem.
    ///
    /// # Panics
    /// There is no step left.
    pub fn prepare(&mut self, node: usize) -> Result<(), OcpError> {
        let problem = Arc::clone(&self.problem);
        let mut program = self.program(&problem, node, &problem.model.initial)?;
        let prepared = program.prepare();
        self.workspace = Some(program.into_workspace());
        prepared
    }

    /// The program of the steps from node `node` on, in the replanner's workspace.
    fn program<'p>(
        &mut self,
        problem: &'p Problem,
        node: usize,
        from: &[f64],
    ) -> Result<MultipleShooting<'p>, OcpError> {
        let steps = problem.grid.steps() - node;
        let grid = Grid::new(problem.grid.step_s() * steps as f64, steps)?;
        let functions = problem.model.asked_functions();
        let workspace = self.workspace.take();
        let workspace = workspace.unwrap_or_else(|| ShootingWorkspace::new(functions));
        MultipleShooting::in_workspace(functions, grid, from, workspace)
    }

    /// Plans the steps from node `node` on, where the maneuver is as measured.
    ///
    /// A solve that is stopped, by `deadline` or [in real time](Self::in_real_time), ends in the motion that its last
    /// controls make. That is taken if it keeps the limits as well as the last plan flown from here would, and ends
    /// nearer. None where it is not, or where the solve does not converge: the last plan then stands. After the
    /// deadline no iteration begins.
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
        let problem = Arc::clone(&self.problem);
        let Problem { scaling, grid, .. } = &*problem;
        let start = self.point.after(self.point.steps() + node - grid.steps());
        let here = self.state(node, measured);
        let mut program = self.program(&problem, node, &here)?;
        let is_late = || deadline.is_some_and(|deadline| started.elapsed() > deadline);
        let found = self.solved(&mut program, &here, &start, is_late);
        self.workspace = Some(program.into_workspace());
        let found = found?;
        let replan = found.as_ref().map(|found| Replan {
            accelerations_rad_s2: {
                let rows = found.controls.rows();
                rows.map(|row| scaling.accelerations(row)).collect()
            },
            objective: scaling.objective * found.objective,
            iterations: found.iterations(),
            converged: found.status.is_success(),
            time: started.elapsed(),
        });
        self.point = found.map_or(start, |found| found.point);
        Ok(replan)
    }

    /// The solution of the program from the last one's rest, or what a solve that was stopped came to.
    fn solved(
        &self,
        program: &mut MultipleShooting<'_>,
        here: &[f64],
        start: &PrimalDualPoint,
        is_late: impl Fn() -> bool,
    ) -> Result<Option<OcpSolution>, OcpError> {
        let Problem { scenario, model, warm, from_motion, .. } = &*self.problem;
        let watch = |_: &Iteration| if is_late() { Control::Stop } else { Control::Continue };
        let mut settings = warm.clone();
        if let Some(iterations) = self.iterations {
            settings.ipopt.max_iterations = iterations.get();
        }
        let mut solution = program.solve(&OcpStart::Warm(start.clone()), &settings, watch)?;
        if !solution.status.is_success() && !is_late() && self.iterations.is_none() {
            // Where multipliers mislead, the motion that the last controls make is a start without any.
            let (_, controls) = program.trajectory(start);
            let grid = program.grid();
            let states = Samples::repeated(here, grid.steps() + 1);
            let mut guess = InitialGuess { states, controls };
            let substeps = model.asked_functions().substeps().get();
            let guesses = model.initial_guesses(scenario, grid.steps());
            guesses.simulate(&mut guess, 0, grid.step_s(), substeps);
            solution = program.solve(&OcpStart::Guess(guess), from_motion, watch)?;
        }
        let is_stopped = self.iterations.is_some() || is_late();
        Ok(match solution.status.is_success() {
            true => Some(solution),
            false if is_stopped => ending_nearer(program, solution, start),
            false => None,
        })
    }
}

/// The motion that the controls of a solve that was stopped make, if it is better than the last plan's.
fn ending_nearer(
    program: &mut MultipleShooting<'_>,
    mut solution: OcpSolution,
    last: &PrimalDualPoint,
) -> Option<OcpSolution> {
    let mut last = last.clone();
    let mut outcome = |point: &mut PrimalDualPoint| {
        program.close_gaps(point, GAP);
        program.outcome(point)
    };
    let (new, old) = (outcome(&mut solution.point), outcome(&mut last));
    let keeps_limits = new.violation <= VIOLATION.max(old.violation);
    solution.objective = new.objective;
    (keeps_limits && new.terminal_cost < old.terminal_cost).then_some(solution)
}
