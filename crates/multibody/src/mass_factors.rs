//! The same system with other masses.

use crate::bodies::RigidBody;
use crate::error::ModelError;
use crate::jointed_body::JointedBody;
use crate::parts::{Base, Link, Payload};
use crate::rows::Rows;
use crate::system::{Arm, System};

/// What the mass and the inertia of a part are multiplied by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassFactors {
    /// Of the mass, and of an inertia that follows from it: that of a rod.
    pub mass: f64,
    /// Of an inertia about the center of mass that is given, or that of a cube.
    pub inertia: f64,
}

impl MassFactors {
    /// Those that change nothing.
    pub const ONE: Self = Self { mass: 1.0, inertia: 1.0 };
}

impl System {
    /// Number of parts with a mass of their own: the base, links or bodies, and a payload.
    pub fn massive_part_count(&self) -> usize {
        let payloads = self.rows().map_or(0, |rows| rows.payload.iter().count());
        1 + self.part_count() + payloads
    }

    /// The same system with the masses of its parts multiplied: those of the base, of links or bodies, and of a
    /// payload, in this order.
    ///
    /// # Errors
    /// [`ModelError::Overflow`] when a number is then beyond any number.
    ///
    /// # Panics
    /// There are not as many factors as [parts](Self::massive_part_count).
    pub fn with_masses_multiplied(&self, factors: &[MassFactors]) -> Result<Self, ModelError> {
        assert_eq!(factors.len(), self.massive_part_count(), "factors of a part each");
        let (of_base, of_parts) = (factors[0], &factors[1..]);
        let base = Base {
            mass_kg: self.base().mass_kg * of_base.mass,
            inertia_kg_m2: self.base().inertia_kg_m2 * of_base.inertia,
            ..self.base().clone()
        };
        let mut of_parts = of_parts.iter();
        let mut next = || of_parts.next().copied().unwrap_or(MassFactors::ONE);
        let arm = match &self.arm {
            Arm::Rows(rows) => {
                let links = rows.links.iter().map(|link| {
                    let MassFactors { mass, inertia } = next();
                    Link {
                        mass_kg: link.mass_kg * mass,
                        inertia_kg_m2: link.inertia_kg_m2.map(|given| given * inertia),
                        ..link.clone()
                    }
                });
                let links = links.collect();
                let payload = rows.payload.as_ref().map(|payload| {
                    let MassFactors { mass, inertia } = next();
                    Payload {
                        mass_kg: payload.mass_kg * mass,
                        inertia_kg_m2: payload.inertia_kg_m2.map(|given| given * inertia),
                    }
                });
                Arm::Rows(Rows { links, payload, ..rows.clone() })
            }
            Arm::Bodies(bodies) => Arm::Bodies(bodies.changed(|body| {
                let MassFactors { mass, inertia } = next();
                let RigidBody { mass_kg, center_of_mass_m, inertia_kg_m2 } = body.body;
                JointedBody {
                    body: RigidBody {
                        mass_kg: mass_kg * mass,
                        center_of_mass_m,
                        inertia_kg_m2: inertia_kg_m2 * inertia,
                    },
                    ..*body
                }
            })),
        };
        Self::assembled(base, arm)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Rotation3, Vector3};

    use super::*;
    use crate::{DhConvention, Mount};

    /// Factors that all are alike multiply all momenta; what turns the base stays as it was.
    #[test]
    fn factors_multiply_what_they_say() -> Result<(), ModelError> {
        let base = Base::uniform_cube(30.0, 0.4)?;
        let links = vec![
            Link::rod(3.0, 0.5, 0.3, 0.1, 0.0),
            Link {
                center_of_mass_m: Some(Vector3::new(0.1, 0.0, 0.02)),
                inertia_kg_m2: Some(Matrix3::from_diagonal_element(0.2)),
                ..Link::rod(2.0, 0.4, -0.2, 0.0, 0.0)
            },
        ];
        let payload = Some(Payload { mass_kg: 1.5, inertia_kg_m2: None });
        let mount = Mount::at(Vector3::new(0.0, 0.0, 0.2));
        let system = System::new(base, mount, DhConvention::Standard, links, payload)?;
        assert_eq!(system.massive_part_count(), 4);

        let (omega, q, rates) = (Vector3::new(0.1, -0.2, 0.3), [0.4, -0.8], [0.3, 0.5]);
        let momentum = |system: &System| system.angular_momentum(&omega, &q, &rates);
        let twice = MassFactors { mass: 2.0, inertia: 2.0 };
        let doubled = system.with_masses_multiplied(&[twice; 4])?;
        assert!((momentum(&doubled) - momentum(&system) * 2.0).norm() < 1e-13);

        let heavy_base = [&[twice][..], &[MassFactors::ONE; 3]].concat();
        let other = system.with_masses_multiplied(&heavy_base)?;
        assert!((other.total_mass() - system.total_mass() - 30.0).abs() < 1e-12);
        let mut inertia_alone = [MassFactors::ONE; 4];
        inertia_alone[2].inertia = 1.5;
        let gained = momentum(&system.with_masses_multiplied(&inertia_alone)?) - momentum(&system);
        // 0.1 kg m² more turn with the base and both joints.
        let second_axis = Rotation3::from_axis_angle(&Vector3::z_axis(), q[0])
            * Rotation3::from_axis_angle(&Vector3::x_axis(), 0.3)
            * Vector3::z();
        let turns = omega + Vector3::z() * rates[0] + second_axis * rates[1];
        assert!((gained - turns * 0.1).norm() < 1e-14);
        Ok(())
    }
}
