//! Units of measurement, and the same system measured in others.

use crate::bodies::{Placement, RigidBody};
use crate::error::ModelError;
use crate::jointed_body::{JointKind, JointedBody};
use crate::parts::{Base, Link, Mount, Payload};
use crate::rows::Rows;
use crate::system::{Arm, System};

/// Units of length, mass and time, in those of the SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// The unit of length, m.
    pub length_m: f64,
    /// The unit of mass, kg.
    pub mass_kg: f64,
    /// The unit of time, s.
    pub time_s: f64,
}

impl Units {
    /// Metre, kilogram, second.
    pub const SI: Self = Self { length_m: 1.0, mass_kg: 1.0, time_s: 1.0 };

    /// The unit of a joint's coordinate: a radian, or the unit of length in m where the joint slides.
    pub fn of_joint(&self, kind: JointKind) -> f64 {
        match kind {
            JointKind::Revolute => 1.0,
            JointKind::Prismatic => self.length_m,
        }
    }

    /// The unit of torque and of energy, N m.
    pub fn torque_n_m(&self) -> f64 {
        self.mass_kg * (self.length_m / self.time_s).powi(2)
    }
}

impl System {
    /// The same system with its masses and lengths measured in `units`.
    ///
    /// # Errors
    /// [`ModelError::Overflow`] when a number in these units is beyond any number.
    pub fn in_units(&self, units: &Units) -> Result<Self, ModelError> {
        let Units { length_m, mass_kg, .. } = *units;
        let inertia_kg_m2 = mass_kg * length_m.powi(2);
        let base = Base {
            mass_kg: self.base().mass_kg / mass_kg,
            center_of_mass_m: self.base().center_of_mass_m / length_m,
            inertia_kg_m2: self.base().inertia_kg_m2 / inertia_kg_m2,
        };
        let arm = match &self.arm {
            Arm::Rows(rows) => Arm::Rows(rows.in_units(units)),
            Arm::Bodies(bodies) => Arm::Bodies(bodies.changed(|body| body.in_units(units))),
        };
        Self::assembled(base, arm)
    }
}

impl Rows {
    fn in_units(&self, units: &Units) -> Self {
        let Units { length_m, mass_kg, .. } = *units;
        let inertia_kg_m2 = mass_kg * length_m.powi(2);
        let mount = Mount { position_m: self.mount.position_m / length_m, ..self.mount };
        let links = self.links.iter().map(|link| Link {
            mass_kg: link.mass_kg / mass_kg,
            a_m: link.a_m / length_m,
            d_m: link.d_m / length_m,
            center_of_mass_m: link.center_of_mass_m.map(|center| center / length_m),
            inertia_kg_m2: link.inertia_kg_m2.map(|inertia| inertia / inertia_kg_m2),
            ..link.clone()
        });
        let payload = self.payload.as_ref().map(|payload| Payload {
            mass_kg: payload.mass_kg / mass_kg,
            inertia_kg_m2: payload.inertia_kg_m2.map(|inertia| inertia / inertia_kg_m2),
        });
        Self { mount, convention: self.convention, links: links.collect(), payload }
    }
}

impl JointedBody {
    fn in_units(&self, units: &Units) -> Self {
        let Units { length_m, mass_kg, .. } = *units;
        let position_m = self.placement.position_m / length_m;
        Self {
            placement: Placement { position_m, ..self.placement },
            body: RigidBody {
                mass_kg: self.body.mass_kg / mass_kg,
                center_of_mass_m: self.body.center_of_mass_m / length_m,
                inertia_kg_m2: self.body.inertia_kg_m2 / (mass_kg * length_m.powi(2)),
            },
            ..*self
        }
    }
}
