//! The element `<inertial>`.

use nalgebra::{Matrix3, Vector3};
use righting_multibody::{RigidBody, nearest_inertia};

use super::{ReadOptions, origin};
use crate::document::Element;
use crate::error::ImportError;
use crate::notes::Notes;

/// Heavier than any spacecraft, kg.
const HEAVIEST_KG: f64 = 1e6;
/// How far an inertia may be from one that a body has by rounding of printed digits, relative.
const PRINTED: f64 = 1e-5;
/// How far arithmetic alone may put it, relative.
const COMPUTED: f64 = 1e-9;
/// More than the heaviest spacecraft's about a point a kilometer away, kg m².
const LARGEST_KG_M2: f64 = 1e12;

/// The mass of a link in its frame; none where the file gives none.
pub(super) fn inertial(
    link: Element<'_>,
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<RigidBody, ImportError> {
    let Some(element) = link.child("inertial")? else {
        notes.massless.push(link.text("name").unwrap_or_default().to_owned());
        return Ok(massless());
    };
    let mass = element.required_child("mass")?;
    let mass_kg = mass.required_number("value")?;
    if !(0.0..=HEAVIEST_KG).contains(&mass_kg) {
        let expected = format!("a mass from 0 to {HEAVIEST_KG}: URDF is in kg");
        return Err(mass.place_of("value").refuse(mass_kg, expected));
    }
    let given = match element.child("inertia")? {
        Some(inertia) => matrix(inertia)?,
        None => Matrix3::zeros(),
    };
    if mass_kg == 0.0 && given.amax() > 0.0 {
        return Err(element.place().refuse("an inertia without a mass", "both or neither"));
    }
    if mass_kg == 0.0 {
        return Ok(massless());
    }
    if given.amax() == 0.0 && !options.point_masses {
        return Err(element.place().refuse(
            format!("a mass of {mass_kg} kg without inertia"),
            "an inertia that is not zero, or the option that takes such links as point masses",
        ));
    }
    let inertia_kg_m2 = physical(&given, element, options, notes)?;
    let frame = origin(element)?;
    Ok(RigidBody {
        mass_kg,
        center_of_mass_m: frame.position_m,
        inertia_kg_m2: frame.rotation * inertia_kg_m2 * frame.rotation.transpose(),
    })
}

fn massless() -> RigidBody {
    RigidBody { mass_kg: 0.0, center_of_mass_m: Vector3::zeros(), inertia_kg_m2: Matrix3::zeros() }
}

fn matrix(element: Element<'_>) -> Result<Matrix3<f64>, ImportError> {
    let diagonal = |name| element.required_number(name);
    let product = |name| Ok::<f64, ImportError>(element.number(name)?.unwrap_or(0.0));
    let (xy, xz, yz) = (product("ixy")?, product("ixz")?, product("iyz")?);
    let (xx, yy, zz) = (diagonal("ixx")?, diagonal("iyy")?, diagonal("izz")?);
    let matrix = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    if matrix.amax() > LARGEST_KG_M2 {
        let expected = format!("at most {LARGEST_KG_M2:e}: URDF is in kg m²");
        return Err(element.place().refuse(format!("{:e}", matrix.amax()), expected));
    }
    Ok(matrix)
}

/// The inertia, or the nearest one that a rigid body has.
fn physical(
    given: &Matrix3<f64>,
    element: Element<'_>,
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<Matrix3<f64>, ImportError> {
    let nearest = nearest_inertia(given);
    // Scaled first, so that no square vanishes.
    let scale = if given.amax() > 0.0 { given.amax() } else { 1.0 };
    let change = ((nearest - given) / scale).norm();
    if change < COMPUTED {
        return Ok(*given);
    }
    let place = element.place();
    if change > PRINTED && !options.project_inertias {
        let mut moments = given.symmetric_eigenvalues();
        moments.as_mut_slice().sort_by(f64::total_cmp);
        let [a, b, c] = moments.data.0[0];
        return Err(place.refuse(
            format!("principal moments of inertia {a:e}, {b:e}, {c:e} kg m²"),
            "none below zero and none above the sum of the others, or the option that takes the nearest \
             inertia that a rigid body can have",
        ));
    }
    notes.push(place.note(format_args!(
        "inertia changed by {:.2e} of its size to the nearest one that a rigid body can have",
        change
    )));
    Ok(nearest)
}
