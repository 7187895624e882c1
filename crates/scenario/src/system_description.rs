//! A system with everything the planner needs to know about it.

use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use righting_multibody as multibody;
use righting_multibody::{JointKind, Quaternion, System};

use crate::bodies::{KeepOut, Solid, keep_out, solids};
use crate::drive::Drive;
use crate::error::Error;
use crate::file;
use crate::ignored_pairs::{Named, ignored_pairs};
use crate::inertias::{Arm, Parts};
use crate::joint_limits::JointLimits;
use crate::jointed_bodies::jointed_bodies;
use crate::json::{Bounds, Document, FileKind, Location, Number};
use crate::load_limits::LoadLimits;
use crate::names::Names;
use crate::rounding::COMPUTED;
use crate::rows::{doubt_about_frames, rows};
use crate::system_file::SystemFile;

/// The most joints an arm may have.
pub const MAX_JOINTS: usize = 32;

// As wide as systems in millimeters or kilometers, grams or kilotons need.
pub(crate) const MASS_KG: Bounds = Bounds::Between(0.0, 1e15);
pub(crate) const BODY_MASS_KG: Bounds = Bounds::Above(0.0, 1e15);
pub(crate) const LENGTH_M: Bounds = Bounds::Between(-1e8, 1e8);
pub(crate) const SIZE_M: Bounds = Bounds::Above(0.0, 1e8);
pub(crate) const RADIUS_M: Bounds = Bounds::Between(0.0, 1e8);
const INERTIA_KG_M2: Bounds = Bounds::Between(-1e30, 1e30);

/// How far the norm of a quaternion may be from 1 by rounding: four printed digits of each entry.
const UNIT_NORM: f64 = 1e-4;

/// A free-floating base with its arms: masses and geometry, joint limits and keep-out sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemDescription {
    /// Name of the system.
    pub name: String,
    /// Names of its parts and joints.
    pub names: Names,
    /// Masses and geometry.
    pub model: System,
    /// Radius of the sphere about the origin of the body frame that the arm keeps out of, m, if there is one.
    pub keep_out_radius_m: Option<f64>,
    /// What else of the base it keeps out of.
    pub keep_out: Vec<KeepOut>,
    /// The solids of the arm, from the base outward.
    pub solids: Vec<Solid>,
    /// Pairs of bodies that may touch and cross.
    pub ignored_pairs: Vec<[Named; 2]>,
    /// Limits, one a joint.
    pub joint_limits: Vec<JointLimits>,
    /// Drives, one a joint.
    pub drives: Vec<Drive>,
    /// What the mount bears, and how fast the base may turn.
    pub load_limits: LoadLimits,
    /// Whether a link or body may be inside what the base keeps out, such as a part of the mount; one each.
    pub body_exempt: Vec<bool>,
}

impl SystemDescription {
    /// Reads and checks a system file.
    ///
    /// # Errors
    /// Those of reading, and [`Error::Field`] for a field that is wrong.
    pub fn read(file: &Path) -> Result<Self, Error> {
        Ok(SystemFile::read(file)?.description)
    }

    /// Number of joints j.
    pub fn joint_count(&self) -> usize {
        self.joint_limits.len()
    }

    /// What a unit of each joint's coordinate counts against a radian: 1 where the joint turns; where it slides,
    /// its travel counts by the system's size.
    pub fn radians_a_unit(&self) -> Vec<f64> {
        let size_m = self.model.size_m();
        let counts = |limits: &JointLimits| match limits.kind {
            JointKind::Revolute => 1.0,
            JointKind::Prismatic => 1.0 / size_m,
        };
        self.joint_limits.iter().map(counts).collect()
    }

    /// Whether a joint's jerk is limited: then accelerations are continuous, and jerks the controls.
    pub fn limits_jerk(&self) -> bool {
        self.joint_limits.iter().any(|limits| limits.jerk_max_rad_s3.is_finite())
    }

    /// Joint coordinates at a point of the unit cube spread over the joints' ranges, rad or m; a joint without
    /// limits ranges over one turn.
    pub fn joint_angles_at(&self, unit: &[f64]) -> Vec<f64> {
        let ranges = self.joint_limits.iter().zip(unit);
        ranges
            .map(|(limits, unit)| {
                let (low, high) = limits.angle_range_rad();
                low + (high - low) * unit
            })
            .collect()
    }

    /// Checks a system that was read from `place`; what was accepted with a change is changed in
    /// `system` too, and noted.
    pub(crate) fn from_file(
        system: &mut file::System,
        place: &Location,
        notes: &mut Vec<String>,
    ) -> Result<Self, Error> {
        if system.name.trim().is_empty() {
            return Err(place.key("name").refuse("\"\"", "a name"));
        }
        let base_place = place.key("base");
        let (base, keep_out_radius_m) = base(&system.base, &base_place)?;
        let keep_out = keep_out(&system.base, &base_place)?;
        check_kind_of_arm(system, place)?;
        let names = Names::new(system, place)?;
        let arm = match &system.bodies {
            Some(bodies) => Arm::Bodies(jointed_bodies(bodies, &system.base, place, notes)?),
            None => Arm::Rows(rows(system, place, notes)?),
        };
        let joints = system.joints();
        let joint_limits = joints.iter().map(|row| JointLimits::from_file(row, place));
        let joint_limits = joint_limits.collect::<Result<_, _>>()?;
        let drives = joints.iter().map(|row| Drive::of_joint(row, place));
        let drives = drives.collect::<Result<_, _>>()?;
        let model = Parts { base, arm }.into_model(system, place, notes)?;
        notes.extend(doubt_about_frames(system, &place.key("links")));
        let exempt_links = system.links.iter().map(|link| link.body_exempt);
        let exempt_bodies = system.bodies.iter().flatten().map(|body| body.body_exempt);
        Ok(Self {
            name: system.name.clone(),
            names,
            keep_out_radius_m,
            keep_out,
            solids: solids(system, &model, place)?,
            ignored_pairs: ignored_pairs(system, keep_out_radius_m.is_some(), place)?,
            model,
            joint_limits,
            drives,
            load_limits: LoadLimits::from_file(system, place)?,
            body_exempt: exempt_links.chain(exempt_bodies).collect(),
        })
    }
}

/// An arm is described by rows or by bodies.
fn check_kind_of_arm(system: &file::System, place: &Location) -> Result<(), Error> {
    let has_links = !system.links.is_empty();
    if system.bodies.is_none() && system.mount.is_none() && !has_links {
        return Err(place.key("links").missing("the rows of an arm on a mount, or bodies instead"));
    }
    let rows_alone = [
        ("mount", system.mount.is_some()),
        ("dh_convention", system.dh_convention.is_some()),
        ("links", has_links),
        ("payload", system.payload.is_some()),
    ];
    match rows_alone.iter().find(|(_, is_given)| *is_given && system.bodies.is_some()) {
        Some((name, _)) => {
            let found = format!("both {name} and bodies");
            Err(place.key("bodies").refuse(found, "either bodies, or links on a mount"))
        }
        None => Ok(()),
    }
}

/// Reads a system file without checking its values.
pub(crate) fn read_system(file: &Path) -> Result<file::System, Error> {
    Document::read(file, FileKind::System)?.decode()
}

/// A unit quaternion w, x, y, z, if it is one to four printed digits; noted where it is none to
/// the last one.
pub(crate) fn unit_quaternion(
    wxyz: [f64; 4],
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<Quaternion<f64>, Error> {
    place.all_within(wxyz, Bounds::Between(-2.0, 2.0))?;
    let [w, x, y, z] = wxyz;
    let quaternion = Quaternion::from_array(wxyz);
    let norm = quaternion.norm_squared().sqrt();
    let deviation = (norm - 1.0).abs();
    if deviation > UNIT_NORM {
        let allowed = format!("a unit quaternion w, x, y, z (this one's norm is {norm})");
        return Err(place.refuse(format!("[{w}, {x}, {y}, {z}]"), allowed));
    }
    if deviation > COMPUTED {
        notes.push(place.note(format_args!(
            "its norm is {}: taken as a unit quaternion, for rounding",
            Number::rounded(norm, 9)
        )));
    }
    Ok(quaternion.normalized())
}

/// The base, and the radius of its keep-out sphere if it has one: beside `keep_out` only where it is given.
pub(crate) fn base(
    base: &file::Base,
    place: &Location,
) -> Result<(multibody::Base, Option<f64>), Error> {
    let mass_kg = place.key("mass_kg").within(base.mass_kg, BODY_MASS_KG)?;
    let cube_place = place.key("cube_side_m");
    let radius_place = place.key("keep_out_radius_m");
    let radius_m = base
        .keep_out_radius_m
        .map(|radius_m| radius_place.within(radius_m, RADIUS_M))
        .transpose()?;
    let has_shapes = base.keep_out.is_some();
    let center_place = place.key("center_of_mass_m");
    let center_of_mass_m = vector(base.center_of_mass_m.unwrap_or_default(), &center_place)?;
    match (base.cube_side_m, &base.inertia_kg_m2) {
        (Some(_), Some(_)) => {
            let place = place.key("inertia_kg_m2");
            Err(place.refuse("both cube_side_m and inertia_kg_m2", "one of them"))
        }
        (Some(_), None) if base.center_of_mass_m.is_some() => {
            Err(center_place.refuse("both cube_side_m and center_of_mass_m", "one of them"))
        }
        (Some(side_m), None) => {
            let side_m = cube_place.within(side_m, SIZE_M)?;
            let circumscribed_m = (!has_shapes).then(|| side_m * 3.0_f64.sqrt() / 2.0);
            let body = multibody::Base::uniform_cube(mass_kg, side_m)
                .map_err(|_| cube_place.refuse(Number(side_m), SIZE_M))?;
            Ok((body, radius_m.or(circumscribed_m)))
        }
        (None, Some(inertia)) => {
            let inertia_kg_m2 = matrix(inertia, &place.key("inertia_kg_m2"))?;
            if radius_m.is_none() && !has_shapes {
                return Err(radius_place.missing(
                    "the radius of the keep-out sphere, which goes with inertia_kg_m2, or keep_out",
                ));
            }
            Ok((multibody::Base { mass_kg, center_of_mass_m, inertia_kg_m2 }, radius_m))
        }
        (None, None) => Err(cube_place
            .missing("the side of a cube, or inertia_kg_m2 with keep_out_radius_m or keep_out")),
    }
}

pub(crate) fn vector(values: [f64; 3], place: &Location) -> Result<Vector3<f64>, Error> {
    place.all_within(values, LENGTH_M).map(Vector3::from)
}

pub(crate) fn matrix(rows: &[[f64; 3]; 3], place: &Location) -> Result<Matrix3<f64>, Error> {
    for (index, row) in rows.iter().enumerate() {
        place.index(index).all_within(*row, INERTIA_KG_M2)?;
    }
    Ok(Matrix3::from_fn(|row, column| rows[row][column]))
}
