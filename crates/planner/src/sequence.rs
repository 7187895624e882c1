//! A first motion for a slew with waypoints: its legs, planned one after the other from rest to rest, and the
//! arm at rest between them.

use nalgebra::Vector3;
use righting_results::{ControlInterval, Node, Trajectory};
use righting_scenario::file::{self, ManeuverType};
use righting_scenario::{Leg, Scenario};

use crate::planned::Planned;

/// The legs of a scenario, planned by `plan`, as one motion on its grid; none where a leg was not planned: from
/// another posture it may be possible.
pub(crate) fn of_legs(
    scenario: &Scenario,
    mut plan: impl FnMut(&Scenario) -> Option<Planned>,
) -> Option<Trajectory> {
    let horizon = scenario.horizon();
    let node = |share: f64| (share * horizon.steps as f64).round() as usize;
    let mut motion = Motion::new(scenario);
    let legs = scenario.legs();
    for (index, leg) in legs.iter().enumerate() {
        motion.rest_until(node(leg.start));
        let steps = node(leg.end) - node(leg.start);
        if steps == 0 {
            continue;
        }
        let is_last = index + 1 == legs.len();
        let alone = alone(scenario, leg, motion.end(), steps, is_last).ok()?;
        let planned = plan(&alone).filter(|planned| planned.solution.status.is_acceptable())?;
        motion.follow(&planned.trajectory);
    }
    motion.rest_until(horizon.steps);
    Trajectory::new(motion.nodes, motion.intervals).ok()
}

/// A leg as a slew of its own, from where the one before ends.
fn alone(
    scenario: &Scenario,
    leg: &Leg,
    start: &Node,
    steps: usize,
    is_last: bool,
) -> Result<Scenario, righting_scenario::Error> {
    let horizon = scenario.horizon();
    let start_s = horizon.duration_s * leg.start;
    scenario.varied(|file| {
        file.initial.attitude = Some(start.state().attitude.normalized().to_array());
        let kinds = scenario.system().model.joint_kinds();
        file.initial.set_resting_joints(&kinds, &start.joint_angles_rad);
        file.initial.angular_rate_deg_s = None;
        file.maneuver = file::Maneuver {
            kind: ManeuverType::Slew,
            axis: None,
            angle_deg: None,
            target_attitude: Some(leg.target.to_array()),
            waypoints: Vec::new(),
        };
        file.horizon.duration_s = file::Duration::Given(horizon.time_s(steps));
        file.horizon.steps = steps as f64;
        if let (false, Some(end)) = (is_last, &mut file.end) {
            end.free_joints();
        }
        for table in file.pointing.iter_mut().filter_map(|cone| cone.direction_table.as_mut()) {
            table.t_s.iter_mut().for_each(|time_s| *time_s -= start_s);
        }
    })
}

/// A motion that grows.
struct Motion<'a> {
    scenario: &'a Scenario,
    nodes: Vec<Node>,
    intervals: Vec<ControlInterval>,
}

impl<'a> Motion<'a> {
    fn new(scenario: &'a Scenario) -> Self {
        let state = scenario.initial().state();
        let start = Node {
            time_s: 0.0,
            position_m: state.position.into(),
            attitude: state.attitude.to_array(),
            velocity_m_s: state.velocity.into(),
            angular_rate_rad_s: state.angular_rate.into(),
            joint_angles_rad: state.joint_angles,
            joint_rates_rad_s: state.joint_rates,
            power_w: 0.0,
            wheel_momenta_n_m_s: Vec::new(),
        };
        Self { scenario, nodes: vec![start], intervals: Vec::new() }
    }

    fn end(&self) -> &Node {
        &self.nodes[self.nodes.len() - 1]
    }

    /// Adds what follows after the last node, by its time from there and its place as seen from there.
    fn follow(&mut self, leg: &Trajectory) {
        let before_m = Vector3::from(self.end().position_m);
        for (node, interval) in leg.nodes().iter().skip(1).zip(leg.intervals()) {
            self.nodes.push(Node {
                time_s: self.scenario.horizon().time_s(self.nodes.len()),
                position_m: (before_m + Vector3::from(node.position_m)).into(),
                ..node.clone()
            });
            self.intervals.push(interval.clone());
        }
    }

    /// Lets everything stay as it is until a node.
    fn rest_until(&mut self, node: usize) {
        let joints = self.scenario.system().joint_count();
        let jerks = if self.scenario.system().limits_jerk() { joints } else { 0 };
        while self.nodes.len() <= node {
            let mut resting = self.end().clone();
            resting.time_s = self.scenario.horizon().time_s(self.nodes.len());
            resting.velocity_m_s = [0.0; 3];
            resting.angular_rate_rad_s = [0.0; 3];
            resting.joint_rates_rad_s.fill(0.0);
            self.nodes.push(resting);
            self.intervals.push(ControlInterval {
                joint_accelerations_rad_s2: vec![0.0; joints],
                joint_jerks_rad_s3: vec![0.0; jerks],
                joint_torques_n_m: vec![0.0; joints],
                wheel_torques_n_m: Vec::new(),
            });
        }
    }
}
