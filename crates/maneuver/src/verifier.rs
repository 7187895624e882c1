//! The independent check of a trajectory.
//!
//! Nothing here comes from the planner: plain numbers, the full 13 + 2j equations of motion, an
//! integrator with its own error control (Dormand and Prince's, to 1e-11), and only the first node
//! and the controls of the trajectory as its input. What that second integration finds is compared
//! with every node, and it, not the nodes, decides whether the maneuver does what was asked. Limits
//! are looked at on the nodes and, on the second integration, between them.
//!
//! Tolerances are part of every [`Check`](crate::Check) and so of every report:
//!
//! - limits hold to 1e-6 (rad, rad/s, rad/s², m) at the nodes; between nodes, where a plan has no
//!   constraints, joint angles and clearances to 1e-3;
//! - the plan's own integration error, one step of a fourth-order method an interval, may reach
//!   1e-4 rad in attitude, a twentieth of what a slew may miss its target by. In momentum that is
//!   1e-4 of its size, in the quaternion's length 1e-5. A plan that fails here needs more steps;
//! - joints follow from the controls exactly, so they may differ by what a solver leaves of its
//!   equations: 1e-6 rad and rad/s.

mod directory;
mod ledger;
mod limits;
mod replay;

pub use directory::{SOLUTION_FILE, TRAJECTORY_FILE, Verified, verify_directory};

use crate::scenario::{Maneuver, Scenario};
use crate::solution::Terminal;
use crate::trajectory::{Node, Trajectory};
use crate::verification::Verification;
use ledger::{Ledger, Subject, Worst};
use replay::Replay;

/// The most a slew may miss its target by, as the norm of the attitude error's vector part.
pub const ATTITUDE_ERROR: f64 = 1e-3;
/// A slew ends at rest when neither the base's rate nor the norm of all joint rates exceeds this,
/// deg/s.
pub const SLEW_AT_REST_DEG_S: f64 = 0.1;
/// A detumble ends with the arm at rest when the norm of all joint rates does not exceed this, deg/s.
/// What is left trades against the base's rate, so an optimum leaves some.
pub const DETUMBLE_AT_REST_DEG_S: f64 = 1.0;

const TIME_S: f64 = 1e-9;
const QUATERNION_NORM: f64 = 1e-5;
const ATTITUDE_RAD: f64 = 1e-4;
const ANGULAR_RATE_RAD_S: f64 = 1e-4;
const POSITION_M: f64 = 1e-4;
const VELOCITY_M_S: f64 = 1e-4;
const JOINT_RAD: f64 = 1e-6;
const MOMENTUM: f64 = 1e-4;
const TORQUE: f64 = 1e-6;

/// Checks a trajectory against its scenario. See the [module](self) for what is checked and how.
///
/// Never fails: a trajectory that does not even fit its scenario is one that did not pass.
pub fn verify(scenario: &Scenario, trajectory: &Trajectory) -> Verification {
    let mut ledger = Ledger::default();
    if !shape_fits(scenario, trajectory, &mut ledger) {
        return ledger.finish();
    }
    check_start(scenario, trajectory.start(), &mut ledger);
    let replay = Replay::of(scenario, trajectory);
    check_motion(trajectory, &replay, &mut ledger);
    check_momentum(scenario, trajectory, &mut ledger);
    check_torques(scenario, trajectory, &mut ledger);
    limits::check(scenario, trajectory, &replay, &mut ledger);
    check_end(scenario, &replay.nodes()[trajectory.steps()], &mut ledger);
    ledger.finish()
}

/// Simulates a plan open loop: the joints do what its controls say, whatever the base does. The scenario
/// may differ from the planned one in masses, lengths and start. What the end reaches, and the checks
/// of that end.
///
/// The motion is the second integration of [`verify`]; one that cannot be followed ends in NaN. A plan
/// that does not fit the scenario's arm and grid does not pass.
pub fn simulate(scenario: &Scenario, plan: &Trajectory) -> (Terminal, Verification) {
    let mut ledger = Ledger::default();
    if !shape_fits(scenario, plan, &mut ledger) {
        return (Terminal::reached(scenario, plan), ledger.finish());
    }
    let simulation = Replay::from(scenario.initial().state(), scenario, plan);
    let end = &simulation.nodes()[plan.steps()];
    check_end(scenario, end, &mut ledger);
    (Terminal::of(scenario, end), ledger.finish())
}

/// Joints, steps and times are the scenario's.
fn shape_fits(scenario: &Scenario, trajectory: &Trajectory, ledger: &mut Ledger) -> bool {
    let horizon = scenario.horizon();
    let joints = scenario.system().joint_count();
    let counts = [
        ("number of joints", trajectory.joints(), joints),
        ("number of steps", trajectory.steps(), horizon.steps),
    ];
    for (name, found, needed) in counts {
        if found != needed {
            ledger.require_equal(name, found, needed);
            return false;
        }
    }
    let mut times = Worst::new("time grid", "s", 0.0);
    for (k, node) in trajectory.nodes().iter().enumerate() {
        let error_s = (node.time_s - horizon.time_s(k)).abs();
        times.at_most(error_s, TIME_S * horizon.duration_s.max(1.0), None, Some(node.time_s));
    }
    ledger.add(times)
}

/// The first node is the start that was asked for.
fn check_start(scenario: &Scenario, start: &Node, ledger: &mut Ledger) {
    let asked = scenario.initial().state().to_vec();
    let found = start.state().to_vec();
    let mut worst = Worst::new("start", "", 0.0);
    for (found, asked) in found.iter().zip(&asked) {
        worst.at_most((found - asked).abs(), JOINT_RAD, None, Some(start.time_s));
    }
    ledger.add(worst);
}

/// Every node is where the second integration says.
fn check_motion(trajectory: &Trajectory, replay: &Replay, ledger: &mut Ledger) {
    let mut norm = Worst::new("quaternion norm error", "", 0.0);
    let mut attitude = Worst::new("attitude mismatch", "rad", 0.0);
    let mut angular_rate = Worst::new("angular rate mismatch", "rad/s", 0.0);
    let mut position = Worst::new("position mismatch", "m", 0.0);
    let mut velocity = Worst::new("velocity mismatch", "m/s", 0.0);
    let mut joint_angle = Worst::new("joint angle mismatch", "rad", 0.0);
    let mut joint_rate = Worst::new("joint rate mismatch", "rad/s", 0.0);
    for (node, truth) in trajectory.nodes().iter().zip(replay.nodes()) {
        let time_s = Some(node.time_s);
        let found = node.state();
        let length = found.attitude.norm_squared().sqrt();
        norm.at_most((length - 1.0).abs(), QUATERNION_NORM, None, time_s);
        let angle = found.attitude.normalized().angle_to(&truth.attitude.normalized());
        attitude.at_most(angle, ATTITUDE_RAD, None, time_s);
        let rate = (found.angular_rate - truth.angular_rate).norm();
        angular_rate.at_most(rate, ANGULAR_RATE_RAD_S, None, time_s);
        position.at_most((found.position - truth.position).norm(), POSITION_M, None, time_s);
        velocity.at_most((found.velocity - truth.velocity).norm(), VELOCITY_M_S, None, time_s);
        let joints = [
            (&mut joint_angle, &found.joint_angles, &truth.joint_angles),
            (&mut joint_rate, &found.joint_rates, &truth.joint_rates),
        ];
        for (worst, found, truth) in joints {
            for (joint, (found, truth)) in found.iter().zip(truth).enumerate() {
                let subject = Some(Subject::Joint(joint));
                worst.at_most((found - truth).abs(), JOINT_RAD, subject, time_s);
            }
        }
    }
    ledger.report.attitude_mismatch = attitude.value();
    ledger.report.joint_mismatch = joint_angle.value();
    ledger.report.position_mismatch = position.value();
    for worst in [norm, attitude, angular_rate, position, velocity, joint_angle, joint_rate] {
        ledger.add(worst);
    }
}

/// Momentum about the center of mass stays what it was, and the center of mass where it was.
fn check_momentum(scenario: &Scenario, trajectory: &Trajectory, ledger: &mut Ledger) {
    let model = &scenario.system().model;
    let start = scenario.initial().angular_momentum_n_m_s;
    let center = |state: &righting_multibody::State<f64>| {
        let relative = model.center_of_mass(&state.joint_angles);
        state.position + state.attitude.to_inertial(&relative)
    };
    let states: Vec<_> = trajectory.nodes().iter().map(Node::state).collect();
    let scale = states
        .iter()
        .map(|state| model.h_tilde(&state.joint_angles, &state.joint_rates).norm())
        .fold(start.norm(), f64::max);
    let scale = if scale > 0.0 { scale } else { 1.0 };
    let first_center = center(&scenario.initial().state());
    let mut drift = Worst::new("angular momentum drift", "", 0.0);
    let mut wander = Worst::new("center of mass drift", "m", 0.0);
    for (node, state) in trajectory.nodes().iter().zip(&states) {
        let time_s = Some(node.time_s);
        let body =
            model.angular_momentum(&state.angular_rate, &state.joint_angles, &state.joint_rates);
        let momentum = state.attitude.to_inertial(&body);
        drift.at_most((momentum - start).norm() / scale, MOMENTUM, None, time_s);
        wander.at_most((center(state) - first_center).norm(), POSITION_M, None, time_s);
    }
    ledger.report.momentum_drift = drift.value();
    ledger.add(drift);
    ledger.add(wander);
}

/// Torques and power are those of the nodes' motion.
fn check_torques(scenario: &Scenario, trajectory: &Trajectory, ledger: &mut Ledger) {
    let model = &scenario.system().model;
    let torques: Vec<Vec<f64>> = trajectory
        .nodes()
        .iter()
        .enumerate()
        .map(|(k, node)| {
            let interval = &trajectory.intervals()[k.min(trajectory.steps() - 1)];
            let state = node.state();
            model.joint_torques(
                &state.angular_rate,
                &state.joint_angles,
                &state.joint_rates,
                &interval.joint_accelerations_rad_s2,
            )
        })
        .collect();
    let largest =
        torques.iter().flatten().fold(0.0, |largest: f64, torque| largest.max(torque.abs()));
    let fastest = trajectory
        .nodes()
        .iter()
        .flat_map(|node| &node.joint_rates_rad_s)
        .fold(0.0, |fastest: f64, rate| fastest.max(rate.abs()));
    let tolerance_n_m = TORQUE * largest.max(1e-3);
    let tolerance_w = tolerance_n_m * fastest.max(1e-3) * trajectory.joints() as f64;
    let mut torque = Worst::new("joint torque mismatch", "N m", 0.0);
    let mut power = Worst::new("power mismatch", "W", 0.0);
    for (k, (node, torques)) in trajectory.nodes().iter().zip(&torques).enumerate() {
        let time_s = Some(node.time_s);
        if let Some(interval) = trajectory.intervals().get(k) {
            let pairs = interval.joint_torques_n_m.iter().zip(torques);
            for (joint, (found, truth)) in pairs.enumerate() {
                let subject = Some(Subject::Joint(joint));
                torque.at_most((found - truth).abs(), tolerance_n_m, subject, time_s);
            }
        }
        let rates = &node.joint_rates_rad_s;
        let truth: f64 = torques.iter().zip(rates).map(|(torque, rate)| torque * rate).sum();
        power.at_most((node.power_w - truth).abs(), tolerance_w, None, time_s);
    }
    ledger.add(torque);
    ledger.add(power);
}

/// The maneuver does what was asked, by the second integration.
fn check_end(scenario: &Scenario, end: &righting_multibody::State<f64>, ledger: &mut Ledger) {
    let time_s = Some(scenario.horizon().duration_s);
    let reached = Terminal::of(scenario, end);
    let mut single = |name, unit, value, limit| {
        let mut worst = Worst::new(name, unit, 0.0);
        worst.at_most(value, limit, None, time_s);
        ledger.add(worst);
    };
    let (base_rate, joint_rate) = match scenario.maneuver() {
        Maneuver::Slew(_) => {
            single("attitude error at the end", "", reached.attitude_error, ATTITUDE_ERROR);
            (SLEW_AT_REST_DEG_S, SLEW_AT_REST_DEG_S)
        }
        Maneuver::Detumble => {
            let start_deg_s = scenario.initial().angular_rate_rad_s.norm().to_degrees();
            (start_deg_s, DETUMBLE_AT_REST_DEG_S)
        }
    };
    single("angular rate at the end", "deg/s", reached.angular_rate_deg_s, base_rate);
    single("joint rate at the end", "deg/s", reached.joint_rate_deg_s, joint_rate);
}
