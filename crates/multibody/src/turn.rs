//! Constant angles whose right angles are exact.

use nalgebra::Matrix3;
use std::f64::consts::FRAC_PI_2;

/// A constant angle, kept so that multiples of a right angle have exact sine and cosine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turn {
    /// Right angles, 0 to 3.
    pub quarters: i64,
    pub rest_rad: f64,
}

impl Turn {
    pub const NONE: Self = Self { quarters: 0, rest_rad: 0.0 };

    pub fn new(angle_rad: f64) -> Self {
        let turns = angle_rad / FRAC_PI_2;
        let nearest = turns.round();
        // Beyond this size rounding hides which multiple was meant.
        let exact = nearest.abs() < 1e6
            && (turns - nearest).abs() <= 4.0 * f64::EPSILON * nearest.abs().max(1.0);
        if exact {
            Self { quarters: (nearest as i64).rem_euclid(4), rest_rad: 0.0 }
        } else {
            Self { quarters: 0, rest_rad: angle_rad }
        }
    }

    pub fn plus(self, other: Self) -> Self {
        Self {
            quarters: (self.quarters + other.quarters).rem_euclid(4),
            rest_rad: self.rest_rad + other.rest_rad,
        }
    }

    pub fn minus(self, other: Self) -> Self {
        self.plus(Self { quarters: -other.quarters, rest_rad: -other.rest_rad })
    }

    pub fn is_none(self) -> bool {
        self == Self::NONE
    }

    /// Rotation about x by this angle.
    pub fn about_x(self) -> Matrix3<f64> {
        let (sin, cos) = self.sin_cos();
        // Adding zero takes the sign off negative zeros.
        Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos).map(|entry| entry + 0.0)
    }

    /// Rotation about y by this angle.
    pub fn about_y(self) -> Matrix3<f64> {
        let (sin, cos) = self.sin_cos();
        Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos).map(|entry| entry + 0.0)
    }

    /// Rotation about z by this angle.
    pub fn about_z(self) -> Matrix3<f64> {
        let (sin, cos) = self.sin_cos();
        Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0).map(|entry| entry + 0.0)
    }

    pub fn sin_cos(self) -> (f64, f64) {
        let (sin, cos) = self.rest_rad.sin_cos();
        match self.quarters {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_angles_are_exact_however_they_were_converted() {
        for degrees in [-450.0, -270.0, -180.0, -90.0, 0.0, 90.0, 180.0, 270.0, 360.0, 810.0] {
            let turn = Turn::new(f64::to_radians(degrees));
            let (sin, cos) = turn.sin_cos();
            assert_eq!((sin.abs() + cos.abs(), sin * cos), (1.0, 0.0), "{degrees}");
            assert!((sin - f64::to_radians(degrees).sin()).abs() < 1e-14, "{degrees}");
            assert!((cos - f64::to_radians(degrees).cos()).abs() < 1e-14, "{degrees}");
        }
        assert!(Turn::new(f64::to_radians(-360.0)).is_none());
    }

    #[test]
    fn other_angles_are_left_alone() {
        let turn = Turn::new(FRAC_PI_2 + 1e-9);
        assert_eq!(turn.sin_cos(), (FRAC_PI_2 + 1e-9).sin_cos());
    }

    #[test]
    fn sums_and_differences_keep_their_right_angles() {
        let (a, b) = (Turn::new(FRAC_PI_2), Turn::new(0.3));
        let (sin, cos) = a.plus(b).sin_cos();
        assert_eq!((sin, cos), (0.3_f64.cos(), -(0.3_f64.sin())));
        assert!(a.plus(b).minus(b).minus(a).is_none());
    }
}
