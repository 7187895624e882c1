//! The optimal control problem of a scenario.
//!
//! ```text
//! min  Σ_{k<N} w_u (Δt / 0.05 s) ‖u_k‖² + e_Nᵀ Q e_N,   e = [r_d − r; vec(q_d⁻¹ ⊗ q_BN); ω_d − ω; ṙ_d − ṙ; q_d − q; q̇_d − q̇]
//! s.t. joint angle, rate and acceleration limits, dist² ≥ (clearance)², loads within the steps, boresights on
//!      their side of cones
//! ```
//!
//! (the paper's equations 6–14), w_T T where the duration T is free, and q_N as far as the scenario gives the
//! posture at the end. The desired position, velocity, rates and joint angles are those of the system at rest
//! where it starts, or ends. Distances are squared: the feasible set is the same, and the square is smooth where
//! two links meet.

mod cones;
mod coordinates;
mod loads;
mod posture;
mod stage_limits;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use righting_multibody::{Quaternion, State, System};
use righting_ocp::{ComponentBounds, ControlProblem};
use righting_scalar::Scalar;
use righting_symbolic::{Expr, trace};

pub(crate) use cones::Cones;
pub(crate) use coordinates::Coordinates;
pub(crate) use loads::Loads;
use posture::EndPosture;
use righting_scenario::collision::{Between, CollisionModel};
use righting_scenario::file::Formulation;
use righting_scenario::scenario::{Maneuver, Scenario, Weights};
pub(crate) use stage_limits::StageLimits;

/// A scenario as an optimal control problem: what [`Planner`](crate::Planner) transcribes and solves.
pub struct FormulatedManeuver {
    /// The problem, in continuous time.
    pub problem: ControlProblem,
    pub(crate) coordinates: Coordinates,
    /// Its initial state x_0: [r, q_BN, ṙ, ω, q, q̇] in the full form, [q_BN, q, q̇] in the reduced.
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
        }
        let accelerations: Vec<f64> =
            limits.iter().map(|limits| limits.acceleration_max_rad_s2).collect();

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
        let stage_bounds = stage_limits.bounds(limits, (&clearances, &loads, &cones));
        let kept = (clearances, loads, cones);
        let within = (stage_limits.clone(), coordinates.clone(), kept);
        if let (Some(index), Some(free)) = (coordinates.duration(), scenario.free_duration()) {
            state_bounds.lower[index] = free.shortest_s / scenario.horizon().duration_s;
            state_bounds.upper[index] = 1.0;
        }
        let free: Vec<usize> = coordinates.duration().into_iter().collect();
        let longest = weights.time * scenario.horizon().duration_s;
        let running = coordinates.clone();
        let posture = EndPosture::new(scenario, &coordinates);
        let end = coordinates.clone();
        let problem = ControlProblem::new(states, limits.len(), move |x, u| dynamics.rates(x, u))
            .free_initial_states(&free)
            .running_cost(move |x, u| sum_of_squares(u) * running.duration_share(x) * control)
            .terminal_cost(move |x| {
                let end = goal.cost(&terminal.free_floating_state(x), &weights);
                match longest > 0.0 {
                    true => end + terminal.duration_share(x) * longest,
                    false => end,
                }
            })
            .state_bounds(state_bounds)
            .control_bounds(ComponentBounds::symmetric(&accelerations))
            .path_constraints(path_bounds, move |x| {
                let (coordinates, clearances, cones) = &path;
                let mut values = clearances.squared_distances(coordinates.joint_angles(x));
                values.extend(cones.cosines(coordinates, x));
                values
            })
            .stage_constraints(stage_bounds, move |x, u, h| {
                let (stage_limits, coordinates, (clearances, loads, cones)) = &within;
                let h = h * coordinates.duration_share(x);
                stage_limits.values(coordinates, (clearances, loads, cones), (x, u), h)
            })
            .terminal_constraints(posture.bounds(), move |x| posture.values(&end, x));
        // The paper transcribes all states, and which ones there are decides where its guess leads.
        let problem = match scenario.solver().is_paper() {
            true => problem.keep_passive_states(),
            false => problem,
        };
        Self { problem, coordinates, initial }
    }
}

/// The state that the terminal cost asks for; rates and velocity are zero.
struct Goal {
    attitude: Quaternion<f64>,
    joint_angles_rad: Vec<f64>,
}

impl Goal {
    fn of(scenario: &Scenario) -> Self {
        let initial = scenario.initial();
        let attitude = match scenario.maneuver() {
            Maneuver::Slew(slew) => slew.target,
            Maneuver::Detumble => initial.attitude,
        };
        Self { attitude, joint_angles_rad: scenario.desired_joint_angles_rad() }
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
        let terms = [
            (weights.position, sum_of_squares(state.position.as_slice())),
            (weights.attitude, sum_of_squares(attitude_error.as_slice())),
            (weights.velocity, sum_of_squares(state.velocity.as_slice())),
            (weights.angular_rate, sum_of_squares(state.angular_rate.as_slice())),
            (weights.joint_angle, sum_of_squares(&joint_errors)),
            (weights.joint_rate, sum_of_squares(&state.joint_rates)),
        ];
        // A term without weight is left out, not multiplied by zero: what it reads stays passive.
        terms
            .into_iter()
            .filter(|(weight, _)| *weight > 0.0)
            .fold(T::from(0.0), |sum, (weight, term)| sum + term * weight)
    }
}

/// The optimizers relax bounds of one or less by 1e-8 and leave residuals up to that. Where a distance may be
/// less than this share of the system's size, that shows, …
const SMALL: f64 = 0.025;
/// … so this much more is asked of its square, …
const RELAXED: f64 = 2e-8;
/// … measured by the size times so many times the distance, if that is less than the size's square. Measured
/// by the distance's own square the solves take 2.6 times the iterations.
const RELATIVE_TO: f64 = 200.0;

/// The squared distances that the joint angles decide, with their smallest values.
#[derive(Clone)]
pub(crate) struct Clearances {
    pub(crate) system: Arc<System>,
    collision: CollisionModel,
    /// Which of all squared distances depend on the joint angles.
    varying: Vec<usize>,
    /// Whether each is stated relative to the least that is allowed: the optimizer's tolerances are
    /// absolute, and a clearance may be a small part of the system. The paper's are not.
    is_relative: bool,
}

impl Clearances {
    pub(crate) fn new(scenario: &Scenario) -> Self {
        let mut clearances = Self {
            system: Arc::new(scenario.system().model.clone()),
            collision: scenario.collision().clone(),
            varying: Vec::new(),
            is_relative: !scenario.solver().is_paper(),
        };
        clearances.varying = trace(|| {
            let q = Expr::symbols("q", clearances.system.joint_count());
            let distances = clearances.all_squared_distances(&q);
            (0..distances.len()).filter(|&i| distances[i].as_constant().is_none()).collect()
        });
        clearances
    }

    fn all_squared_distances<T: Scalar>(&self, q: &[T]) -> Vec<T> {
        let to_body = self.collision.body_links.iter();
        let between = self.collision.link_pairs.iter();
        to_body
            .map(|&link| self.system.squared_distance_to_base(q, link))
            .chain(between.map(|&(a, b)| self.system.squared_distance_between(q, a, b)))
            .collect()
    }

    fn squared_distances<T: Scalar>(&self, q: &[T]) -> Vec<T> {
        let all = self.all_squared_distances(q);
        let places = self.varying.iter().enumerate();
        places.map(|(place, &index)| all[index] * self.measure(place).0.recip()).collect()
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.varying.len()
    }

    /// Between what the one at `place` is.
    pub(crate) fn between(&self, place: usize) -> Between {
        let (index, body_links) = (self.varying[place], &self.collision.body_links);
        match body_links.get(index) {
            Some(&link) => Between::LinkAndBody(link),
            None => {
                let (a, b) = self.collision.link_pairs[index - body_links.len()];
                Between::Links(a, b)
            }
        }
    }

    /// The least that is allowed of the one at `place`.
    pub(crate) fn least_m(&self, place: usize) -> f64 {
        match self.between(place) {
            Between::LinkAndBody(_) => self.collision.body_distance_m,
            Between::Links(..) => self.collision.clearance_m,
        }
    }

    /// How far links keep from each other.
    pub(crate) fn clearance_m(&self) -> f64 {
        self.collision.clearance_m
    }

    /// What the squared distance at `place` is measured by, and how much more is asked of it.
    fn measure(&self, place: usize) -> (f64, f64) {
        let size = self.system.size_m();
        let least = self.least_m(place);
        match self.is_relative && least > 0.0 && least < SMALL * size {
            true => (size * size.min(RELATIVE_TO * least), RELAXED),
            false => (1.0, 0.0),
        }
    }

    /// The one at `place`, as it is stated.
    fn squared_distance<T: Scalar>(&self, q: &[T], place: usize) -> T {
        let squared = match self.between(place) {
            Between::LinkAndBody(link) => self.system.squared_distance_to_base(q, link),
            Between::Links(a, b) => self.system.squared_distance_between(q, a, b),
        };
        squared * self.measure(place).0.recip()
    }

    /// The least that the one at `place` may be, as it is stated.
    fn least_squared(&self, place: usize) -> f64 {
        let (measure, more) = self.measure(place);
        self.least_m(place).powi(2) / measure + more
    }

    fn bounds(&self) -> ComponentBounds {
        let lower: Vec<f64> = (0..self.len()).map(|place| self.least_squared(place)).collect();
        let upper = vec![f64::INFINITY; lower.len()];
        ComponentBounds::new(lower, upper)
    }
}

/// The bounds of some components and those of others after them.
fn joined(mut first: ComponentBounds, second: ComponentBounds) -> ComponentBounds {
    first.lower.extend(second.lower);
    first.upper.extend(second.upper);
    first
}

fn sum_of_squares<T: Scalar>(values: &[T]) -> T {
    values.iter().fold(T::from(0.0), |sum, &value| sum + value * value)
}
