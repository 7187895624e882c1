//! What a trajectory does not hold but follows from it node by node: momentum, clearances and where instruments
//! look.

use nalgebra::Vector3;
use righting_results::trajectory::Trajectory;
use righting_scenario::ConeSide;
use righting_scenario::collision::Between;
use righting_scenario::error::ShapeError;
use righting_scenario::scenario::Scenario;
use righting_scenario::wheels::stored;

/// Momentum, clearances and angles from cones at every node.
#[derive(Clone, Debug, PartialEq)]
pub struct Histories {
    /// Angular momentum of the system about its center of mass, its wheels' included, inertial axes, N m s.
    pub angular_momentum_n_m_s: Vec<Vector3<f64>>,
    /// The part H̃ of it that is the arm's motion relative to the base, body axes, N m s.
    pub arm_momentum_n_m_s: Vec<Vector3<f64>>,
    /// Center of mass of the system, inertial axes, m.
    pub center_of_mass_m: Vec<Vector3<f64>>,
    /// Every distance that is kept.
    pub clearances: Vec<ClearanceHistory>,
    /// Every instrument's angle from the axis of its cone.
    pub pointing: Vec<PointingHistory>,
}

/// Where an instrument looks over a maneuver.
#[derive(Clone, Debug, PartialEq)]
pub struct PointingHistory {
    /// Name of instrument and cone.
    pub name: String,
    /// The side of the cone that is allowed.
    pub side: ConeSide,
    /// Half-angle of the cone, rad.
    pub half_angle_rad: f64,
    /// The angle between boresight and axis at every node, rad.
    pub angles_rad: Vec<f64>,
}

/// One distance over a maneuver.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearanceHistory {
    /// Between what.
    pub between: Between,
    /// The least that is allowed, m.
    pub least_m: f64,
    /// At every node, m.
    pub distances_m: Vec<f64>,
}

impl Histories {
    /// Of a trajectory of the scenario's system.
    ///
    /// # Errors
    /// The trajectory has other joints than the system.
    pub fn new(scenario: &Scenario, trajectory: &Trajectory) -> Result<Self, ShapeError> {
        let model = &scenario.system().model;
        let (found, needed) = (trajectory.joints(), model.joint_count());
        if found != needed {
            return Err(ShapeError { what: "joints".to_owned(), found, needed });
        }
        let mut histories = Self {
            angular_momentum_n_m_s: Vec::new(),
            arm_momentum_n_m_s: Vec::new(),
            center_of_mass_m: Vec::new(),
            clearances: Vec::new(),
            pointing: scenario
                .pointing()
                .iter()
                .map(|cone| PointingHistory {
                    name: cone.name.clone(),
                    side: cone.side,
                    half_angle_rad: cone.half_angle_rad,
                    angles_rad: Vec::new(),
                })
                .collect(),
        };
        for node in trajectory.nodes() {
            let state = node.state();
            let (angles, rates) = (&state.joint_angles, &state.joint_rates);
            let momentum = model.angular_momentum(&state.angular_rate, angles, rates)
                + stored(scenario.wheels(), &node.wheel_momenta_n_m_s);
            histories.angular_momentum_n_m_s.push(state.attitude.to_inertial(&momentum));
            histories.arm_momentum_n_m_s.push(model.h_tilde(angles, rates));
            let center = state.attitude.to_inertial(&model.center_of_mass(angles));
            histories.center_of_mass_m.push(state.position + center);
            for (history, cone) in histories.pointing.iter_mut().zip(scenario.pointing()) {
                history.angles_rad.push(cone.angle_rad(&state.attitude, node.time_s));
            }
            let posture = model.kinematics(angles);
            for (i, clearance) in scenario.collision().clearances(&posture).enumerate() {
                if i == histories.clearances.len() {
                    histories.clearances.push(ClearanceHistory {
                        between: clearance.between,
                        least_m: clearance.least_m,
                        distances_m: Vec::new(),
                    });
                }
                histories.clearances[i].distances_m.push(clearance.distance_m);
            }
        }
        Ok(histories)
    }
}
