//! The attitudes that a slew reaches on the way: from arrival to departure the attitude is held, and where the
//! scenario says so base and joints are at rest. By the second integration, at its nodes and between them.

use nalgebra::UnitQuaternion;
use righting_results::trajectory::ControlInterval;
use righting_scenario::file;
use righting_scenario::scenario::Horizon;

use crate::goal::Goal;
use crate::ledger::{Ledger, Worst};
use crate::model::State;
use crate::requirements::Requirements;
use crate::simulation::{Follower, Simulation};
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

/// Parts of an interval at whose ends a waypoint is looked at.
const PARTS: usize = 5;

pub(super) fn check(
    asked: &Requirements,
    intervals: &[ControlInterval],
    simulation: &Simulation,
    ledger: &mut Ledger,
) {
    let rest_deg_s = at_rest_deg_s(SLEW_AT_REST_DEG_S, asked.horizon.duration_s);
    let mut follower = Follower::new(&asked.model, &asked.surroundings);
    for (index, waypoint) in asked.waypoints.iter().enumerate() {
        let [first, last] = waypoint.nodes;
        let mut attitude = Worst::new("attitude error at a waypoint", "", 0.0);
        let mut base = Worst::new("angular rate at a waypoint", "deg/s", 0.0);
        let mut joints = Worst::new("joint rate at a waypoint", "deg/s", 0.0);
        let mut sliding = Worst::new("joint speed at a waypoint", "m/s", 0.0);
        let mut look = |state: &State<'_>, time_s: f64| {
            let time_s = Some(time_s);
            let reached = waypoint.goal.reached(state, &asked.slides);
            attitude.at_most(reached.attitude_error, ATTITUDE_ERROR, None, time_s);
            if waypoint.is_at_rest {
                let most_deg_s = rest_deg_s + asked.drift_deg_s(state);
                base.at_most(reached.angular_rate_deg_s, most_deg_s, None, time_s);
                joints.at_most(reached.joint_rate_deg_s, rest_deg_s, None, time_s);
                if let Some(speed_m_s) = reached.joint_speed_m_s {
                    let rest_m_s = rest_deg_s.to_radians() * asked.size_m;
                    sliding.at_most(speed_m_s, rest_m_s, None, time_s);
                }
            }
        };
        for (k, state) in simulation.nodes().enumerate().take(last + 1).skip(first) {
            let start_s = asked.horizon.time_s(k);
            look(&state, start_s);
            let Some(interval) = intervals.get(k).filter(|_| k < last) else { continue };
            let span = simulation.span(asked, k, interval);
            let part_s = (asked.horizon.time_s(k + 1) - start_s) / PARTS as f64;
            let mut x = state.to_vec();
            for part in 1..PARTS {
                let before_s = (part - 1) as f64 * part_s;
                follower.advance(&mut x, span, before_s, part_s);
                look(&State::from_slice(&x), start_s + part as f64 * part_s);
            }
        }
        let subject = format!("waypoint {}", index + 1);
        for worst in [attitude, base, joints, sliding] {
            ledger.add_of(worst, &subject);
        }
    }
}
