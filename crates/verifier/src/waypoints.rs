//! The attitudes that a slew reaches on the way: from arrival to departure the attitude is held, and where the
//! scenario says so base and joints are at rest. By the second integration, at its nodes.

use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};
use righting_scenario::file;
use righting_scenario::scenario::Horizon;

use crate::goal::attitude_error;
use crate::ledger::{Ledger, Worst};
use crate::model::State;
use crate::requirements::Requirements;
use crate::simulation::Simulation;
use crate::tolerances::at_rest_deg_s;
use crate::verify::{ATTITUDE_ERROR, SLEW_AT_REST_DEG_S};

/// One of them.
#[derive(Clone, Debug)]
pub(super) struct Waypoint {
    /// Body → inertial.
    target: UnitQuaternion<f64>,
    is_at_rest: bool,
    /// First and last node.
    nodes: [usize; 2],
}

/// Those of a resolved maneuver that starts in the attitude `start`; each is reached as long after the one before
/// is left as the file says.
pub(super) fn waypoints(
    maneuver: &file::Maneuver,
    start: &UnitQuaternion<f64>,
    horizon: Horizon,
) -> Vec<Waypoint> {
    let mut time_s = 0.0;
    let waypoints = maneuver.waypoints.iter();
    waypoints
        .map(|waypoint| {
            let nodes = [waypoint.duration_s, waypoint.dwell_s].map(|after_s| {
                time_s += after_s.unwrap_or(0.0);
                (time_s / horizon.step_s()).round() as usize
            });
            Waypoint {
                target: target(waypoint, start),
                is_at_rest: waypoint.rest.unwrap_or(true),
                nodes,
            }
        })
        .collect()
}

fn target(waypoint: &file::Waypoint, start: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    match waypoint.target_attitude {
        Some([w, x, y, z]) => UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)),
        None => {
            // One without them was refused when the scenario was read.
            let axis = Unit::new_normalize(Vector3::from(waypoint.axis.unwrap_or_default()));
            let angle_rad = waypoint.angle_deg.unwrap_or(f64::NAN).to_radians();
            start * UnitQuaternion::from_axis_angle(&axis, angle_rad)
        }
    }
}

pub(super) fn check(asked: &Requirements, simulation: &Simulation, ledger: &mut Ledger) {
    let rest_deg_s = at_rest_deg_s(SLEW_AT_REST_DEG_S, asked.horizon.duration_s);
    for (index, waypoint) in asked.waypoints.iter().enumerate() {
        let [first, last] = waypoint.nodes;
        let mut attitude = Worst::new("attitude error at a waypoint", "", 0.0);
        let mut base = Worst::new("angular rate at a waypoint", "deg/s", 0.0);
        let mut joints = Worst::new("joint rate at a waypoint", "deg/s", 0.0);
        for (k, state) in simulation.nodes().enumerate().take(last + 1).skip(first) {
            let time_s = Some(asked.horizon.time_s(k));
            let error = attitude_error(&waypoint.target, &state).imag().norm();
            attitude.at_most(error, ATTITUDE_ERROR, None, time_s);
            if waypoint.is_at_rest {
                let rate_deg_s = state.angular_rate.norm().to_degrees();
                base.at_most(rate_deg_s, rest_deg_s, None, time_s);
                joints.at_most(joint_rate_deg_s(&state), rest_deg_s, None, time_s);
            }
        }
        let subject = format!("waypoint {}", index + 1);
        for worst in [attitude, base, joints] {
            ledger.add_of(worst, &subject);
        }
    }
}

fn joint_rate_deg_s(state: &State<'_>) -> f64 {
    state.joint_rates.iter().map(|rate| rate * rate).sum::<f64>().sqrt().to_degrees()
}
