//! Inertias that no rigid body has, and what to take instead.

use nalgebra::Matrix3;
use righting_multibody::{Base, JointedBody, ModelError, Part, Rows, System, nearest_inertia};

use crate::error::Error;
use crate::file;
use crate::json::{Location, Number};
use crate::model_error::{place_of, refuse};
use crate::rounding::PRINTED;

/// What a system is put together from.
pub(crate) struct Parts {
    pub base: Base,
    pub arm: Arm,
}

/// What is on the base.
pub(crate) enum Arm {
    Rows(Rows),
    Bodies(Vec<JointedBody>),
}

impl Parts {
    /// The model of these parts, which were read from `system` at `place`.
    ///
    /// An inertia that no rigid body has is replaced by the nearest one that a body has, with a note
    /// and in `system` too, where the file allows that or where the difference is no more than the
    /// rounding of printed digits. A base keeps needing a positive definite inertia: one whose nearest
    /// is that of a line or a point is refused.
    pub fn into_model(
        mut self,
        system: &mut file::System,
        place: &Location,
        notes: &mut Vec<String>,
    ) -> Result<System, Error> {
        let mut replaced = Vec::new();
        loop {
            let error = match self.model() {
                Ok(model) => return Ok(model),
                Err(error) => error,
            };
            let part = unphysical(&error).filter(|part| !replaced.contains(part));
            let Some(part) = part else { return Err(refuse(error, place, "")) };
            let Some(inertia) = self.inertia(part) else { return Err(refuse(error, place, "")) };
            let nearest = nearest_inertia(inertia);
            let change = (nearest - *inertia).norm() / inertia.norm();
            let moments = [moments(inertia), moments(&nearest)];
            *inertia = nearest;
            if !system.project_inertias && change > PRINTED {
                // The way out is named where it leads out.
                let helps = self.model().err().and_then(|error| unphysical(&error)) != Some(part);
                let way_out = format!(
                    " (set {} to true for the nearest inertia that a rigid body can have)",
                    place.key("project_inertias").path()
                );
                return Err(refuse(error, place, if helps { &way_out } else { "" }));
            }
            replaced.push(part);
            write(part, &nearest, system);
            let [given, taken] = moments;
            notes.push(place_of(part, place).key("inertia_kg_m2").note(format_args!(
                "changed by {} % (Frobenius norm) to the nearest inertia that a rigid body can have: \
                 principal moments from {given} to {taken}",
                Number::rounded(100.0 * change, 2)
            )));
        }
    }

    fn model(&self) -> Result<System, ModelError> {
        let base = self.base.clone();
        match &self.arm {
            Arm::Rows(rows) => {
                let Rows { mount, convention, links, payload } = rows.clone();
                System::new(base, mount, convention, links, payload)
            }
            Arm::Bodies(bodies) => System::of_bodies(base, bodies.clone()),
        }
    }

    fn inertia(&mut self, part: Part) -> Option<&mut Matrix3<f64>> {
        match (part, &mut self.arm) {
            (Part::Base, _) => Some(&mut self.base.inertia_kg_m2),
            (Part::Link(index), Arm::Rows(rows)) => {
                rows.links.get_mut(index)?.inertia_kg_m2.as_mut()
            }
            (Part::Payload, Arm::Rows(rows)) => rows.payload.as_mut()?.inertia_kg_m2.as_mut(),
            (Part::Body(index), Arm::Bodies(bodies)) => {
                bodies.get_mut(index).map(|body| &mut body.body.inertia_kg_m2)
            }
            _ => None,
        }
    }
}

/// The principal moments of the symmetric part, smallest first, as a note gives them.
fn moments(inertia: &Matrix3<f64>) -> String {
    let mut moments = ((inertia + inertia.transpose()) * 0.5).symmetric_eigenvalues();
    moments.as_mut_slice().sort_by(f64::total_cmp);
    let [a, b, c] = moments.data.0[0].map(|moment| Number::rounded(moment, 4));
    format!("{a}, {b}, {c}")
}

/// The part whose inertia no rigid body has, if that is what is wrong.
fn unphysical(error: &ModelError) -> Option<Part> {
    match error {
        ModelError::NotSymmetric { part, .. }
        | ModelError::NotPositive { part, .. }
        | ModelError::TriangleInequality { part, .. } => Some(*part),
        _ => None,
    }
}

fn write(part: Part, inertia: &Matrix3<f64>, system: &mut file::System) {
    let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| inertia[(row, column)]));
    match part {
        Part::Base => system.base.inertia_kg_m2 = Some(rows),
        Part::Mount => {}
        Part::Link(index) => system.links[index].inertia_kg_m2 = Some(rows),
        Part::Body(index) => {
            if let Some(body) = system.bodies.as_mut().and_then(|bodies| bodies.get_mut(index)) {
                body.inertia_kg_m2 = Some(rows);
            }
        }
        Part::Payload => {
            if let Some(payload) = &mut system.payload {
                payload.inertia_kg_m2 = Some(rows);
            }
        }
    }
}
