//! The checks of a trajectory, one after the other.

use nalgebra::UnitQuaternion;
use righting_results::solution::Terminal;
use righting_results::trajectory::Trajectory;
use righting_results::verification::Verification;
use righting_scenario::scenario::{Horizon, Scenario};

use crate::goal::Goal;
use crate::jerk;
use crate::joints::Accelerations;
use crate::ledger::{Ledger, Worst};
use crate::limits;
use crate::loads;
use crate::model::{Motion, State};
use crate::momentum;
use crate::pointing;
use crate::requirements::Requirements;
use crate::simulation::{Simulation, Span};
use crate::tolerances::{Measures, at_rest_deg_s};
use crate::waypoints;
use crate::wheels;
use crate::worst_of_joints::WorstOfJoints;

/// The most a slew may miss its target by, as the norm of the attitude error's vector part.
pub const ATTITUDE_ERROR: f64 = 1e-3;
/// A slew ends at rest when neither the base's rate nor the norm of all joint rates exceeds this, deg/s:
/// in 30 s, and in a longer or shorter maneuver so much less or more.
pub const SLEW_AT_REST_DEG_S: f64 = 0.1;
/// A detumble whose end is hard ends with the arm at rest when the norm of all joint rates does not exceed
/// this share of the rate at which the base would drift.
pub const DETUMBLE_AT_REST: f64 = 0.005;
/// The same where effort and end are traded: what is left of the joints' rates trades against the base's,
/// so an optimum leaves some.
pub const TRADED_DETUMBLE_AT_REST: f64 = 0.05;

const TORQUE: f64 = 1e-6;
/// Torques below this share of what moves the system once in the maneuver's duration are none.
const NO_TORQUE: f64 = 1e-3;

/// Checks a trajectory against its scenario. See the [crate] for what is checked and how.
///
/// Never fails: a trajectory that does not even fit its scenario is one that did not pass.
pub fn verify(scenario: &Scenario, trajectory: &Trajectory) -> Verification {
    let asked = Requirements::new(scenario);
    let mut ledger = Ledger::new(scenario.resolved_system(), Verification::default());
    if !shape_fits(&asked, trajectory, &mut ledger) {
        return ledger.finish();
    }
    check_start(&asked, trajectory, &mut ledger);
    let start = State::of_node(trajectory.start()).to_vec();
    let bodies = (&asked.model, &asked.surroundings, &asked.wheels);
    let simulation = Simulation::new(bodies, asked.horizon, &start, trajectory.intervals());
    check_motion(&asked, trajectory, &simulation, &mut ledger);
    momentum::check(&asked, trajectory, &mut ledger);
    check_torques(&asked, trajectory, &mut ledger);
    limits::check(&asked, trajectory, &simulation, &mut ledger);
    jerk::check(&asked, trajectory, &mut ledger);
    loads::check(&asked, trajectory, &simulation, &mut ledger);
    wheels::check(&asked, trajectory, &mut ledger);
    pointing::check(&asked, trajectory, &simulation, &mut ledger);
    waypoints::check(&asked, trajectory.intervals(), &simulation, &mut ledger);
    check_end(&asked, &simulation.end(), &mut ledger);
    ledger.finish()
}

/// Simulates a plan open loop: the joints do what its controls say, whatever the base does. The
/// scenario may differ from the planned one in masses, lengths and start. What the end reaches, and
/// the checks of that end.
///
/// The motion is the second integration of [`verify`]; one that cannot be followed ends in NaN. A plan
/// that does not fit the scenario's arm and grid does not pass.
pub fn simulate(scenario: &Scenario, plan: &Trajectory) -> (Terminal, Verification) {
    let asked = Requirements::new(scenario);
    let mut ledger = Ledger::new(scenario.resolved_system(), Verification::default());
    if !shape_fits(&asked, plan, &mut ledger) {
        return (asked.goal.reached(&State::of_node(plan.end()), &asked.slides), ledger.finish());
    }
    let bodies = (&asked.model, &asked.surroundings, &asked.wheels);
    let simulation = Simulation::new(bodies, asked.horizon, &asked.start, plan.intervals());
    waypoints::check(&asked, plan.intervals(), &simulation, &mut ledger);
    check_end(&asked, &simulation.end(), &mut ledger);
    (asked.goal.reached(&simulation.end(), &asked.slides), ledger.finish())
}

/// Joints, steps and times are the scenario's.
fn shape_fits(asked: &Requirements, trajectory: &Trajectory, ledger: &mut Ledger) -> bool {
    let Horizon { steps, .. } = asked.horizon;
    let counts = [
        ("number of joints", trajectory.joints(), asked.model.joint_count()),
        ("number of steps", trajectory.steps(), steps),
        ("number of wheels", trajectory.wheels(), asked.wheels.len()),
    ];
    for (name, found, needed) in counts {
        if found != needed {
            ledger.require_equal(name, found, needed);
            return false;
        }
    }
    let mut times = Worst::new("time grid", "s", 0.0);
    for (k, node) in trajectory.nodes().iter().enumerate() {
        let error_s = (node.time_s - asked.horizon.time_s(k)).abs();
        times.at_most(error_s, asked.tolerances.time_s, None, Some(node.time_s));
    }
    ledger.add(times)
}

/// The first node is the start that was asked for.
fn check_start(asked: &Requirements, trajectory: &Trajectory, ledger: &mut Ledger) {
    let start = trajectory.start();
    let found = State::of_node(start).to_vec();
    let mut worst = Worst::new("start", "", 0.0);
    let tolerances = asked.tolerances.of_start(&asked.slides);
    for ((found, asked), tolerance) in found.iter().zip(&asked.start).zip(tolerances) {
        worst.at_most((found - asked).abs(), tolerance, None, Some(start.time_s));
    }
    ledger.add(worst);
}

/// Every node is where the second integration says.
fn check_motion(
    Requirements { tolerances, slides, .. }: &Requirements,
    trajectory: &Trajectory,
    simulation: &Simulation,
    ledger: &mut Ledger,
) {
    let mut norm = Worst::new("quaternion norm error", "", 0.0);
    let mut attitude = Worst::new("attitude mismatch", "rad", 0.0);
    let mut angular_rate = Worst::new("angular rate mismatch", "rad/s", 0.0);
    let mut position = Worst::new("position mismatch", "m", 0.0);
    let mut velocity = Worst::new("velocity mismatch", "m/s", 0.0);
    let of_joints = |turning: Worst, sliding: Worst| WorstOfJoints::new(slides, turning, sliding);
    let mut joint_angle = of_joints(
        Worst::new("joint angle mismatch", "rad", 0.0),
        Worst::new("joint travel mismatch", "m", 0.0),
    );
    let mut joint_rate = of_joints(
        Worst::new("joint rate mismatch", "rad/s", 0.0),
        Worst::new("joint speed mismatch", "m/s", 0.0),
    );
    for (node, truth) in trajectory.nodes().iter().zip(simulation.nodes()) {
        let time_s = Some(node.time_s);
        let found = State::of_node(node);
        let length = found.attitude.norm();
        norm.at_most((length - 1.0).abs(), tolerances.quaternion_norm, None, time_s);
        let [is, shall_be] = [found, truth].map(|x| UnitQuaternion::from_quaternion(x.attitude));
        attitude.at_most(is.angle_to(&shall_be), tolerances.attitude_rad, None, time_s);
        let rate = (found.angular_rate - truth.angular_rate).norm();
        angular_rate.at_most(rate, tolerances.angular_rate_rad_s, None, time_s);
        let error_m = (found.position - truth.position).norm();
        position.at_most(error_m, tolerances.position_m, None, time_s);
        let error_m_s = (found.velocity - truth.velocity).norm();
        velocity.at_most(error_m_s, tolerances.velocity_m_s, None, time_s);
        let joints = [
            (&mut joint_angle, found.joint_angles, truth.joint_angles, tolerances.joint_angle_rad),
            (&mut joint_rate, found.joint_rates, truth.joint_rates, tolerances.joint_rate_rad_s),
        ];
        for (worst, found, truth, tolerance) in joints {
            let allowed = tolerances.of_kinds(tolerance);
            for (joint, (found, truth)) in found.iter().zip(truth).enumerate() {
                worst.within(joint, (found - truth).abs(), allowed, node.time_s);
            }
        }
    }
    ledger.report.attitude_mismatch = attitude.value();
    ledger.report.joint_mismatch = joint_angle.value();
    ledger.report.position_mismatch = position.value();
    for worst in [norm, attitude, angular_rate, position, velocity] {
        ledger.add(worst);
    }
    joint_angle.enter(ledger);
    joint_rate.enter(ledger);
}

/// Torques and power are those of the nodes' motion.
fn check_torques(asked: &Requirements, trajectory: &Trajectory, ledger: &mut Ledger) {
    let model = &asked.model;
    let joints = model.joint_count();
    let mut motion = Motion::new(model);
    let mut torques = vec![0.0; joints * trajectory.nodes().len()];
    for (k, (node, torques)) in
        trajectory.nodes().iter().zip(torques.chunks_exact_mut(joints)).enumerate()
    {
        let control = trajectory.joint_accelerations_at(k);
        let state = State::of_node(node);
        let interval = &trajectory.intervals()[k.min(trajectory.steps() - 1)];
        let span = Span {
            start_s: node.time_s,
            accelerations: Accelerations::of(interval),
            store: asked.wheels.store(node, interval),
        };
        let outside = span.outside(&asked.surroundings, &state, 0.0);
        model.joint_torques(&state, &control, &outside, &mut motion, torques);
    }
    // Forces and speeds of joints that slide are measured by the system's size.
    let size = |joint: usize| if asked.slides[joint] { asked.size_m } else { 1.0 };
    let largest = |values: &mut dyn Iterator<Item = f64>| {
        values.fold(0.0, |largest: f64, value| largest.max(value.abs()))
    };
    let of_joints = (0..joints).cycle();
    let largest_n_m =
        largest(&mut torques.iter().zip(of_joints.clone()).map(|(torque, k)| torque * size(k)));
    let rates = trajectory.nodes().iter().flat_map(|node| &node.joint_rates_rad_s);
    let fastest_rad_s = largest(&mut rates.zip(of_joints).map(|(rate, k)| rate / size(k)));
    let Measures { torque_n_m, rate_rad_s } = asked.measures;
    let tolerance_n_m = TORQUE * largest_n_m.max(NO_TORQUE * torque_n_m);
    let tolerance_w = tolerance_n_m * fastest_rad_s.max(rate_rad_s) * joints as f64;
    let mut torque = WorstOfJoints::new(
        &asked.slides,
        Worst::new("joint torque mismatch", "N m", 0.0),
        Worst::new("joint force mismatch", "N", 0.0),
    );
    let mut power = Worst::new("power mismatch", "W", 0.0);
    for (k, (node, torques)) in
        trajectory.nodes().iter().zip(torques.chunks_exact(joints)).enumerate()
    {
        let time_s = Some(node.time_s);
        if let Some(interval) = trajectory.intervals().get(k) {
            let pairs = interval.joint_torques_n_m.iter().zip(torques);
            for (joint, (found, truth)) in pairs.enumerate() {
                let allowed = tolerance_n_m / size(joint);
                torque.at_most(joint, (found - truth).abs(), allowed, node.time_s);
            }
        }
        let rates = &node.joint_rates_rad_s;
        let truth: f64 = torques.iter().zip(rates).map(|(torque, rate)| torque * rate).sum();
        power.at_most((node.power_w - truth).abs(), tolerance_w, None, time_s);
    }
    torque.enter(ledger);
    ledger.add(power);
}

/// The maneuver does what was asked, by the second integration.
fn check_end(asked: &Requirements, end: &State<'_>, ledger: &mut Ledger) {
    let time_s = Some(asked.horizon.duration_s);
    let reached = asked.goal.reached(end, &asked.slides);
    let mut single = |name, unit, value, limit| {
        let mut worst = Worst::new(name, unit, 0.0);
        worst.at_most(value, limit, None, time_s);
        ledger.add(worst);
    };
    let (base_rate, joint_rate) = match asked.goal {
        Goal::Attitude(_) => {
            single("attitude error at the end", "", reached.attitude_error, ATTITUDE_ERROR);
            let rest_deg_s = at_rest_deg_s(SLEW_AT_REST_DEG_S, asked.horizon.duration_s);
            (rest_deg_s + asked.drift_deg_s(end), rest_deg_s)
        }
        Goal::LessRate { stopped_deg_s } => {
            let share = match asked.is_end_hard {
                true => DETUMBLE_AT_REST,
                false => TRADED_DETUMBLE_AT_REST,
            };
            (stopped_deg_s, share * stopped_deg_s)
        }
    };
    single("angular rate at the end", "deg/s", reached.angular_rate_deg_s, base_rate);
    single("joint rate at the end", "deg/s", reached.joint_rate_deg_s, joint_rate);
    if let Some(speed_m_s) = reached.joint_speed_m_s {
        let limit_m_s = joint_rate.to_radians() * asked.size_m;
        single("joint speed at the end", "m/s", speed_m_s, limit_m_s);
    }
    let joints = (&asked.slides[..], asked.size_m);
    asked.end_posture.check(end, joints, asked.horizon.duration_s, ledger);
}
