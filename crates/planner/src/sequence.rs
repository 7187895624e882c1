//! A first motion for a slew with waypoints: its legs, planned one after the other from rest to rest, and the
//! arm at rest between them. Each leg starts with the posture, the rate of the base and the momenta of the wheels in which the one
//! before ends.

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
        file.initial.angular_rate_deg_s =
            scenario.may_have_momentum().then(|| start.angular_rate_rad_s.map(f64::to_degrees));
        file.maneuver = file::Maneuver {
            kind: ManeuverType::Slew,
            axis: None,
            angle_deg: None,
            target_attitude: Some(leg.target.to_array()),
            waypoints: Vec::new(),
        };
        file.horizon.duration_s = file::Duration::Given(horizon.time_s(steps));
        file.horizon.steps = steps as f64;
        let stored = scenario.wheels().iter().zip(&start.wheel_momenta_n_m_s);
        for (row, (wheel, momentum)) in file.wheels.iter_mut().zip(stored) {
            let most = wheel.momentum_max_n_m_s;
            row.initial_momentum_n_m_s = Some(momentum.clamp(-most, most));
        }
        if let Some(gradient) =
            file.environment.as_mut().and_then(|environment| environment.gravity_gradient.as_mut())
        {
            gradient.move_on(start_s);
        }
        if !is_last {
            if let Some(end) = &mut file.end {
                end.free_joints();
                end.wheel_momenta_n_m_s = None;
            }
            file.weights.wheel_momentum = None;
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
            wheel_momenta_n_m_s: scenario
                .wheels()
                .iter()
                .map(|wheel| wheel.initial_momentum_n_m_s)
                .collect(),
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

    /// Lets everything stay as it is until a node: the momentum too, where a base may drift with it.
    fn rest_until(&mut self, node: usize) {
        let joints = self.scenario.system().joint_count();
        let jerks = if self.scenario.system().limits_jerk() { joints } else { 0 };
        while self.nodes.len() <= node {
            let mut resting = self.end().clone();
            resting.time_s = self.scenario.horizon().time_s(self.nodes.len());
            resting.velocity_m_s = [0.0; 3];
            if !self.scenario.may_have_momentum() {
                resting.angular_rate_rad_s = [0.0; 3];
            }
            resting.joint_rates_rad_s.fill(0.0);
            self.nodes.push(resting);
            self.intervals.push(ControlInterval {
                joint_accelerations_rad_s2: vec![0.0; joints],
                joint_jerks_rad_s3: vec![0.0; jerks],
                joint_torques_n_m: vec![0.0; joints],
                wheel_torques_n_m: vec![0.0; self.scenario.wheels().len()],
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use righting_ocp::Control;
    use righting_scenario::wheels::stored;

    use super::*;
    use crate::Planner;

    /// Where one leg ends the next begins: with three of four wheels that work, one spinning, momentum is what it was
    /// all along the way.
    #[test]
    fn legs_with_wheels_go_on_where_the_one_before_ends() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
        let file = folder.join("wheels/slew_4dof_and_back_wheels.json");
        let scenario = Scenario::read(&file).unwrap();
        let mut legs = Vec::new();
        let motion = of_legs(&scenario, |leg| {
            legs.push(leg.wheels().iter().map(|wheel| wheel.initial_momentum_n_m_s).collect());
            Planner::new().plan(leg, &mut |_| Control::Continue).ok()
        });
        let motion = motion.expect("both legs are planned");
        let [first, second]: [Vec<f64>; 2] = legs.try_into().unwrap();
        assert_eq!(first, [0.3, 0.0, 0.0, 0.0]);
        assert_eq!(second, motion.nodes()[200].wheel_momenta_n_m_s);
        assert!(second[1].abs() > 0.05 && second[3] == 0.0, "{second:?}");
        let momenta = motion.nodes().iter().map(|node| {
            let in_store = stored(scenario.wheels(), &node.wheel_momenta_n_m_s);
            let state = node.state();
            scenario.system().model.inertial_angular_momentum(&state)
                + state.attitude.to_inertial(&in_store)
        });
        let momenta: Vec<Vector3<f64>> = momenta.collect();
        let farthest = momenta.iter().map(|other| (other - momenta[0]).norm()).fold(0.0, f64::max);
        assert!(farthest < 2e-3 * momenta[0].norm(), "{farthest}");
    }
}
