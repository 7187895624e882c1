//! Joint limits and clearances, at the nodes and between them.

use righting_results::trajectory::Trajectory;

use crate::closest_approach::{ClosestApproach, Interval};
use crate::joints::{Accelerations, Joints};
use crate::ledger::{Ledger, Worst};
use crate::model::Pose;
use crate::requirements::Requirements;
use crate::simulation::Simulation;
use crate::tolerances::LimitTolerances;
use crate::worst_of_joints::WorstOfJoints;

/// Places looked at within an interval, at least.
const SAMPLES: usize = 10;

/// Worst places of the quantities that have limits.
struct Limits<'a> {
    asked: &'a Requirements,
    angle: WorstOfJoints<'a>,
    rate: WorstOfJoints<'a>,
    body: Worst,
    links: Worst,
    /// The arm's frames in the posture looked at last.
    frames: Vec<Pose>,
}

/// What the checks are called: of joints that turn, of joints that slide, and of clearances.
struct Names {
    angle: &'static str,
    travel: &'static str,
    rate: &'static str,
    speed: &'static str,
    body: &'static str,
    links: &'static str,
}

pub(super) fn check(
    asked: &Requirements,
    trajectory: &Trajectory,
    simulation: &Simulation,
    ledger: &mut Ledger,
) {
    let names = Names {
        angle: "joint angle at nodes",
        travel: "joint travel at nodes",
        rate: "joint rate at nodes",
        speed: "joint speed at nodes",
        body: "clearance from body at nodes",
        links: "clearance between links at nodes",
    };
    let mut at_nodes = Limits::new(asked, names, &asked.tolerances.at_nodes);
    for node in trajectory.nodes() {
        at_nodes.look(&node.joint_angles_rad, &node.joint_rates_rad_s, node.time_s);
    }
    let names = Names {
        angle: "joint angle between nodes",
        travel: "joint travel between nodes",
        rate: "joint rate between nodes",
        speed: "joint speed between nodes",
        body: "clearance from body between nodes",
        links: "clearance between links between nodes",
    };
    let mut between = Limits::new(asked, names, &asked.tolerances.between_nodes);
    let allowed = asked.tolerances.of_kinds(asked.tolerances.at_nodes.acceleration_rad_s2);
    let mut acceleration = WorstOfJoints::new(
        &asked.slides,
        Worst::of_limit("joint acceleration", "rad/s²", allowed[0]),
        Worst::of_limit("acceleration of sliding joint", "m/s²", allowed[1]),
    );
    let mut joints = Joints::new(asked.joint_limits.len());
    let mut approach = ClosestApproach::new(asked, &simulation.start());
    let states = simulation.nodes().zip(simulation.nodes().skip(1));
    for (k, (interval, (state, next))) in trajectory.intervals().iter().zip(states).enumerate() {
        let accelerations = Accelerations::of(interval);
        let start_s = asked.horizon.time_s(k);
        let duration_s = asked.horizon.time_s(k + 1) - start_s;
        for (joint, limits) in asked.joint_limits.iter().enumerate() {
            let limit = limits.acceleration_max_rad_s2;
            let largest = accelerations.largest(joint, [0.0, duration_s]);
            acceleration.at_most(joint, largest, limit, start_s);
        }
        for after_s in sampled(duration_s) {
            joints.move_on(&state, accelerations, after_s);
            between.look(&joints.angles, &joints.rates, start_s + after_s);
        }
        let interval = Interval { start: state, end: next, accelerations, start_s, duration_s };
        approach.follow(&interval, &mut between.body, &mut between.links);
        let is_within = |after_s: &f64| *after_s > 0.0 && *after_s < duration_s;
        for (joint, rate) in state.joint_rates.iter().enumerate() {
            // A joint that turns back within the interval goes farthest between two samples.
            for after_s in accelerations.standstills(joint, *rate).filter(is_within) {
                joints.move_on(&state, accelerations, after_s);
                between.look_at_angle(joint, joints.angles[joint], start_s + after_s);
            }
            if let Some(after_s) = Some(accelerations.extreme_rate(joint)).filter(is_within) {
                joints.move_on(&state, accelerations, after_s);
                between.look_at_rate(joint, joints.rates[joint], start_s + after_s);
            }
        }
    }
    let Limits { angle, rate, body, links, .. } = at_nodes;
    for worst in [angle, rate, acceleration] {
        worst.enter(ledger);
    }
    ledger.add(body);
    ledger.add(links);
    let Limits { angle, rate, body, links, .. } = between;
    angle.enter(ledger);
    rate.enter(ledger);
    ledger.add(body);
    ledger.add(links);
}

/// Times within an interval, its ends left out.
fn sampled(duration_s: f64) -> impl Iterator<Item = f64> {
    (1..=SAMPLES).map(move |i| duration_s * i as f64 / (SAMPLES + 1) as f64)
}

impl<'a> Limits<'a> {
    /// Limits on joint coordinates, rates, clearances from the body and between links.
    fn new(asked: &'a Requirements, names: Names, tolerances: &LimitTolerances) -> Self {
        let of_joints = |names: [&'static str; 2], units: [&'static str; 2], tolerance: f64| {
            let allowed = asked.tolerances.of_kinds(tolerance);
            let [turning, sliding] =
                [0, 1].map(|k| Worst::of_limit(names[k], units[k], allowed[k]));
            WorstOfJoints::new(&asked.slides, turning, sliding)
        };
        let Names { angle, travel, rate, speed, body, links } = names;
        Self {
            asked,
            angle: of_joints([angle, travel], ["rad", "m"], tolerances.angle_rad),
            rate: of_joints([rate, speed], ["rad/s", "m/s"], tolerances.rate_rad_s),
            body: Worst::of_limit(body, "m", tolerances.distance_m),
            links: Worst::of_limit(links, "m", tolerances.distance_m),
            frames: vec![Pose::identity(); asked.model.frame_count()],
        }
    }

    fn look(&mut self, angles_rad: &[f64], rates_rad_s: &[f64], time_s: f64) {
        for joint in 0..self.asked.joint_limits.len() {
            self.look_at_angle(joint, angles_rad[joint], time_s);
            self.look_at_rate(joint, rates_rad_s[joint], time_s);
        }
        let Requirements { model, clearances, .. } = self.asked;
        if !clearances.is_empty() {
            model.frames(angles_rad, &mut self.frames);
            clearances.look(&self.frames, time_s, &mut self.body, &mut self.links);
        }
    }

    fn look_at_rate(&mut self, joint: usize, rate_rad_s: f64, time_s: f64) {
        let limit = self.asked.joint_limits[joint].rate_max_rad_s;
        self.rate.at_most(joint, rate_rad_s.abs(), limit, time_s);
    }

    fn look_at_angle(&mut self, joint: usize, angle_rad: f64, time_s: f64) {
        let limits = &self.asked.joint_limits[joint];
        if let Some(max_rad) = limits.angle_max_rad {
            self.angle.at_most(joint, angle_rad, max_rad, time_s);
        }
        if let Some(min_rad) = limits.angle_min_rad {
            self.angle.at_least(joint, angle_rad, min_rad, time_s);
        }
    }
}
