//! The optimal control problem of a scenario.
//!
//! ```text
//! min  ∫ (w_u ‖q̈‖² + w_τ ‖τ_w‖²) dt / 0.05 s + e_Nᵀ Q e_N,   e = [r_d − r; vec(q_d⁻¹ ⊗ q_BN); ω_d − ω; ṙ_d − ṙ; q_d − q; q̇_d − q̇]
//! s.t. joint angle, rate and acceleration limits, momenta and torques of wheels, dist² ≥ (clearance)², loads within the steps, boresights on
//!      their side of cones
//! ```
//!
//! (the paper's equations 6–14), the errors at waypoints, w_T T where the duration T is free, q_N as far as the scenario gives the
//! posture at the end, and q̈_0 = q̈_N = 0 where jerks are limited. The desired position, velocity, rates and joint angles are those of the system at rest
//! where it starts, or ends; the angular rate is the one beyond the drift where something acts from outside. Distances of capsules are squared: the feasible set is the same, and the square is
//! smooth where two links meet. Those of boxes are signed, so that they say how to get out.

mod clearances;
mod cones;
mod coordinates;
mod end_conditions;
mod loads;
mod spread;
mod stage_limits;
#[cfg(test)]
mod tests;
mod waypoints;
mod wheels;

use nalgebra::Vector3;
use righting_multibody::{Quaternion, State, System};
use righting_ocp::{ComponentBounds, ControlProblem, Expr};
use righting_scalar::Scalar;

pub(crate) use clearances::Clearances;
pub(crate) use cones::Cones;
pub(crate) use coordinates::Coordinates;
use end_conditions::EndConditions;
pub(crate) use loads::Loads;
use righting_scenario::file::Formulation;
use righting_scenario::scenario::{Maneuver, Scenario, Weights};
pub(crate) use spread::Spread;
pub(crate) use stage_limits::StageLimits;
use waypoints::Waypoints;
pub(crate) use wheels::Wheels;

/// A scenario as an optimal control problem: what [`Planner`](crate::Planner) transcribes and solves.
pub struct FormulatedManeuver {
    /// The problem, in continuous time.
    pub problem: ControlProblem,
    pub(crate) coordinates: Coordinates,
    /// Its initial state x_0: [r, q_BN, ṙ, ω, q, q̇] in the full form, [q_BN, q, q̇] in the reduced; then the
    /// accelerations where jerks are limited.
    pub initial: Vec<f64>,
}

impl FormulatedManeuver {
    /// In the scenario's own form.
    pub fn new(scenario: &Scenario) -> Self {
        Self::in_form(scenario, scenario.solver().formulation, &StageLimits::asked())
    }

    /// In a form, with limits that are stated within the steps too.
    pub(crate) fn in_form(
        scenario: &Scenario,
        formulation: Formulation,
        stage_limits: &StageLimits,
    ) -> Self {
        let coordinates = Coordinates::new(scenario, formulation);
        let initial = coordinates.initial(scenario.initial());
        let states = coordinates.dimension();
        let limits = &scenario.system().joint_limits;

        let mut state_bounds = ComponentBounds::unbounded(states);
        for (joint, limits) in limits.iter().enumerate() {
            if coordinates.is_locked(joint) {
                continue;
            }
            let (angle, rate) = (coordinates.joint_angle(joint), coordinates.joint_rate(joint));
            state_bounds.lower[angle] = limits.angle_min_rad;
            state_bounds.upper[angle] = limits.angle_max_rad;
            state_bounds.lower[rate] = -limits.rate_max_rad_s;
            state_bounds.upper[rate] = limits.rate_max_rad_s;
            if let Some(acceleration) = coordinates.joint_acceleration(joint) {
                state_bounds.lower[acceleration] = -limits.acceleration_max_rad_s2;
                state_bounds.upper[acceleration] = limits.acceleration_max_rad_s2;
            }
        }
        state_bounds.lower[coordinates.wheels()].fill(-1.0);
        state_bounds.upper[coordinates.wheels()].fill(1.0);
        let counts = scenario.system().radians_a_unit();
        let controls: Vec<f64> = limits
            .iter()
            .map(|limits| match coordinates.has_jerk() {
                true => limits.jerk_max_rad_s3,
                false => limits.acceleration_max_rad_s2,
            })
            .chain(coordinates.wheel_set().rate_bounds())
            .collect();

        let dynamics = coordinates.clone();
        let terminal = coordinates.clone();
        let weights = scenario.weights();
        let control = weights.control_per_step(scenario.horizon());
        let goal = Goal::of(scenario);
        let clearances = Clearances::new(scenario);
        let cones = Cones::new(scenario);
        let path = (coordinates.clone(), clearances.clone(), cones.clone());
        let path_bounds = joined(clearances.bounds(), cones.bounds());
        let loads = Loads::new(scenario);
        let stage_bounds = joined(
            stage_limits.bounds(&coordinates, limits, (&clearances, &loads, &cones)),
            coordinates.wheel_set().motor_bounds(),
        );
        let kept = (clearances, loads, cones);
        let within = (stage_limits.clone(), coordinates.clone(), kept);
        if let (Some(index), Some(free)) = (coordinates.duration(), scenario.free_duration()) {
            state_bounds.lower[index] = free.shortest_s / scenario.horizon().duration_s;
            state_bounds.upper[index] = 1.0;
        }
        let free: Vec<usize> = coordinates.duration().into_iter().collect();
        let longest = weights.time * scenario.horizon().duration_s;
        let running = coordinates.clone();
        let waypoints = Waypoints::new(scenario);
        let end = EndConditions::new(scenario, &coordinates);
        let wheel_torque = weights.wheel_torque_per_step(scenario.horizon());
        let problem = ControlProblem::new(states, controls.len(), move |x, u| dynamics.rates(x, u))
            .free_initial_states(&free)
            .running_cost(move |x, u, step| {
                let of_joints =
                    effort(&running, &counts, x, u, step.length) * running.duration_share(x);
                let of_wheels = running.wheel_set().sum_of_squares(running.wheel_rates(u))
                    * running.duration_share(x);
                of_joints * control + of_wheels * wheel_torque + waypoints.cost(&running, x, step)
            })
            .terminal_cost(move |x| {
                let mut end = goal.cost(&terminal.free_floating_state(x), &weights);
                if weights.wheel_momentum > 0.0 {
                    let momenta = terminal.wheel_set().sum_of_squares(&x[terminal.wheels()]);
                    end += momenta * weights.wheel_momentum;
                }
                match longest > 0.0 {
                    true => end + terminal.duration_share(x) * longest,
                    false => end,
                }
            })
            .state_bounds(state_bounds)
            .control_bounds(ComponentBounds::symmetric(&controls))
            .path_constraints(path_bounds, move |x| {
                let (coordinates, clearances, cones) = &path;
                let mut values = clearances.distances(coordinates.joint_angles(x));
                values.extend(cones.cosines(coordinates, x));
                values
            })
            .stage_constraints(stage_bounds, move |x, u, h| {
                let (stage_limits, coordinates, (clearances, loads, cones)) = &within;
                let h = h * coordinates.duration_share(x);
                let mut values =
                    stage_limits.values(coordinates, (clearances, loads, cones), (x, u), h);
                let wheels = (&x[coordinates.wheels()], coordinates.wheel_rates(u));
                values.extend(coordinates.wheel_set().motor_torques(wheels, h));
                values
            })
            .terminal_constraints(end.bounds(), move |x| end.values(x));
        // The paper transcribes all states, and which ones there are decides where its guess leads.
        let problem = match scenario.solver().is_paper() {
            true => problem.keep_passive_states(),
            false => problem,
        };
        Self { problem, coordinates, initial }
    }
}

/// The mean of ‖q̈‖² over a step of length `h` in the time of the grid; of a locked joint, whose control does
/// nothing, that of its control. Where the jerk is held it is Σ q̈² + q̈ h q⃛ + h² q⃛²/3: no other weight on
/// the jerk is needed to determine it.
///
/// A unit of a joint's coordinate counts so many radians.
fn effort(coordinates: &Coordinates, counts: &[f64], x: &[Expr], u: &[Expr], h: Expr) -> Expr {
    let u = &u[..u.len() - coordinates.wheels().len()];
    if !coordinates.has_jerk() {
        return sum_of_squares(&counted(u, counts));
    }
    let h = h * coordinates.duration_share(x);
    let accelerations = counted(&coordinates.accelerations(x, u), counts);
    let jerks = counted(u, counts);
    accelerations.iter().zip(&jerks).fold(Expr::constant(0.0), |sum, (&begins, &jerk)| {
        let gained = h * jerk;
        sum + begins * begins + begins * gained + gained * gained * (1.0 / 3.0)
    })
}

/// The state that the terminal cost asks for; rates and velocity are zero.
struct Goal {
    attitude: Quaternion<f64>,
    joint_angles_rad: Vec<f64>,
    /// The system where its base may drift: then it is the rate beyond that drift that shall be zero.
    drifting: Option<System>,
    /// What a unit of each joint's coordinate counts, rad.
    counts: Vec<f64>,
}

impl Goal {
    fn of(scenario: &Scenario) -> Self {
        let initial = scenario.initial();
        let attitude = match scenario.maneuver() {
            Maneuver::Slew(slew) => slew.target,
            Maneuver::Detumble => initial.attitude,
        };
        Self {
            attitude,
            joint_angles_rad: scenario.desired_joint_angles_rad(),
            drifting: scenario.may_drift().then(|| scenario.system().model.clone()),
            counts: scenario.system().radians_a_unit(),
        }
    }

    fn cost<T: Scalar>(&self, state: &State<T>, weights: &Weights) -> T {
        let desired = Quaternion::from_array(self.attitude.to_array().map(T::from));
        let attitude_error = state.attitude.error_vector(&desired);
        let joint_errors: Vec<T> = state
            .joint_angles
            .iter()
            .zip(&self.joint_angles_rad)
            .map(|(&q, &goal)| q - goal)
            .collect();
        let rate = match &self.drifting {
            None => state.angular_rate,
            Some(system) => {
                let still = Vector3::from_element(T::from(0.0));
                system.reduced_angular_rate(&state.joint_angles, &state.joint_rates, &still)
            }
        };
        let terms = [
            (weights.position, sum_of_squares(state.position.as_slice())),
            (weights.attitude, sum_of_squares(attitude_error.as_slice())),
            (weights.velocity, sum_of_squares(state.velocity.as_slice())),
            (weights.angular_rate, sum_of_squares(rate.as_slice())),
            (weights.joint_angle, sum_of_squares(&counted(&joint_errors, &self.counts))),
            (weights.joint_rate, sum_of_squares(&counted(&state.joint_rates, &self.counts))),
        ];
        // A term without weight is left out, not multiplied by zero: what it reads stays passive.
        terms
            .into_iter()
            .filter(|(weight, _)| *weight > 0.0)
            .fold(T::from(0.0), |sum, (weight, term)| sum + term * weight)
    }
}

/// The bounds of some components and those of others after them.
fn joined(mut first: ComponentBounds, second: ComponentBounds) -> ComponentBounds {
    first.lower.extend(second.lower);
    first.upper.extend(second.upper);
    first
}

/// What joints' values count in radians.
fn counted<T: Scalar>(values: &[T], counts: &[f64]) -> Vec<T> {
    let listed = values.iter().zip(counts);
    listed.map(|(&value, &counts)| if counts == 1.0 { value } else { value * counts }).collect()
}

fn sum_of_squares<T: Scalar>(values: &[T]) -> T {
    values.iter().fold(T::from(0.0), |sum, &value| sum + value * value)
}
