//! What a flight ends with.

use righting_multibody::Quaternion;
use righting_scenario::{Maneuver, Scenario};
use righting_verifier::model::State;

/// The end of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The angle between the attitude and the target, rad; zero for a detumble.
    pub error_rad: f64,
    /// The base's angular rate, rad/s.
    pub rate_rad_s: f64,
    /// The largest joint rate, rad/s.
    pub joint_rate_rad_s: f64,
}

impl End {
    pub(crate) fn of(scenario: &Scenario, state: &State<'_>) -> Self {
        let error_rad = match scenario.maneuver() {
            Maneuver::Slew(slew) => {
                let attitude = Quaternion::from_array(state.attitude_wxyz());
                attitude.normalized().angle_to(&slew.target)
            }
            Maneuver::Detumble => 0.0,
        };
        let rates = state.joint_rates.iter();
        Self {
            error_rad,
            rate_rad_s: state.angular_rate.norm(),
            joint_rate_rad_s: rates.fold(0.0, |most: f64, rate| most.max(rate.abs())),
        }
    }

    /// Whether the plant could be followed to here.
    pub fn is_finite(&self) -> bool {
        self.error_rad.is_finite() && self.rate_rad_s.is_finite()
    }
}
