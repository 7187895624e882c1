//! What acts on the system from outside: a couple on the base, and the pull of a planet that is not the same
//! everywhere.
//!
//! With o the unit vector from the system's center of mass to the planet, n the rate of a circular orbit there
//! and d the place of a mass element from that center, the element falls by
//!
//! ```text
//! G d = n² (3 o oᵀ − 1) d
//! ```
//!
//! faster than the center (to first order in ‖d‖ over the orbit's radius). All elements together feel no force, and
//! the moment
//!
//! ```text
//! 3 n² o × Ĩ o
//! ```
//!
//! about the center (Hughes, *Spacecraft Attitude Dynamics*, section 8.1). What a joint has to hold of it is the
//! part that acts beyond the joint.

use crate::algebra::{PlaneRotation, constant_rotation, cross, dot, scaled, sum};
use crate::system::System;
use nalgebra::{Matrix3, Vector3};
use righting_scalar::Scalar;

/// What acts from outside, body axes.
#[derive(Debug, Clone, PartialEq)]
pub struct External<T> {
    /// Couple on the base, N m.
    pub torque: Vector3<T>,
    /// Gravity gradient on all bodies; none where there is no gravity, or it is the same everywhere.
    pub gravity_gradient: Option<GravityGradient<T>>,
}

/// The gravity gradient of a circular orbit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GravityGradient<T> {
    /// Unit vector o to the planet or away from it, body axes.
    pub nadir: Vector3<T>,
    /// n², the square of the orbit's rate, rad²/s².
    pub rate_squared: f64,
}

impl<T: Scalar> GravityGradient<T> {
    /// G d of a place `from_center` of the system's center of mass, in the axes of o, m/s².
    pub(crate) fn acceleration(&self, from_center: &Vector3<T>) -> Vector3<T> {
        let along = dot(&self.nadir, from_center) * 3.0;
        Vector3::from_fn(|i, _| (self.nadir[i] * along - from_center[i]) * self.rate_squared)
    }

    /// The moment 3 n² o × J o on a body with the inertia J, about any point of it once the pull at that point is
    /// taken off; given J o.
    pub(crate) fn moment(&self, inertia_along: &Vector3<T>) -> Vector3<T> {
        scaled(&cross(&self.nadir, inertia_along), T::from(3.0 * self.rate_squared))
    }

    pub(crate) fn rotated_back(&self, rotation: &Matrix3<f64>) -> Self {
        Self { nadir: constant_rotation(&rotation.transpose(), &self.nadir), ..*self }
    }

    pub(crate) fn turned_back(&self, rotation: &PlaneRotation<T>) -> Self {
        Self { nadir: rotation.turn_back(&self.nadir), ..*self }
    }
}

impl System {
    /// The moment about the system's center of mass of what acts from outside, body axes, N m, with the joints at
    /// `q` (j, rad).
    ///
    /// # Panics
    /// `q` does not have one value a joint.
    pub fn external_moment<T: Scalar>(&self, external: &External<T>, q: &[T]) -> Vector3<T> {
        match &external.gravity_gradient {
            None => external.torque,
            Some(gradient) => {
                let along = self.locked_inertia(q) * gradient.nadir;
                sum(&external.torque, &gradient.moment(&along))
            }
        }
    }
}
