//! The same scenario measured in other units.

use righting_multibody::{JointKind, ModelError, Units};

use crate::bodies::Solid;
use crate::collision::{CollisionModel, Other, Pair};
use crate::drive::Drive;
use crate::environment::{Environment, Orbit};
use crate::initial::Initial;
use crate::joint_limits::JointLimits;
use crate::load_limits::LoadLimits;
use crate::pointing::Pointing;
use crate::scenario::{FreeDuration, Horizon, Scenario, Weights};
use crate::system_description::SystemDescription;

impl Scenario {
    /// The same maneuver with every number measured in `units` instead of m, kg and s. Its objective has
    /// the same values, up to a factor on all of them if `objective_unit` is not one: that much of the
    /// objective counts as one.
    ///
    /// [`resolved`](Self::resolved) stays the file as it was.
    ///
    /// # Errors
    /// [`ModelError::Overflow`] when masses or lengths in these units are beyond any number.
    pub fn in_units(&self, units: &Units, objective_unit: f64) -> Result<Self, ModelError> {
        let kinds = self.system.model.joint_kinds();
        Ok(Self {
            system: self.system.in_units(units)?,
            initial: self.initial.in_units(units, &kinds),
            end_angles_rad: kinds
                .iter()
                .zip(&self.end_angles_rad)
                .map(|(kind, end)| end.map(|end| end / units.of_joint(*kind)))
                .collect(),
            horizon: Horizon { duration_s: self.horizon.duration_s / units.time_s, ..self.horizon },
            free_duration: self.free_duration.map(|free| free.in_units(units)),
            weights: self.weights.in_units(units, objective_unit),
            collision: self.collision.in_units(units),
            wheels: self.wheels.iter().map(|wheel| wheel.in_units(units)).collect(),
            end_wheel_momenta_n_m_s: self
                .end_wheel_momenta_n_m_s
                .iter()
                .map(|end| end.map(|momentum| momentum / (units.torque_n_m() * units.time_s)))
                .collect(),
            environment: self.environment.as_ref().map(|acts| acts.in_units(units)),
            pointing: self.pointing.iter().map(|cone| cone.in_units(units)).collect(),
            ..self.clone()
        })
    }
}

impl SystemDescription {
    fn in_units(&self, units: &Units) -> Result<Self, ModelError> {
        let limits = self.joint_limits.iter().map(|limits| limits.in_units(units));
        Ok(Self {
            model: self.model.in_units(units)?,
            keep_out_radius_m: self.keep_out_radius_m.map(|radius_m| radius_m / units.length_m),
            keep_out: self
                .keep_out
                .iter()
                .map(|shape| shape.in_lengths_of(units.length_m))
                .collect(),
            solids: self.solids.iter().map(|solid| solid.in_units(units)).collect(),
            joint_limits: limits.collect(),
            drives: self.drives.iter().map(|drive| drive.in_units(units)).collect(),
            load_limits: self.load_limits.in_units(units),
            ..self.clone()
        })
    }
}

impl JointLimits {
    fn in_units(&self, units: &Units) -> Self {
        let unit = units.of_joint(self.kind);
        Self {
            kind: self.kind,
            angle_min_rad: self.angle_min_rad / unit,
            angle_max_rad: self.angle_max_rad / unit,
            rate_max_rad_s: self.rate_max_rad_s * units.time_s / unit,
            acceleration_max_rad_s2: self.acceleration_max_rad_s2 * units.time_s.powi(2) / unit,
            jerk_max_rad_s3: self.jerk_max_rad_s3 * units.time_s.powi(3) / unit,
            torque_max_n_m: self.torque_max_n_m / (units.torque_n_m() / unit),
        }
    }
}

impl Drive {
    /// Mechanically: what the motor draws stays in W.
    fn in_units(&self, units: &Units) -> Self {
        let Units { length_m, mass_kg, time_s } = *units;
        let inertia_kg_m2 = mass_kg * length_m.powi(2);
        Self {
            viscous_friction_n_m_s: self.viscous_friction_n_m_s * time_s / inertia_kg_m2,
            rotor_inertia_kg_m2: self.rotor_inertia_kg_m2 / inertia_kg_m2,
            ..*self
        }
    }
}

impl LoadLimits {
    fn in_units(&self, units: &Units) -> Self {
        let torque_n_m = units.torque_n_m();
        Self {
            mount_force_max_n: self.mount_force_max_n * units.length_m / torque_n_m,
            mount_moment_max_n_m: self.mount_moment_max_n_m / torque_n_m,
            angular_rate_max_rad_s: self.angular_rate_max_rad_s * units.time_s,
        }
    }
}

impl Initial {
    fn in_units(&self, units: &Units, kinds: &[JointKind]) -> Self {
        let Units { length_m, mass_kg, time_s } = *units;
        let of_joints = |values: &[f64], unit: f64| {
            let listed = kinds.iter().zip(values);
            listed.map(|(kind, value)| value * unit / units.of_joint(*kind)).collect()
        };
        Self {
            velocity_m_s: self.velocity_m_s * (time_s / length_m),
            angular_rate_rad_s: self.angular_rate_rad_s * time_s,
            joint_angles_rad: of_joints(&self.joint_angles_rad, 1.0),
            joint_rates_rad_s: of_joints(&self.joint_rates_rad_s, time_s),
            angular_momentum_n_m_s: self.angular_momentum_n_m_s
                * (time_s / (mass_kg * length_m.powi(2))),
            ..self.clone()
        }
    }
}

impl Environment {
    fn in_units(&self, units: &Units) -> Self {
        Self {
            torque_body_n_m: self.torque_body_n_m / units.torque_n_m(),
            torque_inertial_n_m: self.torque_inertial_n_m / units.torque_n_m(),
            orbit: self
                .orbit
                .map(|orbit| Orbit { rate_rad_s: orbit.rate_rad_s * units.time_s, ..orbit }),
        }
    }
}

impl FreeDuration {
    fn in_units(self, units: &Units) -> Self {
        Self { shortest_s: self.shortest_s / units.time_s }
    }
}

impl Weights {
    /// Each weight times the square of its quantity keeps its value. The control's multiplies an integral
    /// over time; the interval that this is measured by is the same number in any unit.
    fn in_units(&self, units: &Units, objective_unit: f64) -> Self {
        let Units { length_m, time_s, .. } = *units;
        let of = |weight: f64, unit: f64| weight * unit.powi(2) / objective_unit;
        Self {
            control: of(self.control, time_s.powi(-2)) * time_s,
            time: self.time * time_s / objective_unit,
            position: of(self.position, length_m),
            attitude: of(self.attitude, 1.0),
            velocity: of(self.velocity, length_m / time_s),
            angular_rate: of(self.angular_rate, 1.0 / time_s),
            joint_angle: of(self.joint_angle, 1.0),
            joint_rate: of(self.joint_rate, 1.0 / time_s),
            wheel_torque: of(self.wheel_torque, units.torque_n_m()) * time_s,
            wheel_momentum: of(self.wheel_momentum, units.torque_n_m() * time_s),
        }
    }
}

impl Pointing {
    fn in_units(&self, units: &Units) -> Self {
        let mut measured = self.clone();
        measured.direction.times_s.iter_mut().for_each(|time| *time /= units.time_s);
        measured
    }
}

impl Solid {
    fn in_units(&self, units: &Units) -> Self {
        Self {
            core: self.core.in_lengths_of(units.length_m),
            radius_m: self.radius_m / units.length_m,
            ..*self
        }
    }
}

impl CollisionModel {
    fn in_units(&self, units: &Units) -> Self {
        let pairs = self.pairs.iter().map(|pair| Pair {
            between: pair.between,
            solid: pair.solid.in_units(units),
            other: match &pair.other {
                Other::Center => Other::Center,
                Other::KeepOut(shape) => Other::KeepOut(shape.in_lengths_of(units.length_m)),
                Other::Solid(solid) => Other::Solid(solid.in_units(units)),
            },
            least_m: pair.least_m / units.length_m,
        });
        Self { clearance_m: self.clearance_m / units.length_m, pairs: pairs.collect() }
    }
}
