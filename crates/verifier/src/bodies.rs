//! What can collide, from the system file.

use nalgebra::Vector3;
use righting_scenario::bodies::{ArmPart, Piece};
use righting_scenario::file;

use crate::model::{Cuboid, Pose, Segment};

/// A length below this part of the arm's is none.
pub(super) const ROUNDING: f64 = 1e-9;

/// A capsule that moves with the arm.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub piece: Piece,
    pub axis: Axis,
    pub radius_m: f64,
}

/// The segment inside a capsule, and what it moves with.
#[derive(Clone, Debug)]
pub(super) enum Axis {
    /// Link i of rows, from origin i−1 to origin i; counted from zero.
    Link(usize),
    /// Two points in the axes of a frame, m.
    InFrame(usize, [Vector3<f64>; 2]),
}

impl Solid {
    /// Where the segment is, given the arm's frames in body axes.
    pub fn segment(&self, frames: &[Pose]) -> Segment {
        match &self.axis {
            Axis::Link(link) => {
                Segment { start: frames[*link].origin, end: frames[link + 1].origin }
            }
            Axis::InFrame(frame, ends) => {
                let Pose { rotation, origin } = &frames[*frame];
                let [start, end] = ends.map(|end| origin + rotation * end);
                Segment { start, end }
            }
        }
    }
}

/// Something of the base.
#[derive(Clone, Debug)]
pub(super) enum Fixed {
    /// All points within a radius of a segment; about the origin of the body frame for the keep-out sphere.
    Capsule(Segment, f64),
    Cuboid(Cuboid),
}

impl Fixed {
    pub fn new(shape: &file::KeepOut) -> Option<Self> {
        let cuboid = |cuboid: &file::Cuboid| {
            let (center, size) = (Vector3::from(cuboid.center_m), Vector3::from(cuboid.size_m));
            Self::Cuboid(Cuboid { low: center - size / 2.0, high: center + size / 2.0 })
        };
        let capsule = |([start, end], radius_m): ([Vector3<f64>; 2], f64)| {
            Self::Capsule(Segment { start, end }, radius_m)
        };
        let sphere = shape.sphere.as_ref().map(of_sphere);
        let round = sphere.or(shape.capsule.as_ref().map(of_capsule)).map(capsule);
        round.or(shape.cuboid.as_ref().map(cuboid))
    }
}

/// The solids of the arm: the shapes of bodies, or, from the base outward, links along their segments, if they have length or
/// thickness, or the shapes that are given instead, in the frames that the masses move with.
pub(super) fn solids(system: &file::System) -> Vec<Solid> {
    let lengths_m = system.links.iter().map(|link| link.a_m.hypot(link.d_m));
    let rounding_m = ROUNDING * lengths_m.sum::<f64>();
    let mut solids = Vec::new();
    for (index, body) in system.bodies.iter().flatten().enumerate() {
        let shapes = body.shapes.as_deref().unwrap_or_default();
        solids.extend(shaped(ArmPart::Body(index), index + 1, shapes));
    }
    for (index, link) in system.links.iter().enumerate() {
        let part = ArmPart::Link(index);
        let is_previous = match (link.inertial_frame, system.dh_convention) {
            (Some(frame), _) => frame == file::InertialFrame::Previous,
            (None, convention) => convention == Some(file::DhConvention::Modified),
        };
        let frame = if is_previous { index } else { index + 1 };
        let radius_m = link.radius_m.unwrap_or(0.0);
        match &link.shapes {
            Some(shapes) => solids.extend(shaped(part, frame, shapes)),
            None if radius_m > 0.0 || link.a_m.hypot(link.d_m) > rounding_m => {
                let piece = Piece { part, shape: None };
                solids.push(Solid { piece, axis: Axis::Link(index), radius_m });
            }
            None => {}
        }
    }
    if let Some(payload) = &system.payload {
        let (part, frame) = (ArmPart::Payload, system.links.len());
        match (&payload.shapes, payload.radius_m) {
            (Some(shapes), _) => solids.extend(shaped(part, frame, shapes)),
            (None, Some(radius_m)) if radius_m > 0.0 => {
                let axis = Axis::InFrame(frame, [Vector3::zeros(); 2]);
                solids.push(Solid { piece: Piece { part, shape: None }, axis, radius_m });
            }
            (None, _) => {}
        }
    }
    solids
}

fn shaped(part: ArmPart, frame: usize, shapes: &[file::Shape]) -> impl Iterator<Item = Solid> + '_ {
    shapes.iter().enumerate().filter_map(move |(index, shape)| {
        let sphere = shape.sphere.as_ref().map(of_sphere);
        let (ends, radius_m) = sphere.or(shape.capsule.as_ref().map(of_capsule))?;
        let piece = Piece { part, shape: Some(index) };
        Some(Solid { piece, axis: Axis::InFrame(frame, ends), radius_m })
    })
}

fn of_sphere(sphere: &file::Sphere) -> ([Vector3<f64>; 2], f64) {
    ([Vector3::from(sphere.center_m); 2], sphere.radius_m)
}

fn of_capsule(capsule: &file::Capsule) -> ([Vector3<f64>; 2], f64) {
    ([capsule.from_m, capsule.to_m].map(Vector3::from), capsule.radius_m)
}
