//! What the end of a maneuver shall be, and what it is.

use nalgebra::{Matrix3, Quaternion, Unit, UnitQuaternion, Vector3};
use righting_results::solution::Terminal;
use righting_scenario::file;

use crate::model::{BaseAcceleration, Model, Motion, State};

/// What the end shall be.
#[derive(Clone, Copy, Debug)]
pub(super) enum Goal {
    /// At rest in an attitude, body → inertial.
    Attitude(UnitQuaternion<f64>),
    /// With the arm at rest and the base turning slower than it would with the arm simply stopped.
    LessRate {
        /// The norm of the base's rate once the arm is stopped in its posture at the start, deg/s.
        stopped_deg_s: f64,
    },
}

impl Goal {
    /// Of a resolved scenario that starts in the state `start`.
    pub fn new(maneuver: &file::Maneuver, model: &Model, start: &State<'_>) -> Self {
        match maneuver.kind {
            file::ManeuverType::Slew => {
                let start = UnitQuaternion::from_quaternion(start.attitude);
                Self::to(maneuver.target_attitude, maneuver.axis, maneuver.angle_deg, &start)
            }
            file::ManeuverType::Detumble => {
                Self::LessRate { stopped_deg_s: stopped_rate(model, start).norm().to_degrees() }
            }
        }
    }

    /// A target attitude, or a turn by an angle about an axis from the attitude `start`.
    pub fn to(
        target_attitude: Option<[f64; 4]>,
        axis: Option<[f64; 3]>,
        angle_deg: Option<f64>,
        start: &UnitQuaternion<f64>,
    ) -> Self {
        if let Some([w, x, y, z]) = target_attitude {
            return Self::Attitude(UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)));
        }
        // A target without them was refused when the scenario was read.
        let axis = Unit::new_normalize(Vector3::from(axis.unwrap_or_default()));
        let angle_rad = angle_deg.unwrap_or(f64::NAN).to_radians();
        Self::Attitude(start * UnitQuaternion::from_axis_angle(&axis, angle_rad))
    }

    /// What a maneuver that ends in the state `end` has reached, where the joints that `slides` says slide.
    pub fn reached(&self, end: &State<'_>, slides: &[bool]) -> Terminal {
        let (attitude_error, attitude_error_deg) = match self {
            Self::Attitude(target) => {
                // The quaternion from the target to the attitude reached.
                let error = target.conjugate().into_inner() * end.attitude.normalize();
                let vector = error.imag().norm();
                (vector, 2.0 * vector.atan2(error.scalar().abs()).to_degrees())
            }
            Self::LessRate { .. } => (0.0, 0.0),
        };
        let norm_of = |sliding: bool| {
            let rates = end.joint_rates.iter().zip(slides);
            let squares =
                rates.filter(|(_, slides)| **slides == sliding).map(|(rate, _)| rate * rate);
            squares.sum::<f64>().sqrt()
        };
        Terminal {
            attitude_error,
            attitude_error_deg,
            angular_rate_deg_s: end.angular_rate.norm().to_degrees(),
            joint_rate_deg_s: norm_of(false).to_degrees(),
            joint_speed_m_s: slides.contains(&true).then(|| norm_of(true)),
        }
    }
}

/// The base's rate, body axes, once the joints have stopped where they are in the state `start`: angular
/// momentum, which stopping them does not change, is linear in the rate of a rigid body.
pub(super) fn stopped_rate(model: &Model, start: &State<'_>) -> Vector3<f64> {
    let still = vec![0.0; model.joint_count()];
    let mut motion = Motion::new(model);
    let mut momentum = |state: &State<'_>| {
        motion.set(model, state, &BaseAcceleration::default(), &still);
        motion.angular_momentum()
    };
    let kept = momentum(start);
    let of_rate = |angular_rate| State { angular_rate, joint_rates: &still, ..*start };
    let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|unit| momentum(&of_rate(unit)));
    // A body of any extent has an inverse; where rounding leaves none, nothing is slower than infinity.
    let inverse = Matrix3::from_columns(&columns).try_inverse();
    inverse.map_or_else(|| Vector3::repeat(f64::INFINITY), |inverse| inverse * kept)
}
