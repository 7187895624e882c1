//! A flight with its motions.

use righting_results::{ControlInterval, Node, Trajectory};
use righting_scenario::error::ShapeError;
use righting_scenario::{Error, Scenario};
use righting_verifier::model::State;

use crate::flight::Flight;

/// The motions of a flight.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The flight.
    pub flight: Flight,
    /// The maneuver with the masses of this flight's plant.
    pub scenario: Scenario,
    /// How the plant moves when the plan is flown as it is.
    pub open_loop: Trajectory,
    /// How it moves with what is done about it.
    pub flown: Trajectory,
}

/// Why a flight cannot be recorded.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// Its plant is no system that a scenario may have.
    #[error(transparent)]
    Plant(#[from] Error),
    /// The plant could not be followed to the end.
    #[error("the spacecraft could not be followed to the end of its flight")]
    Lost,
    /// Its motion is that of other joints than the scenario's.
    #[error(transparent)]
    Shape(#[from] ShapeError),
}

/// Where a plant was at the nodes.
#[derive(Default)]
pub(crate) struct Motion {
    times_s: Vec<f64>,
    states: Vec<Vec<f64>>,
}

impl Motion {
    pub(crate) fn push(&mut self, time_s: f64, state: &State<'_>) {
        self.times_s.push(time_s);
        self.states.push(state.to_vec());
    }

    /// As a trajectory whose joints accelerate in each step by what their rates gain in it.
    pub(crate) fn trajectory(&self, scenario: &Scenario) -> Result<Trajectory, ShapeError> {
        let system = &scenario.system().model;
        let states: Vec<State<'_>> = self.states.iter().map(|x| State::from_slice(x)).collect();
        let mut nodes = Vec::with_capacity(states.len());
        let mut intervals: Vec<ControlInterval> = Vec::with_capacity(states.len());
        for (k, state) in states.iter().enumerate() {
            let from = k.min(states.len() - 2);
            let duration_s = self.times_s[from + 1] - self.times_s[from];
            let rates = states[from + 1].joint_rates.iter().zip(states[from].joint_rates);
            let accelerations: Vec<f64> =
                rates.map(|(to, from)| (to - from) / duration_s).collect();
            let node = Node {
                time_s: self.times_s[k],
                position_m: state.position.into(),
                attitude: state.attitude_wxyz(),
                velocity_m_s: state.velocity.into(),
                angular_rate_rad_s: state.angular_rate.into(),
                joint_angles_rad: state.joint_angles.to_vec(),
                joint_rates_rad_s: state.joint_rates.to_vec(),
                power_w: 0.0,
                wheel_momenta_n_m_s: Vec::new(),
            };
            let full = node.state();
            let omega = full.angular_rate;
            let external = scenario.external(&full.attitude, &omega, node.time_s, (&[], &[]));
            let torques = system.joint_torques(
                &omega,
                &full.joint_angles,
                &full.joint_rates,
                &accelerations,
                external.as_ref(),
            );
            let power_w = torques.iter().zip(&full.joint_rates).map(|(t, rate)| t * rate).sum();
            nodes.push(Node { power_w, ..node });
            if k == from {
                intervals.push(ControlInterval {
                    joint_accelerations_rad_s2: accelerations,
                    joint_jerks_rad_s3: Vec::new(),
                    joint_torques_n_m: torques,
                    wheel_torques_n_m: Vec::new(),
                });
            }
        }
        Trajectory::new(nodes, intervals)
    }
}
