//! Joints that slide: how what lies beyond one changes on the way along the joint's axis.
//!
//! A slide moves all that the joint carries, a mass m, by s = q e along the axis e, which is z of K. Counted
//! from the system's centre of mass (see [`Coupling`](crate::coupling::Coupling)), with M the total mass and
//! b = (1 − m/M) s,
//!
//! ```text
//! F' = F + m s,      S̃' = S̃ + F bᵀ + b Fᵀ + m s bᵀ
//! P' = P + m q̇ e,    H' = H + b × P + (1 − m/M) q̇ F × e
//! f' = f + m s̈,      N' = N + b × f + (F + m s) × (1 − m/M) s̈
//! ```
//!
//! P and H are momentum and angular momentum, f and N force and moment, and s̈ is the acceleration of s in
//! inertial space, from the joint's and that of the frame in which it slides.

use crate::algebra::{cross, scaled, sum};
use crate::branches::Beyond;
use crate::dynamics::Spin;
use crate::sweep::{Moments, Pair};
use nalgebra::Vector3;
use righting_scalar::Scalar;

/// Constants of a joint that slides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Slide {
    /// The mass that it carries, m, kg.
    pub mass: f64,
    /// 1 − m/M.
    pub share: f64,
}

impl Slide {
    pub fn new(mass: f64, total_mass: f64) -> Self {
        Self { mass, share: 1.0 - mass / total_mass }
    }

    /// From where the carried frame is to where it is with the joint at zero; axes stay.
    pub fn moments<T: Scalar>(&self, moments: Moments<T>, q: T) -> Moments<T> {
        let Moments { first, second } = moments;
        let (arm, moved) = (q * self.share, q * self.mass);
        let along = first.z + first.z + moved;
        Moments {
            first: Vector3::new(first.x, first.y, first.z + moved),
            second: second.plus_along_z(first.x * arm, first.y * arm, along * arm),
        }
    }

    /// [`moments`](Self::moments) in other axes, in which the joint's is `axis`.
    pub fn moments_along<T: Scalar>(
        &self,
        moments: Moments<T>,
        axis: &Vector3<T>,
        q: T,
    ) -> Moments<T> {
        let arm = self.arm_along(axis, q);
        let moved = scaled(axis, q * self.mass);
        let middle = sum(&moments.first, &scaled(&moved, T::from(0.5)));
        let second = moments.second.plus_outer(&middle, &arm);
        Moments { first: sum(&moments.first, &moved), second }
    }

    /// b where the joint's axis is `axis`.
    pub fn arm_along<T: Scalar>(&self, axis: &Vector3<T>, q: T) -> Vector3<T> {
        scaled(axis, q * self.share)
    }

    /// The angular momentum that a unit of the joint's rate gives, the joint's axis being `axis`: all that
    /// it carries has the moments `moments` and lies `reach` from the point that momenta are counted about.
    pub fn column<T: Scalar>(
        &self,
        moments: &Moments<T>,
        axis: &Vector3<T>,
        reach: &Vector3<T>,
    ) -> Vector3<T> {
        let own = scaled(&moments.first, T::from(self.share));
        cross(&sum(&own, &scaled(reach, T::from(self.mass))), axis)
    }

    /// The same of momenta, and adds what the joint's rate gives.
    pub fn momenta<T: Scalar>(&self, beyond: Beyond<T>, q: T, rate: T) -> Beyond<T> {
        let Beyond { moments, pair } = beyond;
        let Pair { linear, angular } = pair.shifted_along(q * self.share);
        let turning = rate * self.share;
        let first = &moments.first;
        let pair = Pair {
            linear: Vector3::new(linear.x, linear.y, linear.z + rate * self.mass),
            angular: Vector3::new(
                angular.x + turning * first.y,
                angular.y - turning * first.x,
                angular.z,
            ),
        };
        Beyond { moments: self.moments(moments, q), pair }
    }

    /// The same of force and moment, `spin` being that of the frame in which the joint slides.
    pub fn loads<T: Scalar>(
        &self,
        beyond: Beyond<T>,
        spin: &Spin<T>,
        [q, rate, acceleration]: [T; 3],
    ) -> Beyond<T> {
        let Pair { linear, angular } = beyond.pair.shifted_along(q * self.share);
        let moments = self.moments(beyond.moments, q);
        let moved = acceleration_along(spin, [q, rate, acceleration]);
        let swing = scaled(&moved, T::from(self.share));
        let pair = Pair {
            linear: sum(&linear, &scaled(&moved, T::from(self.mass))),
            angular: sum(&angular, &cross(&moments.first, &swing)),
        };
        Beyond { moments, pair }
    }
}

/// s̈ of s = q e_z that moves along z of a frame, in the frame's axes: ẅ × s + ω × (ω × s) + 2 ω × ṡ + q̈ e_z
/// with ẅ the frame's angular acceleration.
pub(crate) fn acceleration_along<T: Scalar>(
    spin: &Spin<T>,
    [q, rate, acceleration]: [T; 3],
) -> Vector3<T> {
    let [_, _, swing] = spin.columns();
    let twice = rate + rate;
    Vector3::new(
        swing.x * q + spin.rate.y * twice,
        swing.y * q - spin.rate.x * twice,
        swing.z * q + acceleration,
    )
}
