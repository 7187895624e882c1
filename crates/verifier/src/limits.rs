//! Joint limits and clearances, at the nodes and between them.

use righting_multibody::State;

use crate::ledger::{Ledger, Subject, Worst};
use crate::replay::Replay;
use righting_results::trajectory::Trajectory;
use righting_scenario::collision::{Between, CollisionModel};
use righting_scenario::scenario::Scenario;
use righting_scenario::system_description::{JointLimits, SystemDescription};

/// How far a node may be past a limit (rad, rad/s, rad/s², m).
const AT_NODES: f64 = 1e-6;
/// How far the motion between nodes may be past a limit (rad, rad/s, m).
const BETWEEN_NODES: f64 = 1e-3;
/// Places looked at within an interval.
const SAMPLES: usize = 10;

/// Worst places of the quantities that have limits.
struct Limits {
    angle: Worst,
    rate: Worst,
    body: Worst,
    links: Worst,
}

pub(super) fn check(
    scenario: &Scenario,
    trajectory: &Trajectory,
    replay: &Replay,
    ledger: &mut Ledger,
) {
    let system = scenario.system();
    let collision = scenario.collision();
    let mut at_nodes = Limits {
        angle: Worst::new("joint angle at nodes", "rad", AT_NODES),
        rate: Worst::new("joint rate at nodes", "rad/s", AT_NODES),
        body: Worst::new("clearance from body at nodes", "m", AT_NODES),
        links: Worst::new("clearance between links at nodes", "m", AT_NODES),
    };
    for node in trajectory.nodes() {
        let (angles, rates) = (&node.joint_angles_rad, &node.joint_rates_rad_s);
        at_nodes.look_at_joints(&system.joint_limits, angles, rates, node.time_s);
        at_nodes.look_at_clearances(system, collision, angles, node.time_s);
    }
    let mut between = Limits {
        angle: Worst::new("joint angle between nodes", "rad", BETWEEN_NODES),
        rate: Worst::new("joint rate between nodes", "rad/s", BETWEEN_NODES),
        body: Worst::new("clearance from body between nodes", "m", BETWEEN_NODES),
        links: Worst::new("clearance between links between nodes", "m", BETWEEN_NODES),
    };
    let mut acceleration = Worst::new("joint acceleration", "rad/s²", AT_NODES);
    for (k, interval) in trajectory.intervals().iter().enumerate() {
        let control = &interval.joint_accelerations_rad_s2;
        let start_s = scenario.horizon().time_s(k);
        let duration_s = scenario.horizon().time_s(k + 1) - start_s;
        for (joint, (limits, control)) in system.joint_limits.iter().zip(control).enumerate() {
            let limit = limits.acceleration_max_rad_s2;
            let subject = Some(Subject::Joint(joint));
            acceleration.at_most(control.abs(), limit, subject, Some(start_s));
        }
        let state = &replay.nodes()[k];
        for after_s in sampled(duration_s) {
            let (angles, rates) = joints_after(state, control, after_s);
            between.look_at_joints(&system.joint_limits, &angles, &rates, start_s + after_s);
            between.look_at_clearances(system, collision, &angles, start_s + after_s);
        }
        for (joint, limits) in system.joint_limits.iter().enumerate() {
            // A joint that turns back within the interval goes farthest between two samples.
            let after_s = -state.joint_rates[joint] / control[joint];
            if after_s > 0.0 && after_s < duration_s {
                let (angles, _) = joints_after(state, control, after_s);
                between.look_at_angle(limits, joint, angles[joint], start_s + after_s);
            }
        }
    }
    let Limits { angle, rate, body, links } = at_nodes;
    for worst in [angle, rate, acceleration, body, links] {
        ledger.add(worst);
    }
    let Limits { angle, rate, body, links } = between;
    for worst in [angle, rate, body, links] {
        ledger.add(worst);
    }
}

/// Times within an interval, its ends left out.
fn sampled(duration_s: f64) -> impl Iterator<Item = f64> {
    (1..=SAMPLES).map(move |i| duration_s * i as f64 / (SAMPLES + 1) as f64)
}

/// Joint angles and rates under constant acceleration.
fn joints_after(state: &State<f64>, control: &[f64], after_s: f64) -> (Vec<f64>, Vec<f64>) {
    let joints = state.joint_angles.iter().zip(&state.joint_rates).zip(control);
    joints
        .map(|((angle, rate), acceleration)| {
            let gained = acceleration * after_s;
            (angle + (rate + 0.5 * gained) * after_s, rate + gained)
        })
        .unzip()
}

impl Limits {
    fn look_at_joints(
        &mut self,
        limits: &[JointLimits],
        angles_rad: &[f64],
        rates_rad_s: &[f64],
        time_s: f64,
    ) {
        for (joint, limits) in limits.iter().enumerate() {
            self.look_at_angle(limits, joint, angles_rad[joint], time_s);
            let rate = rates_rad_s[joint].abs();
            let subject = Some(Subject::Joint(joint));
            self.rate.at_most(rate, limits.rate_max_rad_s, subject, Some(time_s));
        }
    }

    fn look_at_angle(&mut self, limits: &JointLimits, joint: usize, angle_rad: f64, time_s: f64) {
        let (subject, time_s) = (Some(Subject::Joint(joint)), Some(time_s));
        if limits.angle_max_rad.is_finite() {
            self.angle.at_most(angle_rad, limits.angle_max_rad, subject, time_s);
        }
        if limits.angle_min_rad.is_finite() {
            self.angle.at_least(angle_rad, limits.angle_min_rad, subject, time_s);
        }
    }

    fn look_at_clearances(
        &mut self,
        system: &SystemDescription,
        collision: &CollisionModel,
        angles_rad: &[f64],
        time_s: f64,
    ) {
        if collision.body_links.is_empty() && collision.link_pairs.is_empty() {
            return;
        }
        let posture = system.model.kinematics(angles_rad);
        for clearance in collision.clearances(&posture) {
            let worst = match clearance.between {
                Between::LinkAndBody(_) => &mut self.body,
                Between::Links(..) => &mut self.links,
            };
            let subject = Some(Subject::Clearance(clearance.between));
            worst.at_least(clearance.distance_m, clearance.least_m, subject, Some(time_s));
        }
    }
}
