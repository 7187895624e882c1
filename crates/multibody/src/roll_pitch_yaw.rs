//! Rotations as roll, pitch and yaw, as robot description files write them.

use nalgebra::{Matrix3, Vector3};

use crate::bodies::Placement;

impl Placement {
    /// A frame at `position_m` that is turned about the fixed axes x, y and z by three angles, one after
    /// the other: R = Rz(yaw) Ry(pitch) Rx(roll).
    pub fn from_roll_pitch_yaw(position_m: Vector3<f64>, angles_rad: [f64; 3]) -> Self {
        let [roll, pitch, yaw] = angles_rad;
        Self { position_m, rotation: Self::rotation_of_rpy(roll, pitch, yaw) }
    }

    /// Roll, pitch and yaw of the rotation, rad. Yaw is taken off before roll is read, so that the three
    /// together are the rotation to rounding at a pitch of a right angle too, where each by itself is not
    /// determined.
    pub fn roll_pitch_yaw_rad(&self) -> [f64; 3] {
        let rotation = &self.rotation;
        let yaw = rotation[(1, 0)].atan2(rotation[(0, 0)]);
        let (sin, cos) = yaw.sin_cos();
        let about_z = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        let rest = about_z.transpose() * rotation;
        let pitch = (-rest[(2, 0)]).atan2(rest[(0, 0)]);
        let roll = (-rest[(1, 2)]).atan2(rest[(1, 1)]);
        [roll, pitch, yaw]
    }

    /// Where the other frame sits in this one.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self { position_m: -(rotation * self.position_m), rotation }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_three_angles_are_the_rotation_at_any_pitch() {
        let at = Vector3::new(0.1, -2.0, 3.0);
        for pitch_deg in [0.0, 30.0, -90.0, 90.0, 90.0 - 1e-7, 90.0 - 1e-12, 120.0] {
            for (roll_deg, yaw_deg) in [(0.0, 0.0), (90.0, 180.0), (-37.0, 161.0), (10.0, -90.0)] {
                let angles = [roll_deg, pitch_deg, yaw_deg].map(f64::to_radians);
                let frame = Placement::from_roll_pitch_yaw(at, angles);
                let again = Placement::from_roll_pitch_yaw(at, frame.roll_pitch_yaw_rad());
                let off = (again.rotation - frame.rotation).amax();
                assert!(off < 1e-15, "{roll_deg} {pitch_deg} {yaw_deg}");
            }
        }
    }

    #[test]
    fn there_and_back_is_the_same_frame() {
        let frame = Placement::from_roll_pitch_yaw(Vector3::new(0.1, -2.0, 3.0), [0.3, -1.2, 2.0]);
        let same = frame.then(&frame.inverse());
        assert!(same.position_m.amax() < 1e-15);
        assert!((same.rotation - Matrix3::identity()).amax() < 1e-15);
    }
}
