//! Trees of bodies, from a system file.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};
use righting_multibody::{BodyJoint, JointKind, JointedBody, Placement, RigidBody};

use crate::error::Error;
use crate::file::{self, JointType};
use crate::json::{Bounds, Location, Number, shown};
use crate::system_description::{MASS_KG, MAX_JOINTS, matrix, unit_quaternion, vector};

/// The most bodies a system may have, fixed ones among them.
const MAX_BODIES: usize = 1000;
const ANGLE_DEG: Bounds = Bounds::Between(-360.0, 360.0);
const AXIS: Bounds = Bounds::Between(-1e8, 1e8);

/// The bodies of a system that was read from `place`, each with its place in the list as its parent's.
pub(crate) fn jointed_bodies(
    bodies: &[file::Body],
    base: &file::Base,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<Vec<JointedBody>, Error> {
    let place = place.key("bodies");
    if !(1..=MAX_BODIES).contains(&bodies.len()) {
        let allowed = format!("an array of 1 to {MAX_BODIES} bodies");
        return Err(place.refuse(format!("{} bodies", bodies.len()), allowed));
    }
    let joints = bodies.iter().filter(|body| body.joint.kind != JointType::Fixed).count();
    if !(1..=MAX_JOINTS).contains(&joints) {
        let found = format!("{joints} joints that move");
        return Err(place.refuse(found, format!("1 to {MAX_JOINTS} joints that move")));
    }
    let parents = parents(bodies, base, &place)?;
    let listed = bodies.iter().zip(parents).enumerate();
    listed
        .map(|(index, (body, parent))| {
            let place = place.index(index);
            let joint_place = place.key("joint");
            Ok(JointedBody {
                parent,
                placement: placement(&body.joint, &joint_place, notes)?,
                joint: joint(&body.joint, &joint_place)?,
                body: rigid_body(body, &place)?,
            })
        })
        .collect()
}

/// The place in the list of each body's parent; none for the base.
fn parents(
    bodies: &[file::Body],
    base: &file::Base,
    place: &Location,
) -> Result<Vec<Option<usize>>, Error> {
    let base = base.name();
    let places: BTreeMap<&str, usize> =
        bodies.iter().enumerate().map(|(index, body)| (body.name.as_str(), index)).collect();
    let mut parents = Vec::with_capacity(bodies.len());
    for (index, body) in bodies.iter().enumerate() {
        let parent = match places.get(body.parent.as_str()) {
            Some(&parent) => Some(parent),
            None if body.parent == base => None,
            None => {
                let expected = format!("the name of another body, or of the base, \"{base}\"");
                let place = place.index(index).key("parent");
                return Err(place.refuse(shown(&body.parent.as_str().into()), expected));
            }
        };
        parents.push(parent);
    }
    for index in 0..bodies.len() {
        // No way to the base is longer than the list.
        let mut inward = std::iter::successors(Some(index), |&body| parents[body]);
        if inward.by_ref().nth(bodies.len()).is_some() {
            let expected = format!("a body that leads to the base, \"{base}\", not in a circle");
            let found = shown(&bodies[index].parent.as_str().into());
            return Err(place.index(index).key("parent").refuse(found, expected));
        }
    }
    Ok(parents)
}

fn placement(
    joint: &file::Joint,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<Placement, Error> {
    let position_m = vector(joint.position_m.unwrap_or_default(), &place.key("position_m"))?;
    let rotation = match (joint.rpy_deg, joint.rotation) {
        (Some(_), Some(_)) => {
            return Err(place.key("rotation").refuse("both rpy_deg and rotation", "one of them"));
        }
        (Some(angles), None) => {
            let angles = place.key("rpy_deg").all_within(angles, ANGLE_DEG)?;
            let [roll, pitch, yaw] = angles.map(f64::to_radians);
            Placement::rotation_of_rpy(roll, pitch, yaw)
        }
        (None, Some(wxyz)) => {
            unit_quaternion(wxyz, &place.key("rotation"), notes)?.rotation_matrix()
        }
        (None, None) => Matrix3::identity(),
    };
    Ok(Placement { position_m, rotation })
}

fn joint(joint: &file::Joint, place: &Location) -> Result<BodyJoint, Error> {
    let refuse = |name: &str, value: Option<f64>, of: &str| match value {
        Some(value) => Err(place.key(name).refuse(Number(value), format!("none for a {of} joint"))),
        None => Ok(()),
    };
    let kind = joint.kind.joint_kind();
    let of = match joint.kind {
        JointType::Fixed => "fixed",
        JointType::Revolute => "revolute",
        JointType::Continuous => "continuous",
        JointType::Prismatic => "prismatic",
    };
    if kind != Some(JointKind::Revolute) {
        for (name, value) in [
            ("angle_min_deg", joint.angle_min_deg),
            ("angle_max_deg", joint.angle_max_deg),
            ("rate_max_deg_s", joint.rate_max_deg_s),
            ("acceleration_max_deg_s2", joint.acceleration_max_deg_s2),
            ("jerk_max_deg_s3", joint.jerk_max_deg_s3),
            ("torque_max_n_m", joint.torque_max_n_m),
        ] {
            refuse(name, value, of)?;
        }
        if joint.drive.is_some() {
            return Err(place.key("drive").refuse("a drive", format!("none for a {of} joint")));
        }
    }
    if kind != Some(JointKind::Prismatic) {
        for (name, value) in [
            ("travel_min_m", joint.travel_min_m),
            ("travel_max_m", joint.travel_max_m),
            ("speed_max_m_s", joint.speed_max_m_s),
            ("acceleration_max_m_s2", joint.acceleration_max_m_s2),
            ("jerk_max_m_s3", joint.jerk_max_m_s3),
            ("force_max_n", joint.force_max_n),
        ] {
            refuse(name, value, of)?;
        }
    }
    if joint.kind == JointType::Continuous {
        refuse("angle_min_deg", joint.angle_min_deg, of)?;
        refuse("angle_max_deg", joint.angle_max_deg, of)?;
    }
    match kind {
        None if joint.axis.is_some() => {
            Err(place.key("axis").refuse("an axis", "none for a fixed joint"))
        }
        None => Ok(BodyJoint::Fixed),
        Some(JointKind::Revolute) => Ok(BodyJoint::Revolute(axis(joint, place)?)),
        Some(JointKind::Prismatic) => Ok(BodyJoint::Prismatic(axis(joint, place)?)),
    }
}

/// The axis of a joint that moves; its largest component is ±1.
fn axis(joint: &file::Joint, place: &Location) -> Result<Vector3<f64>, Error> {
    let place = place.key("axis");
    let axis = place.all_within(joint.axis.unwrap_or([0.0, 0.0, 1.0]), AXIS)?;
    // So that squares of small numbers do not vanish.
    let largest = Vector3::from(axis).amax();
    if largest == 0.0 {
        return Err(place.refuse("[0, 0, 0]", "a vector that is not zero"));
    }
    Ok(Vector3::from(axis) / largest)
}

fn rigid_body(body: &file::Body, place: &Location) -> Result<RigidBody, Error> {
    let center_place = place.key("center_of_mass_m");
    let inertia = body.inertia_kg_m2.unwrap_or_default();
    Ok(RigidBody {
        mass_kg: place.key("mass_kg").within(body.mass_kg, MASS_KG)?,
        center_of_mass_m: vector(body.center_of_mass_m.unwrap_or_default(), &center_place)?,
        inertia_kg_m2: matrix(&inertia, &place.key("inertia_kg_m2"))?,
    })
}
