//! State at the start of a maneuver.

use nalgebra::Vector3;
use righting_multibody::{JointKind, Quaternion, State};

use crate::error::Error;
use crate::file::{self, JointWords};
use crate::joint_limits::coordinates;
use crate::json::{Bounds, Location, Number};
use crate::system_description::{SystemDescription, unit_quaternion};

const ANGULAR_RATE_DEG_S: Bounds = Bounds::Between(-3.6e6, 3.6e6);

/// State at the start: the base's body frame is at the origin, the system's center of mass at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Initial {
    /// Attitude of the base, body → inertial; of unit length.
    pub attitude: Quaternion<f64>,
    /// Velocity of the body-frame origin that leaves the center of mass at rest, inertial axes, m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Angular rate of the base, body axes, rad/s.
    pub angular_rate_rad_s: Vector3<f64>,
    /// Joint angles, one a joint, rad, and of joints that slide travels, m; within the limits.
    pub joint_angles_rad: Vec<f64>,
    /// Joint rates, one a joint, rad/s or m/s; within the limits.
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
        let q = joint_coordinates(initial, system, place)?;
        let qdot = joint_rates(initial, system, place)?;
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

fn joint_coordinates(
    initial: &file::Initial,
    system: &SystemDescription,
    place: &Location,
) -> Result<Vec<f64>, Error> {
    let given = [&initial.joint_angles_deg[..], &initial.joint_travels_m];
    checked(given, JointWords::coordinates, system, place, |&value, joint, place| {
        joint_coordinate(value, joint, system, place)
    })
}

/// Checks the coordinate of a joint, counted from zero, that stands at `place`; rad or m.
pub(crate) fn joint_coordinate(
    value: f64,
    joint: usize,
    system: &SystemDescription,
    place: &Location,
) -> Result<f64, Error> {
    let limits = &system.joint_limits[joint];
    let words = JointWords::of(limits.kind);
    let coordinate = words.to_si(place.within(value, coordinates(limits.kind))?);
    if coordinate < limits.angle_min_rad || coordinate > limits.angle_max_rad {
        let low = Number(as_written(words, limits.angle_min_rad));
        let high = Number(as_written(words, limits.angle_max_rad));
        let name = system.names.joint(joint);
        let allowed = match (limits.is_locked(), limits.kind) {
            (true, JointKind::Revolute) => format!("{low}, the angle at which {name} is locked"),
            (true, JointKind::Prismatic) => format!("{low}, the travel at which {name} is locked"),
            (false, _) => format!("{low} to {high}, the limits of {name}"),
        };
        return Err(place.refuse(Number(value), allowed));
    }
    Ok(coordinate)
}

fn joint_rates(
    initial: &file::Initial,
    system: &SystemDescription,
    place: &Location,
) -> Result<Vec<f64>, Error> {
    let kinds = system.model.joint_kinds();
    let at_rest = |kind| file::of_kind(&kinds, kind, &vec![0.0; kinds.len()]);
    let angular = initial.joint_rates_deg_s.clone();
    let linear = initial.joint_speeds_m_s.clone();
    let given = [
        &angular.unwrap_or_else(|| at_rest(JointKind::Revolute))[..],
        &linear.unwrap_or_else(|| at_rest(JointKind::Prismatic)),
    ];
    checked(given, JointWords::rates, system, place, |&value, joint, place| {
        let limits = &system.joint_limits[joint];
        let words = JointWords::of(limits.kind);
        let name = || system.names.joint(joint);
        let rate = words.to_si(value);
        if limits.is_locked() && value != 0.0 {
            return Err(place.refuse(Number(value), format!("0: {} is locked", name())));
        }
        if rate.is_nan() || rate.abs() > limits.rate_max_rad_s {
            let most = Number(as_written(words, limits.rate_max_rad_s));
            let allowed = format!("at most {most} in magnitude, the limit of {}", name());
            return Err(place.refuse(Number(value), allowed));
        }
        Ok(rate)
    })
}

/// Checks the values of the joints that turn and of those that slide, which stand in two fields of the
/// object at `place`; in the order of the joints' coordinates.
pub(crate) fn checked<V: Clone, T: Clone>(
    [turning, sliding]: [&[V]; 2],
    field: fn(&JointWords) -> &'static str,
    system: &SystemDescription,
    place: &Location,
    check: impl Fn(&V, usize, &Location) -> Result<T, Error>,
) -> Result<Vec<T>, Error> {
    let kinds = system.model.joint_kinds();
    let all: Vec<usize> = (0..kinds.len()).collect();
    let of = |kind: JointKind, values: &[V]| -> Result<Vec<T>, Error> {
        let joints = file::of_kind(&kinds, kind, &all);
        let words = JointWords::of(kind);
        let place = place.key(field(words));
        if values.len() != joints.len() {
            let whose = match kinds.contains(&JointKind::Prismatic) {
                true => format!("one a joint that {}", words.that),
                false => "one a joint".to_owned(),
            };
            let allowed = format!("an array of {}, {whose}", joints.len());
            return Err(place.refuse(format!("an array of {}", values.len()), allowed));
        }
        let listed = values.iter().zip(joints).enumerate();
        listed.map(|(index, (value, joint))| check(value, joint, &place.index(index))).collect()
    };
    let turning = of(JointKind::Revolute, turning)?;
    let sliding = of(JointKind::Prismatic, sliding)?;
    Ok(file::in_joint_order(&kinds, &turning, &sliding))
}

/// A number as it stood in the file: without the last digits that the way to radians and back adds.
fn as_written(words: &JointWords, value: f64) -> f64 {
    (words.from_si(value) * 1e9).round() / 1e9
}
