//! Angular momentum is what it was at the start and what has come from outside since, and the center of mass rests.
//!
//! What comes from outside over an interval is the integral of its moment, by Simpson's rule: the plan's attitudes
//! and postures at both ends, and half way the rotation and the posture between them.

use nalgebra::{UnitQuaternion, Vector3};
use righting_results::trajectory::Trajectory;

use crate::joints::{Accelerations, Joints};
use crate::ledger::{Ledger, Worst};
use crate::model::{BaseAcceleration, Motion, State};
use crate::requirements::Requirements;

/// How far it may be off, as a share of the largest that there is at the start, has come, or arm or wheels alone have.
const MOMENTUM: f64 = 1e-4;

pub(super) fn check(asked: &Requirements, trajectory: &Trajectory, ledger: &mut Ledger) {
    let model = &asked.model;
    let mut motion = Motion::new(model);
    let coasting = vec![0.0; model.joint_count()];
    let mut momentum_and_center = |state: &State<'_>| {
        motion.set(model, state, &BaseAcceleration::default(), &coasting);
        (motion.angular_momentum(), motion.center_of_mass())
    };
    let of_wheels = |state: &State<'_>, in_store: &Vector3<f64>| {
        UnitQuaternion::from_quaternion(state.attitude) * in_store
    };
    let first = State::from_slice(&asked.start);
    let (mut first_momentum, first_center) = momentum_and_center(&first);
    let in_store = asked.wheels.at_start();
    first_momentum += of_wheels(&first, &in_store);
    let mut drift = Worst::new("angular momentum drift", "", 0.0);
    let mut wander = Worst::new("center of mass drift", "m", 0.0);
    let mut scale = first_momentum.norm();
    let mut changes = Vec::with_capacity(trajectory.nodes().len());
    let came = from_outside(asked, trajectory);
    for (node, came) in trajectory.nodes().iter().zip(came) {
        let state = State::of_node(node);
        let (momentum, center) = momentum_and_center(&state);
        let in_store = asked.wheels.sum(&node.wheel_momenta_n_m_s);
        let momentum = momentum + of_wheels(&state, &in_store);
        changes.push((momentum - first_momentum - came).norm());
        let distance_m = (center - first_center).norm();
        wander.at_most(distance_m, asked.tolerances.position_m, None, Some(node.time_s));
        // The arm's momentum alone, as if the base stood still.
        let held = State { angular_rate: Vector3::zeros(), velocity: Vector3::zeros(), ..state };
        let of_arm = momentum_and_center(&held).0;
        scale = [of_arm, in_store, came].iter().map(Vector3::norm).fold(scale, f64::max);
    }
    let scale = if scale > 0.0 { scale } else { 1.0 };
    for (node, change) in trajectory.nodes().iter().zip(changes) {
        drift.at_most(change / scale, MOMENTUM, None, Some(node.time_s));
    }
    ledger.report.momentum_drift = drift.value();
    ledger.add(drift);
    ledger.add(wander);
}

/// The momentum that has come from outside by each node, inertial axes, N m s.
fn from_outside(asked: &Requirements, trajectory: &Trajectory) -> Vec<Vector3<f64>> {
    let mut came = vec![Vector3::zeros(); trajectory.nodes().len()];
    if asked.surroundings.are_empty() {
        return came;
    }
    let model = &asked.model;
    let mut motion = Motion::new(model);
    let coasting = vec![0.0; model.joint_count()];
    let mut moment = |state: &State<'_>, time_s: f64| {
        motion.set(model, state, &BaseAcceleration::default(), &coasting);
        motion.moment_of(&asked.surroundings.at(&state.attitude, time_s))
    };
    let mut half_way = Joints::new(model.joint_count());
    for (k, ends) in trajectory.nodes().windows(2).enumerate() {
        let [start, end] = [State::of_node(&ends[0]), State::of_node(&ends[1])];
        let duration_s = ends[1].time_s - ends[0].time_s;
        let accelerations = Accelerations::of(&trajectory.intervals()[k]);
        half_way.move_on(&start, accelerations, 0.5 * duration_s);
        let [from, to] = [start, end].map(|x| UnitQuaternion::from_quaternion(x.attitude));
        let turned = from.rotation_to(&to).scaled_axis();
        let middle = UnitQuaternion::new(turned * 0.5) * from;
        let middle = State {
            attitude: middle.into_inner(),
            joint_angles: &half_way.angles,
            joint_rates: &half_way.rates,
            ..start
        };
        let sum = moment(&start, ends[0].time_s)
            + moment(&middle, ends[0].time_s + 0.5 * duration_s) * 4.0
            + moment(&end, ends[1].time_s);
        came[k + 1] = came[k] + sum * (duration_s / 6.0);
    }
    came
}
