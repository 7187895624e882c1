//! The posture at the end, where the scenario gives it: terminal equalities q_N = q_end of some joints.

use righting_ocp::{ComponentBounds, Expr};
use righting_scenario::scenario::Scenario;

use super::Coordinates;

/// The joints whose angle at the end is given, counted from zero, and that angle, rad. A locked joint is not
/// among them: it is there all the time.
#[derive(Clone, Debug)]
pub(super) struct EndPosture {
    joints: Vec<(usize, f64)>,
}

impl EndPosture {
    pub(super) fn new(scenario: &Scenario, coordinates: &Coordinates) -> Self {
        let angles = scenario.end_angles_rad().iter().enumerate();
        let joints = angles
            .filter_map(|(joint, angle)| Some((joint, (*angle)?)))
            .filter(|&(joint, _)| !coordinates.is_locked(joint));
        Self { joints: joints.collect() }
    }

    pub(super) fn bounds(&self) -> ComponentBounds {
        let angles: Vec<f64> = self.joints.iter().map(|&(_, angle_rad)| angle_rad).collect();
        ComponentBounds::new(angles.clone(), angles)
    }

    /// The angles of those joints in a state.
    pub(super) fn values(&self, coordinates: &Coordinates, x: &[Expr]) -> Vec<Expr> {
        self.joints.iter().map(|&(joint, _)| x[coordinates.joint_angle(joint)]).collect()
    }
}
