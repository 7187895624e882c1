//! The measures of a maneuver: it is planned in units of its own.
//!
//! Lengths are measured by the system's size, masses by its mass, and time so that every maneuver, or its
//! beginning where that is all that counts, takes [`DURATION`]. The objective is measured by what a maneuver
//! of that size costs: the optimizer's tolerances, which are absolute, are then relative to the plan's cost
//! whatever the units of the file, the size of the arm and the length of the maneuver.
//!
//! The constant guess is the paper's solve, and keeps the units of the file.

use righting_multibody::{ModelError, Quaternion, State, Units};
use righting_results::IterationRecord;
use righting_results::trajectory::{ControlInterval, Node, Trajectory};
use righting_scenario::file::Formulation;
use righting_scenario::scenario::{Maneuver, Scenario, Slew, Weights};

use crate::formulation::Coordinates;
use crate::initial_guess::InitialGuesses;
use crate::search::Found;
use crate::spin::beginning_s;

/// Duration of every maneuver in its own unit of time: that of the paper's, so that its unit is a second.
const DURATION: f64 = 30.0;
/// Steps on which the effort of a slew is estimated.
const ESTIMATE_STEPS: usize = 24;
/// The smallest slew whose effort is estimated, rad: what the end may miss anyway.
const SMALLEST_SLEW_RAD: f64 = 2e-3;
/// The objective of drifting in a detumble: that of the paper's, which start at 20 deg/s with a weight of
/// 100.
const DRIFT_COST: f64 = 12.184_696_791_468_343;
/// Weights of a hard end, where the effort of the maneuver is about one: attitude, at the least and times
/// half the angle of a small slew, whose effort buys so much more of it, and rates times the unit of time.
const HARD_ATTITUDE: f64 = 1e6;
const HARD_SMALL_ATTITUDE: f64 = 2e5;
const HARD_RATE: f64 = 1e5;
/// A hard end is missed by more than this, as the norm of the attitude error's vector part, …
const HARD_MISS: f64 = 1e-4;
/// … because the effort is dearer than estimated, if the objective is above this.
const DEAR: f64 = 10.0;
/// A joint is near a limit from this share of it on.
const NEAR_LIMIT: f64 = 0.9;
/// Of a detumble, the weight of the joint rates in that of the base's rate, and the effort's in both.
const HARD_DETUMBLE_JOINTS: f64 = 1e3;
const HARD_DETUMBLE_EFFORT: f64 = 0.01;

/// What the errors at waypoints are weighed by, in a scenario that is measured by itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WaypointWeights {
    /// Of the vector part of the attitude error.
    pub(crate) attitude: f64,
    /// Of joint rates and accelerations, and of the base's rate.
    pub(crate) rate: f64,
}

impl WaypointWeights {
    pub(crate) fn of(measured: &Scenario) -> Self {
        let turn_rad =
            measured.maneuver().slew().map_or(0.0, |slew| largest_turn_rad(measured, slew));
        Self { attitude: hard_attitude(turn_rad), rate: HARD_RATE }
    }
}

/// What a maneuver is measured by.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Scaling {
    pub(crate) units: Units,
    /// So much of the objective counts as one.
    pub(crate) objective: f64,
    /// The unit of each joint's coordinate, rad or m.
    pub(crate) joints: Vec<f64>,
}

impl Scaling {
    /// The scenario measured by itself, and what it is measured by.
    ///
    /// # Errors
    /// [`ModelError::Overflow`] when masses or lengths are beyond all measure.
    pub(crate) fn applied(scenario: &Scenario) -> Result<(Scenario, Self), ModelError> {
        if scenario.solver().is_paper() {
            return Ok((scenario.clone(), Self::of(scenario, Units::SI, 1.0)));
        }
        let units = Units {
            length_m: scenario.system().model.size_m(),
            mass_kg: scenario.system().model.total_mass(),
            time_s: beginning_s(scenario) / DURATION,
        };
        let measured = scenario.in_units(&units, 1.0)?;
        let weights = measured.weights();
        let objective = match measured.maneuver() {
            Maneuver::Slew(_) => {
                least_effort_cost(&measured) + weights.time * measured.horizon().duration_s
            }
            Maneuver::Detumble => {
                weights.angular_rate * measured.stopped_rate_rad_s().powi(2) / DRIFT_COST
            }
        };
        // A weight of zero says nothing of a measure.
        let objective = if objective > 0.0 { objective } else { 1.0 };
        Self::of(scenario, units, objective).measured(scenario)
    }

    fn of(scenario: &Scenario, units: Units, objective: f64) -> Self {
        let kinds = scenario.system().model.joint_kinds();
        let joints = kinds.into_iter().map(|kind| units.of_joint(kind)).collect();
        Self { units, objective, joints }
    }

    /// The scenario measured anew where what was found misses a hard end because it costs far more than was
    /// estimated; none where that is not so.
    ///
    /// # Errors
    /// As [`applied`](Self::applied).
    pub(crate) fn after(
        &self,
        scenario: &Scenario,
        measured: &Scenario,
        found: &Found,
    ) -> Result<Option<(Scenario, Self)>, ModelError> {
        let Maneuver::Slew(slew) = measured.maneuver() else { return Ok(None) };
        let solution = &found.solution;
        if !scenario.is_end_hard() || found.is_interrupted || !solution.status.is_success() {
            return Ok(None);
        }
        let steps = solution.states.len() - 1;
        let missed = |node: usize, target: &Quaternion<f64>| {
            let state = found.coordinates.free_floating_state(solution.states.row(node));
            state.attitude.error_vector(target).norm()
        };
        let waypoints = measured.waypoints().iter();
        let on_the_way = waypoints.map(|stop| missed(stop.nodes(steps)[0], &stop.target));
        let miss = on_the_way.fold(missed(steps, &slew.target), f64::max);
        if miss < HARD_MISS || solution.objective < DEAR || is_at_limits(measured, found) {
            return Ok(None);
        }
        let objective = self.objective * solution.objective;
        Ok(Some(Self { objective, ..self.clone() }.measured(scenario)?))
    }

    /// The scenario in these measures.
    ///
    /// # Errors
    /// As [`applied`](Self::applied).
    pub(crate) fn measured(self, scenario: &Scenario) -> Result<(Scenario, Self), ModelError> {
        let measured = scenario.in_units(&self.units, self.objective)?;
        let weights = match scenario.is_end_hard() {
            true => hard(&measured),
            false => measured.weights(),
        };
        Ok((measured.with_weights(weights), self))
    }

    /// A state in SI units.
    pub(crate) fn state(&self, measured: State<f64>) -> State<f64> {
        let Units { length_m, time_s, .. } = self.units;
        State {
            position: measured.position * length_m,
            velocity: measured.velocity * (length_m / time_s),
            angular_rate: measured.angular_rate / time_s,
            joint_angles: self.of_joints(&measured.joint_angles, 1.0),
            joint_rates: self.of_joints(&measured.joint_rates, time_s),
            ..measured
        }
    }

    /// Seconds in these units.
    pub(crate) fn duration(&self, seconds: f64) -> f64 {
        seconds / self.units.time_s
    }

    /// A duration in these units, in seconds.
    pub(crate) fn seconds(&self, duration: f64) -> f64 {
        duration * self.units.time_s
    }

    /// Joint accelerations in SI units.
    pub(crate) fn accelerations(&self, measured: &[f64]) -> Vec<f64> {
        self.of_joints(measured, self.units.time_s.powi(2))
    }

    /// Joint accelerations of SI units in these.
    pub(crate) fn accelerations_measured(&self, accelerations: &[f64]) -> Vec<f64> {
        self.joints_measured(accelerations, self.units.time_s.powi(2))
    }

    /// Joint coordinates over a time in SI units.
    fn of_joints(&self, measured: &[f64], time: f64) -> Vec<f64> {
        measured.iter().zip(&self.joints).map(|(value, unit)| value * unit / time).collect()
    }

    /// Joint coordinates of SI units over a time, in these.
    pub(crate) fn joints_measured(&self, values: &[f64], time: f64) -> Vec<f64> {
        values.iter().zip(&self.joints).map(|(value, unit)| value * time / unit).collect()
    }

    /// Joint jerks in SI units.
    pub(crate) fn jerks(&self, measured: &[f64]) -> Vec<f64> {
        self.of_joints(measured, self.units.time_s.powi(3))
    }

    /// Momenta of wheels in SI units.
    pub(crate) fn wheel_momenta(&self, measured: &[f64]) -> Vec<f64> {
        let unit = self.units.torque_n_m() * self.units.time_s;
        measured.iter().map(|momentum| momentum * unit).collect()
    }

    /// Torques of wheels in SI units.
    pub(crate) fn wheel_torques(&self, measured: &[f64]) -> Vec<f64> {
        measured.iter().map(|torque| torque * self.units.torque_n_m()).collect()
    }

    /// An iteration's record with the objective in the file's weights.
    pub(crate) fn record(&self, measured: &IterationRecord) -> IterationRecord {
        let objective = measured.objective * self.objective;
        IterationRecord { objective, ..*measured }
    }

    /// A motion of the same system in these units; its torques and powers stay as they are.
    pub(crate) fn trajectory(&self, motion: &Trajectory) -> Trajectory {
        let Units { length_m, time_s, .. } = self.units;
        let torque_n_m = self.units.torque_n_m();
        let of_wheels =
            |values: &[f64], unit: f64| values.iter().map(|value| value / unit).collect();
        let nodes = motion.nodes().iter().map(|node| Node {
            time_s: node.time_s / time_s,
            position_m: node.position_m.map(|position| position / length_m),
            velocity_m_s: node.velocity_m_s.map(|velocity| velocity * (time_s / length_m)),
            angular_rate_rad_s: node.angular_rate_rad_s.map(|rate| rate * time_s),
            joint_angles_rad: self.joints_measured(&node.joint_angles_rad, 1.0),
            joint_rates_rad_s: self.joints_measured(&node.joint_rates_rad_s, time_s),
            wheel_momenta_n_m_s: of_wheels(&node.wheel_momenta_n_m_s, torque_n_m * time_s),
            ..node.clone()
        });
        let intervals = motion.intervals().iter().map(|interval| ControlInterval {
            joint_accelerations_rad_s2: self
                .joints_measured(&interval.joint_accelerations_rad_s2, time_s.powi(2)),
            joint_jerks_rad_s3: self.joints_measured(&interval.joint_jerks_rad_s3, time_s.powi(3)),
            wheel_torques_n_m: of_wheels(&interval.wheel_torques_n_m, torque_n_m),
            ..interval.clone()
        });
        Trajectory::new(nodes.collect(), intervals.collect())
            .expect("as many of each as there were")
    }
}

/// Whether a joint is near its rate or acceleration limit most of the time: then that is in the way, not effort.
/// Jerks are at their limits in gentle plans too.
fn is_at_limits(measured: &Scenario, found: &Found) -> bool {
    let (solution, limits) = (&found.solution, &measured.system().joint_limits);
    limits.iter().enumerate().any(|(joint, limits)| {
        let is_near = |value: f64, limit: f64| value.abs() > NEAR_LIMIT * limit;
        let rate = found.coordinates.joint_rate(joint);
        let (u_max, rate_max) = (limits.acceleration_max_rad_s2, limits.rate_max_rad_s);
        let steps = solution.controls.len();
        let near = (0..steps).filter(|&step| {
            let (x, u) = (solution.states.row(step), solution.controls.row(step));
            is_near(found.coordinates.accelerations(x, u)[joint], u_max)
                || is_near(x[rate], rate_max)
        });
        2 * near.count() > steps
    })
}

/// Weights with which the end is met to far below its tolerances, at a cost of effort near one.
fn hard(measured: &Scenario) -> Weights {
    let given = measured.weights();
    match measured.maneuver() {
        Maneuver::Slew(slew) => Weights {
            attitude: hard_attitude(largest_turn_rad(measured, slew)),
            angular_rate: HARD_RATE,
            joint_rate: HARD_RATE,
            ..given
        },
        Maneuver::Detumble => {
            let angular_rate = DRIFT_COST / measured.stopped_rate_rad_s().powi(2);
            Weights {
                control: HARD_DETUMBLE_EFFORT,
                angular_rate,
                joint_rate: HARD_DETUMBLE_JOINTS * angular_rate,
                ..given
            }
        }
    }
}

/// The weight of the attitude error after a slew by this angle.
fn hard_attitude(turn_rad: f64) -> f64 {
    HARD_ATTITUDE.max(HARD_SMALL_ATTITUDE / (0.5 * turn_rad.max(SMALLEST_SLEW_RAD)))
}

/// The largest angle of a slew's legs, rad.
pub(crate) fn largest_turn_rad(scenario: &Scenario, slew: &Slew) -> f64 {
    match scenario.waypoints() {
        [] => slew.angle_rad.abs(),
        _ => scenario.legs().iter().map(|leg| leg.angle_rad).fold(0.0, f64::max),
    }
}

/// About what the effort of a slew costs at least: the arm's, or the wheels' where they can do without it.
fn least_effort_cost(measured: &Scenario) -> f64 {
    let weights = measured.weights();
    let of_arm = weights.control * effort(measured);
    let coordinates = Coordinates::new(measured, Formulation::Reduced);
    let initial = coordinates.initial(measured.initial());
    let guesses = guesses(measured, &coordinates, &initial);
    let of_wheels = guesses.wheel_effort(SMALLEST_SLEW_RAD);
    of_wheels.map_or(of_arm, |effort| of_arm.min(weights.wheel_torque * effort))
}

/// About what ∫‖q̈‖² dt over the reference interval a slew takes at least, from motions that make its legs.
fn effort(measured: &Scenario) -> f64 {
    let legs = measured.legs().into_iter().filter(|leg| leg.end > leg.start);
    match measured.waypoints() {
        [] => effort_of_turn(measured),
        _ => legs.map(|leg| effort_of_turn(&measured.clone().with_leg(&leg))).sum(),
    }
}

/// The same of a slew without waypoints.
fn effort_of_turn(measured: &Scenario) -> f64 {
    let coordinates = Coordinates::new(measured, Formulation::Reduced);
    let initial = coordinates.initial(measured.initial());
    guesses(measured, &coordinates, &initial).least_effort(SMALLEST_SLEW_RAD)
}

fn guesses<'a>(
    scenario: &'a Scenario,
    coordinates: &'a Coordinates,
    initial: &'a [f64],
) -> InitialGuesses<'a> {
    InitialGuesses { scenario, coordinates, initial, steps: ESTIMATE_STEPS, substeps: 1 }
}
