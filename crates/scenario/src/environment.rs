//! What acts on a spacecraft from outside.

use nalgebra::{Rotation3, Vector3};
use righting_multibody::{External, GravityGradient, Quaternion};
use righting_scalar::Scalar;

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Location};
use crate::system_description::unit_quaternion;

/// Equatorial radius of the Earth, km, and its gravitational parameter, km³/s² (WGS 84).
const EARTH_RADIUS_KM: f64 = 6378.137;
const EARTH_PARAMETER_KM3_S2: f64 = 398_600.441_8;

const ALTITUDE_KM: Bounds = Bounds::Above(0.0, 1e6);
const TORQUE_N_M: Bounds = Bounds::Between(-1e6, 1e6);
const INCLINATION_DEG: Bounds = Bounds::Between(0.0, 180.0);
const ANGLE_DEG: Bounds = Bounds::Between(-360.0, 360.0);

/// What acts from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Environment {
    /// Couple on the base that turns with it, body axes, N m.
    pub torque_body_n_m: Vector3<f64>,
    /// Couple on the base that stays where it is, inertial axes, N m.
    pub torque_inertial_n_m: Vector3<f64>,
    /// The orbit whose gravity gradient acts; none where none does.
    pub orbit: Option<Orbit>,
}

/// A circular orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// n, rad/s.
    pub rate_rad_s: f64,
    /// Unit vector to the center of the Earth at the start, inertial axes.
    pub nadir: Vector3<f64>,
    /// Unit vector along the velocity at the start, inertial axes.
    pub ahead: Vector3<f64>,
}

impl Orbit {
    /// Unit vector to the center of the Earth at a time since the start, inertial axes.
    pub fn nadir_at<T: Scalar>(&self, time: T) -> Vector3<T> {
        let angle = time * self.rate_rad_s;
        let (sin, cos) = angle.sin_cos();
        Vector3::from_fn(|i, _| cos * self.nadir[i] - sin * self.ahead[i])
    }
}

impl Environment {
    /// Whether anything acts.
    pub fn acts(&self) -> bool {
        self.orbit.is_some() || self.has_torque()
    }

    fn has_torque(&self) -> bool {
        self.torque_body_n_m != Vector3::zeros() || self.torque_inertial_n_m != Vector3::zeros()
    }

    /// What acts in an attitude (body → inertial) at a time since the start.
    pub fn external<T: Scalar>(&self, attitude: &Quaternion<T>, time: T) -> External<T> {
        let fixed = attitude.to_body(&self.torque_inertial_n_m.map(T::from));
        External {
            torque: Vector3::from_fn(|i, _| fixed[i] + self.torque_body_n_m[i]),
            gravity_gradient: self.orbit.map(|orbit| GravityGradient {
                nadir: attitude.to_body(&orbit.nadir_at(time)),
                rate_squared: orbit.rate_rad_s.powi(2),
            }),
        }
    }

    /// Checks what was read from `place`, and fills in its defaults.
    pub(crate) fn from_file(
        environment: &mut file::Environment,
        place: &Location,
        notes: &mut Vec<String>,
    ) -> Result<Self, Error> {
        let torque = |name: &str, torque: &mut Option<[f64; 3]>| {
            let place = place.key(name);
            place.all_within(*torque.get_or_insert_default(), TORQUE_N_M).map(Vector3::from)
        };
        Ok(Self {
            torque_body_n_m: torque("torque_body_n_m", &mut environment.torque_body_n_m)?,
            torque_inertial_n_m: torque(
                "torque_inertial_n_m",
                &mut environment.torque_inertial_n_m,
            )?,
            orbit: match &mut environment.gravity_gradient {
                Some(gradient) => Some(orbit(gradient, &place.key("gravity_gradient"), notes)?),
                None => None,
            },
        })
    }
}

impl file::GravityGradient {
    /// The same orbit, with the start so much later.
    pub fn move_on(&mut self, time_s: f64) {
        let turned = rate_rad_s(self.altitude_km) * time_s;
        match (&mut self.elements, &mut self.orbit_attitude) {
            (Some(elements), _) => {
                let angle_deg = elements.argument_of_latitude_deg + turned.to_degrees();
                elements.argument_of_latitude_deg = angle_deg % 360.0;
            }
            (None, attitude) => {
                // y of the orbit's frame is against the orbit's normal.
                let frame = Quaternion::from_array(attitude.unwrap_or([1.0, 0.0, 0.0, 0.0]));
                let along = Quaternion::from_axis_angle(&Vector3::y(), -turned);
                *attitude = Some(frame.product(&along).normalized().to_array());
            }
        }
    }
}

/// Of a circular orbit.
fn rate_rad_s(altitude_km: f64) -> f64 {
    (EARTH_PARAMETER_KM3_S2 / (EARTH_RADIUS_KM + altitude_km).powi(3)).sqrt()
}

fn orbit(
    gradient: &mut file::GravityGradient,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<Orbit, Error> {
    let altitude_km = place.key("altitude_km").within(gradient.altitude_km, ALTITUDE_KM)?;
    let [nadir, ahead] = match (&gradient.elements, gradient.orbit_attitude) {
        (Some(_), Some(_)) => {
            let expected = "one of them";
            return Err(place.key("elements").refuse("both orbit_attitude and elements", expected));
        }
        (Some(elements), None) => axes_of(elements, &place.key("elements"))?,
        (None, given) => {
            let wxyz = given.unwrap_or([1.0, 0.0, 0.0, 0.0]);
            gradient.orbit_attitude = Some(wxyz);
            let frame = unit_quaternion(wxyz, &place.key("orbit_attitude"), notes)?;
            [Vector3::z(), Vector3::x()].map(|axis| frame.to_inertial(&axis))
        }
    };
    Ok(Orbit { rate_rad_s: rate_rad_s(altitude_km), nadir, ahead })
}

/// Directions to the center of the Earth and ahead.
fn axes_of(elements: &file::OrbitalElements, place: &Location) -> Result<[Vector3<f64>; 2], Error> {
    let angle = |name: &str, angle_deg: f64, bounds| {
        place.key(name).within(angle_deg, bounds).map(f64::to_radians)
    };
    let file::OrbitalElements { inclination_deg, right_ascension_deg, argument_of_latitude_deg } =
        *elements;
    let inclination = angle("inclination_deg", inclination_deg, INCLINATION_DEG)?;
    let node = angle("right_ascension_deg", right_ascension_deg, ANGLE_DEG)?;
    let along = angle("argument_of_latitude_deg", argument_of_latitude_deg, ANGLE_DEG)?;
    let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
    let (x, z) = (Vector3::x_axis(), Vector3::z_axis());
    let turned = about(z, node) * about(x, inclination) * about(z, along);
    Ok([turned * -Vector3::x(), turned * Vector3::y()])
}
