//! State at the start of a maneuver.

use nalgebra::Vector3;
use righting_multibody::{Quaternion, State};

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Location, Number};
use crate::system_description::{SystemDescription, unit_quaternion};

const ANGULAR_RATE_DEG_S: Bounds = Bounds::Between(-3.6e6, 3.6e6);
const JOINT_ANGLE_DEG: Bounds = Bounds::Between(-36_000.0, 36_000.0);

/// State at the start: the base's body frame is at the origin, the system's center of mass at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Initial {
    /// Attitude of the base, body → inertial; of unit length.
    pub attitude: Quaternion<f64>,
    /// Velocity of the body-frame origin that leaves the center of mass at rest, inertial axes, m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Angular rate of the base, body axes, rad/s.
    pub angular_rate_rad_s: Vector3<f64>,
    /// Joint angles, one a joint, rad; within the limits.
    pub joint_angles_rad: Vec<f64>,
    /// Joint rates, one a joint, rad/s; within the limits.
    pub joint_rates_rad_s: Vec<f64>,
    /// Angular momentum about the system's center of mass h₀, inertial axes, N m s; it never changes.
    pub angular_momentum_n_m_s: Vector3<f64>,
}

impl Initial {
    pub(crate) fn from_file(
        initial: &file::Initial,
        system: &SystemDescription,
        place: &Location,
        notes: &mut Vec<String>,
    ) -> Result<Self, Error> {
        let attitude = match initial.attitude {
            Some(wxyz) => unit_quaternion(wxyz, &place.key("attitude"), notes)?,
            None => Quaternion::identity(),
        };
        let rate_place = place.key("angular_rate_deg_s");
        let angular_rate_deg_s = rate_place
            .all_within(initial.angular_rate_deg_s.unwrap_or_default(), ANGULAR_RATE_DEG_S)?;
        let omega = Vector3::from(angular_rate_deg_s).map(f64::to_radians);
        let q = joint_angles(initial, system, &place.key("joint_angles_deg"))?;
        let qdot = joint_rates(initial, system, &place.key("joint_rates_deg_s"))?;
        let model = &system.model;
        let at_rest = Vector3::zeros();
        Ok(Self {
            attitude,
            velocity_m_s: model.base_velocity(&attitude, &omega, &q, &qdot, &at_rest),
            angular_rate_rad_s: omega,
            angular_momentum_n_m_s: attitude
                .to_inertial(&model.angular_momentum(&omega, &q, &qdot)),
            joint_angles_rad: q,
            joint_rates_rad_s: qdot,
        })
    }

    /// The full state at the start.
    pub fn state(&self) -> State<f64> {
        State {
            position: Vector3::zeros(),
            attitude: self.attitude,
            velocity: self.velocity_m_s,
            angular_rate: self.angular_rate_rad_s,
            joint_angles: self.joint_angles_rad.clone(),
            joint_rates: self.joint_rates_rad_s.clone(),
        }
    }
}

fn joint_angles(
    initial: &file::Initial,
    system: &SystemDescription,
    place: &Location,
) -> Result<Vec<f64>, Error> {
    require_one_a_joint(&initial.joint_angles_deg, system, place)?;
    let given = initial.joint_angles_deg.iter().enumerate();
    given.map(|(joint, &angle_deg)| joint_angle(angle_deg, joint, system, place)).collect()
}

/// Checks the angle of a joint, counted from zero, that stands in an array at `place`; rad.
pub(crate) fn joint_angle(
    angle_deg: f64,
    joint: usize,
    system: &SystemDescription,
    place: &Location,
) -> Result<f64, Error> {
    let limits = &system.joint_limits[joint];
    let place = place.index(joint);
    let angle_rad = place.within(angle_deg, JOINT_ANGLE_DEG)?.to_radians();
    if angle_rad < limits.angle_min_rad || angle_rad > limits.angle_max_rad {
        let low = Number(degrees(limits.angle_min_rad));
        let high = Number(degrees(limits.angle_max_rad));
        let name = system.names.joint(joint);
        let allowed = match limits.is_locked() {
            true => format!("{low}, the angle at which {name} is locked"),
            false => format!("{low} to {high}, the limits of {name}"),
        };
        return Err(place.refuse(Number(angle_deg), allowed));
    }
    Ok(angle_rad)
}

fn joint_rates(
    initial: &file::Initial,
    system: &SystemDescription,
    place: &Location,
) -> Result<Vec<f64>, Error> {
    let Some(rates_deg_s) = &initial.joint_rates_deg_s else {
        return Ok(vec![0.0; system.joint_count()]);
    };
    require_one_a_joint(rates_deg_s, system, place)?;
    let checked = rates_deg_s.iter().zip(&system.joint_limits).enumerate();
    checked
        .map(|(index, (&rate_deg_s, limits))| {
            let name = || system.names.joint(index);
            let rate_rad_s = rate_deg_s.to_radians();
            if limits.is_locked() && rate_deg_s != 0.0 {
                let allowed = format!("0: {} is locked", name());
                return Err(place.index(index).refuse(Number(rate_deg_s), allowed));
            }
            if rate_rad_s.is_nan() || rate_rad_s.abs() > limits.rate_max_rad_s {
                let allowed = format!(
                    "at most {} in magnitude, the limit of {}",
                    Number(degrees(limits.rate_max_rad_s)),
                    name()
                );
                return Err(place.index(index).refuse(Number(rate_deg_s), allowed));
            }
            Ok(rate_rad_s)
        })
        .collect()
}

pub(crate) fn require_one_a_joint<T>(
    values: &[T],
    system: &SystemDescription,
    place: &Location,
) -> Result<(), Error> {
    if values.len() == system.joint_count() {
        return Ok(());
    }
    let allowed = format!("an array of {}, one a joint", system.joint_count());
    Err(place.refuse(format!("an array of {}", values.len()), allowed))
}

/// Degrees as they stood in the file: without the last digits that the way to radians and back adds.
fn degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e9).round() / 1e9
}
