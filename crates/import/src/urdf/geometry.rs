//! The element `<geometry>` of a collision.

use std::path::Path;

use nalgebra::Vector3;
use righting_multibody::Placement;

use super::FARTHEST_M;
use crate::bounding_capsule::bounding_capsule;
use crate::document::Element;
use crate::error::ImportError;
use crate::mesh;
use crate::notes::Notes;
use crate::shape::{Capsule, Cuboid, Shape};

/// The shape in the collision's frame; none of a mesh that is not read, which is noted.
pub(super) fn shape(
    geometry: Element<'_>,
    folder: Option<&Path>,
    notes: &mut Notes,
) -> Result<Option<Shape>, ImportError> {
    let element = geometry.only_child()?;
    let shape = match element.tag() {
        "sphere" => Shape::Capsule(rod(0.0, size(element, "radius")?)),
        "capsule" | "cylinder" => {
            Shape::Capsule(rod(size(element, "length")?, size(element, "radius")?))
        }
        "box" => {
            let sides = element.vector("size")?;
            let size_m = sides.ok_or_else(|| element.place().refuse("no size", "one"))?;
            for side in size_m {
                check_length(element, "size", side)?;
            }
            Shape::Cuboid(Cuboid { placement: Placement::identity(), size_m: size_m.into() })
        }
        "mesh" => {
            let Some(capsule) = around_mesh(element, folder, notes)? else { return Ok(None) };
            Shape::Capsule(capsule)
        }
        other => {
            let expected = "box, capsule, cylinder, mesh or sphere";
            return Err(element.place().refuse(format!("<{other}>"), expected));
        }
    };
    Ok(Some(shape))
}

fn size(element: Element<'_>, name: &str) -> Result<f64, ImportError> {
    let length_m = element.required_number(name)?;
    check_length(element, name, length_m)?;
    Ok(length_m)
}

fn check_length(element: Element<'_>, name: &str, length_m: f64) -> Result<(), ImportError> {
    if (0.0..=FARTHEST_M).contains(&length_m) {
        return Ok(());
    }
    let expected = format!("a length from 0 to {FARTHEST_M}: URDF is in m");
    Err(element.place_of(name).refuse(length_m, expected))
}

/// A capsule along z, centered. Around a cylinder it is also what spheres at the cylinder's ends add to it,
/// as files without capsules have them.
fn rod(length_m: f64, radius_m: f64) -> Capsule {
    let end = Vector3::new(0.0, 0.0, length_m / 2.0);
    Capsule { ends_m: [-end, end], radius_m }
}

fn around_mesh(
    element: Element<'_>,
    folder: Option<&Path>,
    notes: &mut Notes,
) -> Result<Option<Capsule>, ImportError> {
    let name = element.required_text("filename")?;
    let scale = Vector3::from(element.vector("scale")?.unwrap_or([1.0; 3]));
    match mesh::corners(name, folder) {
        Ok(corners) => {
            let scaled =
                corners.iter().map(|corner| corner.component_mul(&scale)).collect::<Vec<_>>();
            let farthest_m = scaled.iter().map(|corner| corner.amax()).fold(0.0, f64::max);
            check_length(element, "filename", farthest_m)?;
            notes.bounded_meshes.push(name.to_owned());
            Ok(Some(bounding_capsule(&scaled)))
        }
        Err(reason) => {
            notes.lost_meshes.push(format!("{name} ({reason})"));
            Ok(None)
        }
    }
}
