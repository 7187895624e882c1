//! The second integration: from the first node and the controls alone.

use righting_multibody::State;

use crate::dormand_prince::DormandPrince;
use crate::scenario::Scenario;
use crate::trajectory::Trajectory;

/// The motion that a trajectory's first node and controls lead to, at every node.
#[derive(Debug)]
pub(super) struct Replay {
    nodes: Vec<State<f64>>,
}

impl Replay {
    /// Integrates the full equations of motion. From a state that cannot be followed, all later
    /// ones are NaN.
    pub fn of(scenario: &Scenario, trajectory: &Trajectory) -> Self {
        Self::from(trajectory.start().state(), scenario, trajectory)
    }

    /// The same from another start.
    pub fn from(start: State<f64>, scenario: &Scenario, trajectory: &Trajectory) -> Self {
        let model = &scenario.system().model;
        let horizon = scenario.horizon();
        let mut x = start.to_vec();
        let mut integrator = DormandPrince::new(x.len());
        let mut nodes = vec![start];
        for (k, interval) in trajectory.intervals().iter().enumerate() {
            let duration_s = horizon.time_s(k + 1) - horizon.time_s(k);
            let control = &interval.joint_accelerations_rad_s2;
            let followed = integrator.advance(&mut x, duration_s, |x, rate| {
                rate.copy_from_slice(&model.state_derivative(x, control));
            });
            if !followed {
                x.fill(f64::NAN);
            }
            nodes.extend(State::from_slice(&x));
        }
        Self { nodes }
    }

    /// The states at the N + 1 nodes.
    pub fn nodes(&self) -> &[State<f64>] {
        &self.nodes
    }
}
