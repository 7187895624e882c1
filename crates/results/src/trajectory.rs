//! A planned maneuver, node by node.

use nalgebra::Vector3;
use righting_multibody::{External, Quaternion, State};
use righting_scenario::Scenario;
use righting_scenario::error::ShapeError;

/// The free-floating system at one instant, with the power its joints take.
///
/// Position and velocity are those of the base's body-frame origin in inertial axes; the attitude
/// quaternion turns body vectors into inertial ones; the angular rate is in body axes. Of a joint that slides
/// angles are travels in m, torques forces in N, and so on.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Time since the start.
    pub time_s: f64,
    /// Position of the body-frame origin, inertial axes.
    pub position_m: [f64; 3],
    /// Attitude, body → inertial, Hamilton, scalar first (w, x, y, z).
    pub attitude: [f64; 4],
    /// Velocity of the body-frame origin, inertial axes.
    pub velocity_m_s: [f64; 3],
    /// Angular rate of the base, body axes.
    pub angular_rate_rad_s: [f64; 3],
    /// Joint angles, one a joint.
    pub joint_angles_rad: Vec<f64>,
    /// Joint rates, one a joint.
    pub joint_rates_rad_s: Vec<f64>,
    /// Mechanical power of the joints Σ τ q̇ with the control of the interval that starts here; at
    /// the last node, of the interval that ends there.
    pub power_w: f64,
    /// Momenta of the wheels about their axes, relative to the base, one a wheel.
    pub wheel_momenta_n_m_s: Vec<f64>,
}

impl Node {
    /// The state of the full form.
    pub fn state(&self) -> State<f64> {
        State {
            position: Vector3::from(self.position_m),
            attitude: Quaternion::from_array(self.attitude),
            velocity: Vector3::from(self.velocity_m_s),
            angular_rate: Vector3::from(self.angular_rate_rad_s),
            joint_angles: self.joint_angles_rad.clone(),
            joint_rates: self.joint_rates_rad_s.clone(),
        }
    }
}

/// What acts between node k and node k + 1.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlInterval {
    /// Joint accelerations at the interval's first node, held over it unless there are jerks.
    pub joint_accelerations_rad_s2: Vec<f64>,
    /// Joint jerks, held over the interval: accelerations are linear in time. Empty in a trajectory whose
    /// accelerations are held.
    pub joint_jerks_rad_s3: Vec<f64>,
    /// Joint torques at the interval's first node.
    pub joint_torques_n_m: Vec<f64>,
    /// Torques of the wheels, held over the interval: the rates of their momenta, one a wheel.
    pub wheel_torques_n_m: Vec<f64>,
}

impl ControlInterval {
    /// A joint's jerk, rad/s³: zero where accelerations are held.
    pub fn joint_jerk_rad_s3(&self, joint: usize) -> f64 {
        self.joint_jerks_rad_s3.get(joint).copied().unwrap_or(0.0)
    }

    /// Joint accelerations a time after the interval's first node, rad/s².
    pub fn joint_accelerations_after(&self, after_s: f64) -> Vec<f64> {
        let first = self.joint_accelerations_rad_s2.iter().enumerate();
        first
            .map(|(joint, acceleration)| acceleration + after_s * self.joint_jerk_rad_s3(joint))
            .collect()
    }
}

/// A trajectory of N intervals between N + 1 nodes; N ≥ 1, and every part has the same joints and wheels.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    nodes: Vec<Node>,
    intervals: Vec<ControlInterval>,
}

impl Trajectory {
    /// Joins nodes and intervals.
    ///
    /// # Errors
    /// There must be one more node than intervals, at least one interval, the same number of joints and of wheels
    /// everywhere, and jerks in all intervals or in none.
    pub fn new(nodes: Vec<Node>, intervals: Vec<ControlInterval>) -> Result<Self, ShapeError> {
        let require = |what: &dyn Fn() -> String, found: usize, needed: usize| {
            if found == needed { Ok(()) } else { Err(ShapeError { what: what(), found, needed }) }
        };
        let steps = nodes.len().saturating_sub(1).max(1);
        require(&|| "intervals".to_owned(), intervals.len(), steps)?;
        require(&|| "nodes".to_owned(), nodes.len(), steps + 1)?;
        let joints = nodes[0].joint_angles_rad.len();
        let wheels = nodes[0].wheel_momenta_n_m_s.len();
        for (k, node) in nodes.iter().enumerate() {
            require(&|| format!("joint angles of node {k}"), node.joint_angles_rad.len(), joints)?;
            require(&|| format!("joint rates of node {k}"), node.joint_rates_rad_s.len(), joints)?;
            let momenta = node.wheel_momenta_n_m_s.len();
            require(&|| format!("wheel momenta of node {k}"), momenta, wheels)?;
        }
        for (k, interval) in intervals.iter().enumerate() {
            let accelerations = interval.joint_accelerations_rad_s2.len();
            require(&|| format!("joint accelerations of interval {k}"), accelerations, joints)?;
            let torques = interval.joint_torques_n_m.len();
            require(&|| format!("joint torques of interval {k}"), torques, joints)?;
            let torques = interval.wheel_torques_n_m.len();
            require(&|| format!("wheel torques of interval {k}"), torques, wheels)?;
            let jerks = if intervals[0].joint_jerks_rad_s3.is_empty() { 0 } else { joints };
            let found = interval.joint_jerks_rad_s3.len();
            require(&|| format!("joint jerks of interval {k}"), found, jerks)?;
        }
        Ok(Self { nodes, intervals })
    }

    /// The N + 1 nodes.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The N intervals; interval k lies between nodes k and k + 1.
    pub fn intervals(&self) -> &[ControlInterval] {
        &self.intervals
    }

    /// Number of joints j.
    pub fn joints(&self) -> usize {
        self.nodes[0].joint_angles_rad.len()
    }

    /// Number of wheels.
    pub fn wheels(&self) -> usize {
        self.nodes[0].wheel_momenta_n_m_s.len()
    }

    /// Torques of the wheels at node `k`, N m: those of the interval that begins there, and at the last node of the
    /// one that ends there.
    pub fn wheel_torques_at(&self, k: usize) -> &[f64] {
        &self.intervals[k.min(self.steps() - 1)].wheel_torques_n_m
    }

    /// Momenta of the wheels a time after node `k`, within its interval, N m s.
    pub fn wheel_momenta_after(&self, k: usize, after_s: f64) -> Vec<f64> {
        let momenta = self.nodes[k].wheel_momenta_n_m_s.iter();
        let pairs = momenta.zip(self.wheel_torques_at(k));
        pairs.map(|(momentum, torque)| momentum + after_s * torque).collect()
    }

    /// What acts on the scenario's system from outside and by its wheels in the state vector `x` of the full form, a
    /// time after node `k` and within its interval; none where nothing does.
    ///
    /// # Panics
    /// `x` has fewer than 13 elements.
    pub fn external(
        &self,
        scenario: &Scenario,
        (k, after_s): (usize, f64),
        x: &[f64],
    ) -> Option<External<f64>> {
        let attitude = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
        let rate = Vector3::new(x[10], x[11], x[12]);
        let momenta = self.wheel_momenta_after(k, after_s);
        let time_s = self.nodes[k].time_s + after_s;
        let wheels = (&momenta[..], self.wheel_torques_at(k));
        scenario.external(&attitude, &rate, time_s, wheels)
    }

    /// Whether accelerations are linear between nodes, by the intervals' jerks, rather than held.
    pub fn has_jerks(&self) -> bool {
        !self.intervals[0].joint_jerks_rad_s3.is_empty()
    }

    /// Joint accelerations at node `k`, rad/s²: those with which its interval begins, and at the last node
    /// those with which the last interval ends.
    pub fn joint_accelerations_at(&self, k: usize) -> Vec<f64> {
        match self.intervals.get(k) {
            Some(interval) => interval.joint_accelerations_rad_s2.clone(),
            None => {
                let [.., before, last] = &self.nodes[..] else {
                    unreachable!("two nodes at least")
                };
                let last_interval = &self.intervals[self.steps() - 1];
                last_interval.joint_accelerations_after(last.time_s - before.time_s)
            }
        }
    }

    /// Number of intervals N.
    pub fn steps(&self) -> usize {
        self.intervals.len()
    }

    /// The first node.
    pub fn start(&self) -> &Node {
        &self.nodes[0]
    }

    /// The last node.
    pub fn end(&self) -> &Node {
        &self.nodes[self.nodes.len() - 1]
    }

    /// Largest mechanical power of the joints at any node, W.
    pub fn peak_power_w(&self) -> f64 {
        self.nodes.iter().map(|node| node.power_w).fold(f64::NEG_INFINITY, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(joints: usize) -> Node {
        Node {
            time_s: 0.0,
            position_m: [0.0; 3],
            attitude: [1.0, 0.0, 0.0, 0.0],
            velocity_m_s: [0.0; 3],
            angular_rate_rad_s: [0.0; 3],
            joint_angles_rad: vec![0.0; joints],
            joint_rates_rad_s: vec![0.0; joints],
            power_w: 0.0,
            wheel_momenta_n_m_s: Vec::new(),
        }
    }

    fn interval(joints: usize) -> ControlInterval {
        ControlInterval {
            joint_accelerations_rad_s2: vec![0.0; joints],
            joint_jerks_rad_s3: Vec::new(),
            joint_torques_n_m: vec![0.0; joints],
            wheel_torques_n_m: Vec::new(),
        }
    }

    #[test]
    fn parts_that_do_not_fit_are_refused() {
        assert!(Trajectory::new(vec![node(2), node(2)], vec![interval(2)]).is_ok());
        let refused = |nodes, intervals| Trajectory::new(nodes, intervals).unwrap_err().what;
        assert_eq!(refused(vec![], vec![]), "intervals");
        assert_eq!(refused(vec![node(2)], vec![interval(2)]), "nodes");
        assert_eq!(refused(vec![node(2), node(2)], vec![]), "intervals");
        assert_eq!(refused(vec![node(2), node(3)], vec![interval(2)]), "joint angles of node 1");
        assert_eq!(
            refused(vec![node(2), node(2)], vec![interval(1)]),
            "joint accelerations of interval 0"
        );
        let wheeled = ControlInterval { wheel_torques_n_m: vec![0.0], ..interval(2) };
        assert_eq!(refused(vec![node(2), node(2)], vec![wheeled]), "wheel torques of interval 0");
        let jerked = ControlInterval { joint_jerks_rad_s3: vec![0.0; 2], ..interval(2) };
        let nodes = || vec![node(2), node(2), node(2)];
        assert!(Trajectory::new(nodes(), vec![jerked.clone(); 2]).unwrap().has_jerks());
        assert_eq!(refused(nodes(), vec![jerked, interval(2)]), "joint jerks of interval 1");
    }
}
