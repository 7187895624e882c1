//! What the last state must be: terminal equalities.

use righting_ocp::{ComponentBounds, Expr};
use righting_scenario::scenario::Scenario;

use super::Coordinates;

/// The angles of the joints whose posture at the end the scenario gives, the momenta of wheels that it gives, and no acceleration where
/// accelerations are states. A locked joint is not among them: it is there all the time.
#[derive(Clone, Debug)]
pub(super) struct EndConditions {
    /// Indices of states and their values.
    states: Vec<(usize, f64)>,
}

impl EndConditions {
    pub(super) fn new(scenario: &Scenario, coordinates: &Coordinates) -> Self {
        let angles = scenario.end_angles_rad().iter().enumerate();
        let moving = angles.filter(|&(joint, _)| !coordinates.is_locked(joint));
        let of_joint = |(joint, angle_rad): (usize, &Option<f64>)| {
            let angle = angle_rad.map(|angle_rad| (coordinates.joint_angle(joint), angle_rad));
            let acceleration = coordinates.joint_acceleration(joint).map(|index| (index, 0.0));
            [angle, acceleration].into_iter().flatten()
        };
        let ends = scenario.wheels().iter().zip(scenario.end_wheel_momenta_n_m_s());
        let working = ends.filter(|(wheel, _)| !wheel.failed);
        let of_wheels = coordinates.wheels().zip(working);
        let of_wheels = of_wheels
            .filter_map(|(state, (wheel, end))| Some((state, (*end)? / wheel.momentum_max_n_m_s)));
        Self { states: moving.flat_map(of_joint).chain(of_wheels).collect() }
    }

    pub(super) fn bounds(&self) -> ComponentBounds {
        let values: Vec<f64> = self.states.iter().map(|&(_, value)| value).collect();
        ComponentBounds::new(values.clone(), values)
    }

    /// Those states of the last one.
    pub(super) fn values(&self, x: &[Expr]) -> Vec<Expr> {
        self.states.iter().map(|&(index, _)| x[index]).collect()
    }
}
