//! The element `<link>`.

use super::geometry::shape;
use super::inertial::inertial;
use super::{ReadOptions, origin};
use crate::document::Element;
use crate::error::ImportError;
use crate::notes::Notes;
use crate::robot::Link;

pub(super) fn link(
    element: Element<'_>,
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<Link, ImportError> {
    let mut shapes = Vec::new();
    for collision in element.children("collision") {
        let placement = origin(collision)?;
        let geometry = collision.required_child("geometry")?;
        if let Some(shape) = shape(geometry, options.folder.as_deref(), notes)? {
            shapes.push(shape.placed(&placement));
        }
    }
    Ok(Link {
        name: element.required_text("name")?.to_owned(),
        place: element.place(),
        body: inertial(element, options, notes)?,
        shapes,
        parent_joint: None,
        child_joints: Vec::new(),
    })
}
