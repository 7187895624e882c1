//! What acts on the system from outside.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use righting_scenario::file;

use super::{Motion, State};

/// Equatorial radius of the Earth, m, and its gravitational parameter, m³/s².
const EARTH_RADIUS_M: f64 = 6_378_137.0;
const EARTH_PARAMETER_M3_S2: f64 = 3.986_004_418e14;

/// What acts at one moment, in inertial axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outside {
    /// Couple on the base, N m.
    pub torque: Vector3<f64>,
    /// From the system's center of mass to the center of the Earth, m; none where gravity is the same everywhere.
    pub earth: Option<Vector3<f64>>,
}

/// What acts all the time, of a resolved scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// Couples on the base in body and in inertial axes, N m.
    torque_body: Vector3<f64>,
    torque_inertial: Vector3<f64>,
    orbit: Option<Orbit>,
}

/// A circular orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Orbit {
    /// From the center of the Earth at the start, inertial axes, m.
    position: Vector3<f64>,
    /// About which it goes round, inertial axes, of unit length.
    normal: Vector3<f64>,
    /// rad/s.
    rate: f64,
}

impl Surroundings {
    /// Of a resolved scenario's environment.
    pub fn new(environment: Option<&file::Environment>) -> Self {
        let Some(given) = environment else { return Self::default() };
        let vector = |torque: Option<[f64; 3]>| Vector3::from(torque.unwrap_or_default());
        Self {
            torque_body: vector(given.torque_body_n_m),
            torque_inertial: vector(given.torque_inertial_n_m),
            orbit: given.gravity_gradient.as_ref().map(Orbit::new),
        }
    }

    /// Whether nothing acts: angular momentum is conserved.
    pub fn are_empty(&self) -> bool {
        *self == Self::default()
    }

    /// What acts in an attitude (body → inertial) at a time since the start.
    pub fn at(&self, attitude: &Quaternion<f64>, time_s: f64) -> Outside {
        let attitude = UnitQuaternion::from_quaternion(*attitude);
        Outside {
            torque: self.torque_inertial + attitude * self.torque_body,
            earth: self.orbit.map(|orbit| -orbit.position_at(time_s)),
        }
    }
}

impl Orbit {
    fn new(gradient: &file::GravityGradient) -> Self {
        let radius = EARTH_RADIUS_M + 1000.0 * gradient.altitude_km;
        let about =
            |axis: Vector3<f64>, angle_deg: f64| UnitQuaternion::new(axis * angle_deg.to_radians());
        let (up, normal) = match (&gradient.elements, gradient.orbit_attitude) {
            (Some(elements), _) => {
                let plane = about(Vector3::z(), elements.right_ascension_deg)
                    * about(Vector3::x(), elements.inclination_deg);
                let place = plane * about(Vector3::z(), elements.argument_of_latitude_deg);
                (place * Vector3::x(), plane * Vector3::z())
            }
            (None, given) => {
                let [w, x, y, z] = given.unwrap_or([1.0, 0.0, 0.0, 0.0]);
                let frame = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
                (frame * -Vector3::z(), frame * -Vector3::y())
            }
        };
        let rate = (EARTH_PARAMETER_M3_S2 / radius.powi(3)).sqrt();
        Self { position: up * radius, normal, rate }
    }

    /// From the center of the Earth at a time since the start, inertial axes, m.
    fn position_at(&self, time_s: f64) -> Vector3<f64> {
        UnitQuaternion::new(self.normal * (self.rate * time_s)) * self.position
    }
}

impl Outside {
    /// With what wheels do to a base in the state `state`: they have a momentum in store and give a torque, its rate,
    /// both in body axes (N m s, N m).
    pub fn with_wheels(
        self,
        state: &State<'_>,
        momentum: &Vector3<f64>,
        torque: &Vector3<f64>,
    ) -> Self {
        let attitude = UnitQuaternion::from_quaternion(state.attitude);
        let reaction = -(torque + state.angular_rate.cross(momentum));
        Self { torque: self.torque + attitude * reaction, ..self }
    }

    /// Force and moment about its own center of mass with which gravity pulls at a body more than at the system's
    /// center of mass, to first order in `from_center` (m) over the orbit's radius; `inertia` is in inertial axes.
    fn pull(
        &self,
        mass: f64,
        from_center: &Vector3<f64>,
        inertia: &nalgebra::Matrix3<f64>,
    ) -> [Vector3<f64>; 2] {
        let Some(earth) = self.earth else { return [Vector3::zeros(); 2] };
        let (radius, nadir) = (earth.norm(), earth.normalize());
        let stiffness = EARTH_PARAMETER_M3_S2 / radius.powi(3);
        let along = nadir * nadir.dot(from_center);
        let force = (along * 3.0 - from_center) * (stiffness * mass);
        [force, nadir.cross(&(inertia * nadir)) * (3.0 * stiffness)]
    }
}

impl Motion {
    /// Takes the pull of gravity off what every body needs to move as it does.
    pub(super) fn take_off(&mut self, outside: &Outside) {
        if outside.earth.is_none() {
            return;
        }
        let center = self.center_of_mass();
        for body in self.bodies_mut() {
            let from_center = body.center - center;
            let [force, moment] = outside.pull(body.mass, &from_center, &body.inertia);
            body.force -= force;
            body.moment -= moment;
        }
    }

    /// The moment of all that acts from outside about the system's center of mass, inertial axes, N m.
    pub fn moment_of(&self, outside: &Outside) -> Vector3<f64> {
        let center = self.center_of_mass();
        let pulls = self.bodies().iter().map(|body| {
            let from_center = body.center - center;
            let [force, moment] = outside.pull(body.mass, &from_center, &body.inertia);
            from_center.cross(&force) + moment
        });
        pulls.fold(outside.torque, |sum, moment| sum + moment)
    }
}
