//! What can collide: solids on the arm, and what of the base they keep out of.
//!
//! Every solid of the arm is a capsule, and every one moves with a link, a body or the payload. A body has
//! the shapes that it is given. A link is the capsule along its straight segment, of radius zero if none is given, unless it has shapes; one without
//! length and radius collides with nothing.

use std::fmt;

use nalgebra::Vector3;
use righting_multibody::{Core, Cuboid, InertialFrame, Rows, System};

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Location};
use crate::system_description::{LENGTH_M, RADIUS_M};

/// A link shorter than this part of its arm has no length: rounding of what is meant as zero.
pub(crate) const NO_LENGTH: f64 = 1e-9;
const EDGE_M: Bounds = Bounds::Between(0.0, 1e8);

/// A part of the arm that moves as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArmPart {
    /// A link that a row describes, counted from zero.
    Link(usize),
    /// A body of a tree, counted from zero.
    Body(usize),
    /// What the arm holds.
    Payload,
}

/// A piece of a part of the arm. Displayed counted from one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Of which part.
    pub part: ArmPart,
    /// Which of its shapes, counted from zero; none for a part that gives none.
    pub shape: Option<usize>,
}

impl Piece {
    /// A link along its segment.
    pub fn link(link: usize) -> Self {
        Self { part: ArmPart::Link(link), shape: None }
    }
}

impl fmt::Display for ArmPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Link(link) => write!(f, "link {}", link + 1),
            Self::Body(body) => write!(f, "body {}", body + 1),
            Self::Payload => f.write_str("payload"),
        }
    }
}

impl fmt::Display for Piece {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.part.fmt(f)?;
        match self.shape {
            Some(shape) => write!(f, " shape {}", shape + 1),
            None => Ok(()),
        }
    }
}

/// A capsule on the arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// What it is a piece of.
    pub piece: Piece,
    /// The segment that it is swept around.
    pub core: Core,
    /// Radius, m.
    pub radius_m: f64,
}

/// Something of the base that the arm keeps out of, in body axes from the origin of the body frame.
#[derive(Clone, Debug, PartialEq)]
pub enum KeepOut {
    /// A capsule; a sphere where its ends are the same.
    Capsule {
        /// Ends of the segment that it is swept around, m.
        ends_m: [Vector3<f64>; 2],
        /// Radius, m.
        radius_m: f64,
    },
    /// A box.
    Cuboid(Cuboid),
}

impl KeepOut {
    /// Checks a shape that was read from `place`.
    fn from_file(shape: &file::KeepOut, place: &Location) -> Result<Self, Error> {
        match (&shape.sphere, &shape.capsule, &shape.cuboid) {
            (Some(sphere), None, None) => {
                let (ends_m, radius_m) = checked_sphere(sphere, &place.key("sphere"))?;
                Ok(Self::Capsule { ends_m, radius_m })
            }
            (None, Some(capsule), None) => {
                let (ends_m, radius_m) = checked_capsule(capsule, &place.key("capsule"))?;
                Ok(Self::Capsule { ends_m, radius_m })
            }
            (None, None, Some(cuboid)) => {
                let place = place.key("box");
                let center_m = place.key("center_m").all_within(cuboid.center_m, LENGTH_M)?;
                let size_m = place.key("size_m").all_within(cuboid.size_m, EDGE_M)?;
                let half_m = Vector3::from(size_m) / 2.0;
                Ok(Self::Cuboid(Cuboid { center_m: Vector3::from(center_m), half_m }))
            }
            (sphere, capsule, cuboid) => {
                let given = [sphere.is_some(), capsule.is_some(), cuboid.is_some()]
                    .into_iter()
                    .filter(|is| *is);
                Err(place.refuse(shapes(given.count()), "one of sphere, capsule and box"))
            }
        }
    }

    /// The same measured in another unit of so many meters.
    pub(crate) fn in_lengths_of(&self, length_m: f64) -> Self {
        match self {
            Self::Capsule { ends_m, radius_m } => Self::Capsule {
                ends_m: ends_m.map(|end_m| end_m / length_m),
                radius_m: radius_m / length_m,
            },
            Self::Cuboid(cuboid) => Self::Cuboid(Cuboid {
                center_m: cuboid.center_m / length_m,
                half_m: cuboid.half_m / length_m,
            }),
        }
    }
}

/// The shapes of `base.keep_out`.
pub(crate) fn keep_out(base: &file::Base, place: &Location) -> Result<Vec<KeepOut>, Error> {
    let place = place.key("keep_out");
    let shapes = base.keep_out.iter().flatten().enumerate();
    shapes.map(|(index, shape)| KeepOut::from_file(shape, &place.index(index))).collect()
}

/// The solids of the arm, from the base outward.
pub(crate) fn solids(
    system: &file::System,
    model: &System,
    place: &Location,
) -> Result<Vec<Solid>, Error> {
    let mut solids = Vec::new();
    for (index, body) in system.bodies.iter().flatten().enumerate() {
        let place = place.key("bodies").index(index);
        let shapes = body.shapes.as_deref().unwrap_or_default();
        solids.extend(shaped(shapes, ArmPart::Body(index), index + 1, &place)?);
    }
    for (link, row) in system.links.iter().enumerate() {
        let place = place.key("links").index(link);
        let part = ArmPart::Link(link);
        let frame = match row_frame(row, model) {
            InertialFrame::Own => link + 1,
            InertialFrame::Previous => link,
        };
        let radius_m = checked_radius(row.radius_m, row.shapes.as_deref(), &place)?;
        match &row.shapes {
            Some(shapes) => solids.extend(shaped(shapes, part, frame, &place)?),
            None if radius_m > 0.0 || has_length(model, link) => {
                let (piece, core) = (Piece::link(link), Core::Link(link));
                solids.push(Solid { piece, core, radius_m });
            }
            None => {}
        }
    }
    if let Some(payload) = &system.payload {
        let place = place.key("payload");
        let (part, frame) = (ArmPart::Payload, system.links.len());
        let radius_m = checked_radius(payload.radius_m, payload.shapes.as_deref(), &place)?;
        match &payload.shapes {
            Some(shapes) => solids.extend(shaped(shapes, part, frame, &place)?),
            None if radius_m > 0.0 => {
                let center_m = Vector3::zeros();
                let core = Core::InFrame { frame, from_m: center_m, to_m: center_m };
                solids.push(Solid { piece: Piece { part, shape: None }, core, radius_m });
            }
            None => {}
        }
    }
    Ok(solids)
}

fn row_frame(row: &file::Link, model: &System) -> InertialFrame {
    let usual = |rows: &Rows| rows.convention.inertial_frame();
    match row.inertial_frame {
        Some(file::InertialFrame::Own) => InertialFrame::Own,
        Some(file::InertialFrame::Previous) => InertialFrame::Previous,
        None => model.rows().map_or(InertialFrame::Own, usual),
    }
}

/// Whether a link has a segment at all.
fn has_length(model: &System, link: usize) -> bool {
    let length_m = |rows: &Rows| rows.links[link].length_m();
    model.rows().map_or(0.0, length_m) > NO_LENGTH * model.length_m()
}

/// A radius that stands beside shapes would mean nothing.
fn checked_radius(
    radius_m: Option<f64>,
    shapes: Option<&[file::Shape]>,
    place: &Location,
) -> Result<f64, Error> {
    match (radius_m, shapes) {
        (Some(_), Some(_)) => {
            Err(place.key("shapes").refuse("both radius_m and shapes", "one of them"))
        }
        (Some(radius_m), None) => place.key("radius_m").within(radius_m, RADIUS_M),
        (None, _) => Ok(0.0),
    }
}

fn shaped(
    shapes: &[file::Shape],
    part: ArmPart,
    frame: usize,
    place: &Location,
) -> Result<Vec<Solid>, Error> {
    let place = place.key("shapes");
    let solid = |(index, shape): (usize, &file::Shape)| {
        let place = place.index(index);
        let ([from_m, to_m], radius_m) = match (&shape.sphere, &shape.capsule) {
            (Some(sphere), None) => checked_sphere(sphere, &place.key("sphere"))?,
            (None, Some(capsule)) => checked_capsule(capsule, &place.key("capsule"))?,
            (None, None) => return Err(place.refuse(self::shapes(0), "a sphere or a capsule")),
            (Some(_), Some(_)) => {
                return Err(place.refuse(self::shapes(2), "one of sphere and capsule"));
            }
        };
        let piece = Piece { part, shape: Some(index) };
        Ok(Solid { piece, core: Core::InFrame { frame, from_m, to_m }, radius_m })
    };
    shapes.iter().enumerate().map(solid).collect()
}

/// Such as "2 shapes".
fn shapes(count: usize) -> String {
    match count {
        0 => "no shape".to_owned(),
        count => format!("{count} shapes"),
    }
}

fn checked_sphere(
    sphere: &file::Sphere,
    place: &Location,
) -> Result<([Vector3<f64>; 2], f64), Error> {
    let center_m = place.key("center_m").all_within(sphere.center_m, LENGTH_M)?;
    let radius_m = place.key("radius_m").within(sphere.radius_m, RADIUS_M)?;
    Ok(([Vector3::from(center_m); 2], radius_m))
}

fn checked_capsule(
    capsule: &file::Capsule,
    place: &Location,
) -> Result<([Vector3<f64>; 2], f64), Error> {
    let from_m = place.key("from_m").all_within(capsule.from_m, LENGTH_M)?;
    let to_m = place.key("to_m").all_within(capsule.to_m, LENGTH_M)?;
    let radius_m = place.key("radius_m").within(capsule.radius_m, RADIUS_M)?;
    Ok(([from_m, to_m].map(Vector3::from), radius_m))
}
