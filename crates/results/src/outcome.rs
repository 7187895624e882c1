//! What a maneuver reached, and what it cost.

use nalgebra::Vector3;
use righting_multibody::{JointKind, Quaternion, State};
use righting_scenario::file::of_kind;
use righting_scenario::scenario::{Maneuver, Scenario};

use crate::solution::{Terminal, WaypointRecord};
use crate::trajectory::{ControlInterval, Trajectory};

impl Terminal {
    /// What the last node of a trajectory reached.
    pub fn reached(scenario: &Scenario, trajectory: &Trajectory) -> Self {
        Self::of(scenario, &trajectory.end().state())
    }

    /// What a state at the end of the maneuver reached.
    pub fn of(scenario: &Scenario, end: &State<f64>) -> Self {
        let attitude = end.attitude.normalized();
        let (attitude_error, attitude_error_deg) = match scenario.maneuver() {
            Maneuver::Slew(slew) => (
                attitude.error_vector(&slew.target).norm(),
                attitude.angle_to(&slew.target).to_degrees(),
            ),
            Maneuver::Detumble => (0.0, 0.0),
        };
        Self {
            attitude_error,
            attitude_error_deg,
            angular_rate_deg_s: end.angular_rate.norm().to_degrees(),
            joint_rate_deg_s: rate_of(scenario, &end.joint_rates, JointKind::Revolute).to_degrees(),
            joint_speed_m_s: slides(scenario)
                .then(|| rate_of(scenario, &end.joint_rates, JointKind::Prismatic)),
        }
    }

    /// By how much less the base turns after a detumble than with the arm simply stopped at the start
    /// ([`Scenario::stopped_rate_rad_s`]), %.
    pub fn reduction_percent(&self, scenario: &Scenario) -> f64 {
        let stopped_deg_s = scenario.stopped_rate_rad_s().to_degrees();
        100.0 * (1.0 - self.angular_rate_deg_s / stopped_deg_s)
    }
}

impl WaypointRecord {
    /// What the nodes of a trajectory reach at each waypoint of its scenario; one that has fewer nodes than the
    /// scenario reaches nothing.
    pub fn reached(scenario: &Scenario, trajectory: &Trajectory) -> Vec<Self> {
        let horizon = scenario.horizon();
        let waypoints = scenario.waypoints().iter();
        waypoints
            .map(|waypoint| {
                let [arrival, departure] = waypoint.nodes(horizon.steps);
                let nodes = trajectory.nodes().get(arrival..=departure).unwrap_or_default();
                let times = Self {
                    arrival_s: horizon.time_s(arrival),
                    departure_s: horizon.time_s(departure),
                    ..Self::default()
                };
                nodes.iter().fold(times, |worst, node| {
                    worst.with(scenario, &node.state(), &waypoint.target)
                })
            })
            .collect()
    }

    fn with(self, scenario: &Scenario, state: &State<f64>, target: &Quaternion<f64>) -> Self {
        let attitude = state.attitude.normalized();
        let [turning, sliding] = [JointKind::Revolute, JointKind::Prismatic]
            .map(|kind| rate_of(scenario, &state.joint_rates, kind));
        let angle_deg = attitude.angle_to(target).to_degrees();
        let rate_deg_s = state.angular_rate.norm().to_degrees();
        Self {
            attitude_error: self.attitude_error.max(attitude.error_vector(target).norm()),
            attitude_error_deg: self.attitude_error_deg.max(angle_deg),
            angular_rate_deg_s: self.angular_rate_deg_s.max(rate_deg_s),
            joint_rate_deg_s: self.joint_rate_deg_s.max(turning.to_degrees()),
            joint_speed_m_s: slides(scenario)
                .then(|| self.joint_speed_m_s.unwrap_or(0.0).max(sliding)),
            ..self
        }
    }
}

/// The objective of a trajectory in its scenario's weights: w_u ∫ q̈ᵀq̈ dt / 0.05 s and the
/// weighted squared errors of the last node, the same integral of the wheels' torques, and the weighted duration where that was free. Position, velocity
/// and rates shall be zero; joint angles those in which the joints shall end, and where that is open those of the
/// start, as the attitude of a detumble. Where the base may drift, its rate is the one beyond the drift. Joints
/// that slide count by the system's size.
pub fn objective(scenario: &Scenario, trajectory: &Trajectory) -> f64 {
    let weights = scenario.weights();
    let initial = scenario.initial();
    let desired = match scenario.maneuver() {
        Maneuver::Slew(slew) => slew.target,
        Maneuver::Detumble => initial.attitude,
    };
    let end = trajectory.end().state();
    let rate = match scenario.may_drift() {
        false => end.angular_rate,
        true => {
            let model = &scenario.system().model;
            model.reduced_angular_rate(&end.joint_angles, &end.joint_rates, &Vector3::zeros())
        }
    };
    let step_s = scenario.horizon().step_s();
    let counts = scenario.system().radians_a_unit();
    let effort: f64 = trajectory.intervals().iter().map(|i| mean_square(i, &counts, step_s)).sum();
    let intervals = trajectory.intervals().iter();
    let wheel_effort: f64 = intervals.map(|i| sum_of_squares(&i.wheel_torques_n_m)).sum();
    let desired_angles = scenario.desired_joint_angles_rad();
    let angles = end.joint_angles.iter().zip(&desired_angles);
    let joint_errors: Vec<f64> = angles.map(|(end, desired)| end - desired).collect();
    weights.control_per_step(scenario.horizon()) * effort
        + weights.time * scenario.horizon().duration_s
        + weights.position * end.position.norm_squared()
        + weights.attitude * end.attitude.error_vector(&desired).norm_squared()
        + weights.velocity * end.velocity.norm_squared()
        + weights.angular_rate * rate.norm_squared()
        + weights.joint_angle * counted_squares(&joint_errors, &counts)
        + weights.joint_rate * counted_squares(&end.joint_rates, &counts)
        + weights.wheel_torque_per_step(scenario.horizon()) * wheel_effort
        + weights.wheel_momentum * sum_of_squares(&trajectory.end().wheel_momenta_n_m_s)
}

/// The mean of ‖q̈‖² over an interval; q̈ is linear in it. A unit of a joint's coordinate counts so much.
fn mean_square(interval: &ControlInterval, counts: &[f64], step_s: f64) -> f64 {
    let first = interval.joint_accelerations_rad_s2.iter().zip(counts).enumerate();
    let of_joint = |(joint, (acceleration, counts)): (usize, (&f64, &f64))| {
        let acceleration = acceleration * counts;
        let gained = step_s * interval.joint_jerk_rad_s3(joint) * counts;
        acceleration * acceleration + acceleration * gained + gained * gained / 3.0
    };
    first.map(of_joint).sum()
}

/// Of joints' values, a unit of which counts so much.
fn counted_squares(values: &[f64], counts: &[f64]) -> f64 {
    values.iter().zip(counts).map(|(value, counts)| (value * counts).powi(2)).sum()
}

fn sum_of_squares(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

/// Whether any joint slides.
fn slides(scenario: &Scenario) -> bool {
    scenario.system().model.joint_kinds().contains(&JointKind::Prismatic)
}

/// The norm of the rates of the joints of one kind.
fn rate_of(scenario: &Scenario, rates: &[f64], kind: JointKind) -> f64 {
    let rates = of_kind(&scenario.system().model.joint_kinds(), kind, rates);
    rates.iter().map(|rate| rate * rate).sum::<f64>().sqrt()
}
