//! The attitudes that a slew reaches on the way: from arrival to departure the attitude is held, and where the
//! scenario says so base and joints are at rest. By the second integration, at its nodes.

use nalgebra::UnitQuaternion;
use righting_scenario::file;
use righting_scenario::scenario::Horizon;

use crate::goal::Goal;
use crate::ledger::{Ledger, Worst};
use crate::requirements::Requirements;
use crate::simulation::Simulation;
use crate::tolerances::at_rest_deg_s;
use crate::verify::{ATTITUDE_ERROR, SLEW_AT_REST_DEG_S};

/// One of them.
#[derive(Clone, Debug)]
pub(super) struct Waypoint {
    goal: Goal,
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
            let file::Waypoint { target_attitude, axis, angle_deg, .. } = *waypoint;
            Waypoint {
                goal: Goal::to(target_attitude, axis, angle_deg, start),
                is_at_rest: waypoint.rest.unwrap_or(true),
                nodes,
            }
        })
        .collect()
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
            let reached = waypoint.goal.reached(&state);
            attitude.at_most(reached.attitude_error, ATTITUDE_ERROR, None, time_s);
            if waypoint.is_at_rest {
                let most_deg_s = rest_deg_s + asked.drift_deg_s(&state);
                base.at_most(reached.angular_rate_deg_s, most_deg_s, None, time_s);
                joints.at_most(reached.joint_rate_deg_s, rest_deg_s, None, time_s);
            }
        }
        let subject = format!("waypoint {}", index + 1);
        for worst in [attitude, base, joints] {
            ledger.add_of(worst, &subject);
        }
    }
}
