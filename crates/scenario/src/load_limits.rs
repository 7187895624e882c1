//! What the structure and the sensors of a spacecraft bear.

use crate::error::Error;
use crate::file;
use crate::joint_limits::RATE_DEG_S;
use crate::json::{Bounds, Location};

/// Forces in N and torques in N m, of systems in millimeters and grams to kilometers and kilotons.
pub(crate) const LOAD: Bounds = Bounds::Above(0.0, 1e30);

/// What may pass between base and arm, and how fast the base may turn on the way; +∞ where there is no
/// limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadLimits {
    /// Largest force between base and arm at the mount, as a vector's length, N.
    pub mount_force_max_n: f64,
    /// Largest moment between base and arm about the mount, as a vector's length, N m.
    pub mount_moment_max_n_m: f64,
    /// Largest angular rate of the base, as a vector's length, rad/s.
    pub angular_rate_max_rad_s: f64,
}

impl LoadLimits {
    /// Checks the limits of a system that was read from `place`.
    pub(crate) fn from_file(system: &file::System, place: &Location) -> Result<Self, Error> {
        let (base, mount_place) = (place.key("base"), place.key("mount"));
        let of_mount = |of: fn(&file::Mount) -> Option<f64>| system.mount.as_ref().and_then(of);
        let limit = |place: &Location, name: &str, value: Option<f64>, allowed: Bounds| {
            value.map_or(Ok(f64::INFINITY), |value| place.key(name).within(value, allowed))
        };
        let rate_deg_s = system.base.angular_rate_max_deg_s;
        Ok(Self {
            mount_force_max_n: limit(
                &mount_place,
                "force_max_n",
                of_mount(|mount| mount.force_max_n),
                LOAD,
            )?,
            mount_moment_max_n_m: limit(
                &mount_place,
                "moment_max_n_m",
                of_mount(|mount| mount.moment_max_n_m),
                LOAD,
            )?,
            angular_rate_max_rad_s: limit(&base, "angular_rate_max_deg_s", rate_deg_s, RATE_DEG_S)?
                .to_radians(),
        })
    }
}
