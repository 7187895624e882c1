//! A system with everything the planner needs to know about it.

use std::path::Path;

use nalgebra::{Matrix3, Rotation3, Vector3};
use righting_multibody as multibody;
use righting_multibody::{Quaternion, System};

use crate::bodies::{KeepOut, Solid, keep_out, solids};
use crate::drive::Drive;
use crate::error::Error;
use crate::file;
use crate::ignored_pairs::{Named, ignored_pairs};
use crate::inertias::Parts;
use crate::joint_limits::JointLimits;
use crate::json::{Bounds, Document, FileKind, Location, Number};
use crate::load_limits::LoadLimits;
use crate::rounding::COMPUTED;

/// The most joints an arm may have.
pub const MAX_JOINTS: usize = 32;

// As wide as systems in millimeters or kilometers, grams or kilotons need.
pub(crate) const MASS_KG: Bounds = Bounds::Between(0.0, 1e15);
const BODY_MASS_KG: Bounds = Bounds::Above(0.0, 1e15);
pub(crate) const LENGTH_M: Bounds = Bounds::Between(-1e8, 1e8);
pub(crate) const SIZE_M: Bounds = Bounds::Above(0.0, 1e8);
pub(crate) const RADIUS_M: Bounds = Bounds::Between(0.0, 1e8);
const INERTIA_KG_M2: Bounds = Bounds::Between(-1e30, 1e30);
const DH_ANGLE_DEG: Bounds = Bounds::Between(-360.0, 360.0);

/// How far the norm of a quaternion may be from 1 by rounding: four printed digits of each entry.
const UNIT_NORM: f64 = 1e-4;

/// A free-floating base with an arm: masses and geometry, joint limits and keep-out sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemDescription {
    /// Name of the system.
    pub name: String,
    /// Masses and geometry.
    pub model: System,
    /// Radius of the sphere about the base's center of mass that the arm keeps out of, m, if there is one.
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
    /// Whether a link may be inside what the base keeps out, such as a part of the mount; one a link.
    pub body_exempt: Vec<bool>,
}

impl SystemDescription {
    /// Reads and checks a system file.
    ///
    /// # Errors
    /// Those of reading, and [`Error::Field`] for a field that is wrong.
    pub fn read(file: &Path) -> Result<Self, Error> {
        Self::from_file(&mut read_system(file)?, &Location::root(file), &mut Vec::new())
    }

    /// Number of joints j, which is also the number of links.
    pub fn joint_count(&self) -> usize {
        self.joint_limits.len()
    }

    /// Whether a joint's jerk is limited: then accelerations are continuous, and jerks the controls.
    pub fn limits_jerk(&self) -> bool {
        self.joint_limits.iter().any(|limits| limits.jerk_max_rad_s3.is_finite())
    }

    /// Joint angles at a point of the unit cube spread over the joints' ranges, rad; a joint without
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
        let mount = mount(&system.mount, &place.key("mount"), notes)?;
        let convention = match system.dh_convention {
            file::DhConvention::Standard => multibody::DhConvention::Standard,
            file::DhConvention::Modified => multibody::DhConvention::Modified,
        };
        let links_place = place.key("links");
        if !(1..=MAX_JOINTS).contains(&system.links.len()) {
            let allowed = format!("an array of 1 to {MAX_JOINTS} links");
            return Err(links_place.refuse(format!("{} links", system.links.len()), allowed));
        }
        let mut links = Vec::new();
        let mut joint_limits = Vec::new();
        let mut drives = Vec::new();
        for (index, row) in system.links.iter().enumerate() {
            let place = links_place.index(index);
            links.push(link(row, &place)?);
            joint_limits.push(JointLimits::from_file(row, &place)?);
            let drive = row.drive.as_ref();
            drives.push(drive.map_or(Ok(Drive::default()), |drive| {
                Drive::from_file(drive, &place.key("drive"))
            })?);
        }
        let payload = match &system.payload {
            Some(payload) => Some(self::payload(payload, &place.key("payload"))?),
            None => None,
        };
        let parts = Parts { base, mount, convention, links, payload };
        let model = parts.into_model(system, place, notes)?;
        notes.extend(doubt_about_frames(system, &links_place));
        Ok(Self {
            name: system.name.clone(),
            keep_out_radius_m,
            keep_out,
            solids: solids(system, &model, place)?,
            ignored_pairs: ignored_pairs(system, keep_out_radius_m.is_some(), place)?,
            model,
            joint_limits,
            drives,
            load_limits: LoadLimits::from_file(system, place)?,
            body_exempt: system.links.iter().map(|link| link.body_exempt).collect(),
        })
    }
}

/// A remark on a file that looks as if its inertials were in other frames than they are taken in:
/// those of a Craig table are in the links' own frames, and nobody means to fix link 1 to the base.
fn doubt_about_frames(system: &file::System, links: &Location) -> Option<String> {
    let is_modified = system.dh_convention == file::DhConvention::Modified;
    let is_said = system.links.iter().any(|link| link.inertial_frame.is_some());
    let is_given = system
        .links
        .iter()
        .any(|link| link.center_of_mass_m.is_some() || link.inertia_kg_m2.is_some());
    let first_kg = system.links.first().map_or(0.0, |link| link.mass_kg);
    (is_modified && is_given && !is_said && first_kg > 0.0).then(|| {
        links.index(0).key("inertial_frame").note(format_args!(
            "missing, so the {} kg of row 1 are fixed to the base, and the inertials of every row i are \
             taken in frame i-1; those of Craig tables and ROS files are in frame i: if these are, set \
             inertial_frame \"own\" on every link (\"previous\" says that they are meant as taken)",
            Number(first_kg)
        ))
    })
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
fn base(base: &file::Base, place: &Location) -> Result<(multibody::Base, Option<f64>), Error> {
    let mass_kg = place.key("mass_kg").within(base.mass_kg, BODY_MASS_KG)?;
    let cube_place = place.key("cube_side_m");
    let radius_place = place.key("keep_out_radius_m");
    let radius_m = base
        .keep_out_radius_m
        .map(|radius_m| radius_place.within(radius_m, RADIUS_M))
        .transpose()?;
    let has_shapes = base.keep_out.is_some();
    match (base.cube_side_m, &base.inertia_kg_m2) {
        (Some(_), Some(_)) => {
            let place = place.key("inertia_kg_m2");
            Err(place.refuse("both cube_side_m and inertia_kg_m2", "one of them"))
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
            Ok((multibody::Base { mass_kg, inertia_kg_m2 }, radius_m))
        }
        (None, None) => Err(cube_place
            .missing("the side of a cube, or inertia_kg_m2 with keep_out_radius_m or keep_out")),
    }
}

fn mount(
    mount: &file::Mount,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<multibody::Mount, Error> {
    let position_m = vector(mount.position_m, &place.key("position_m"))?;
    let rotation = match mount.rotation {
        Some(wxyz) => {
            let rotation = unit_quaternion(wxyz, &place.key("rotation"), notes)?;
            let rotation = rotation.rotation_matrix();
            Rotation3::from_matrix_unchecked(rotation)
        }
        None => Rotation3::identity(),
    };
    Ok(multibody::Mount { position_m, rotation })
}

fn link(row: &file::Link, place: &Location) -> Result<multibody::Link, Error> {
    let angle = |name: &str, value: f64| place.key(name).within(value, DH_ANGLE_DEG);
    let length = |name: &str, value: f64| place.key(name).within(value, LENGTH_M);
    Ok(multibody::Link {
        mass_kg: place.key("mass_kg").within(row.mass_kg, MASS_KG)?,
        a_m: length("a_m", row.a_m)?,
        alpha_rad: angle("alpha_deg", row.alpha_deg)?.to_radians(),
        d_m: length("d_m", row.d_m)?,
        theta_rad: angle("theta_deg", row.theta_deg)?.to_radians(),
        inertial_frame: row.inertial_frame.map(|frame| match frame {
            file::InertialFrame::Own => multibody::InertialFrame::Own,
            file::InertialFrame::Previous => multibody::InertialFrame::Previous,
        }),
        center_of_mass_m: row
            .center_of_mass_m
            .map(|center| vector(center, &place.key("center_of_mass_m")))
            .transpose()?,
        inertia_kg_m2: row
            .inertia_kg_m2
            .map(|inertia| matrix(&inertia, &place.key("inertia_kg_m2")))
            .transpose()?,
    })
}

fn payload(payload: &file::Payload, place: &Location) -> Result<multibody::Payload, Error> {
    Ok(multibody::Payload {
        mass_kg: place.key("mass_kg").within(payload.mass_kg, BODY_MASS_KG)?,
        inertia_kg_m2: payload
            .inertia_kg_m2
            .map(|inertia| matrix(&inertia, &place.key("inertia_kg_m2")))
            .transpose()?,
    })
}

fn vector(values: [f64; 3], place: &Location) -> Result<Vector3<f64>, Error> {
    place.all_within(values, LENGTH_M).map(Vector3::from)
}

fn matrix(rows: &[[f64; 3]; 3], place: &Location) -> Result<Matrix3<f64>, Error> {
    for (index, row) in rows.iter().enumerate() {
        place.index(index).all_within(*row, INERTIA_KG_M2)?;
    }
    Ok(Matrix3::from_fn(|row, column| rows[row][column]))
}
