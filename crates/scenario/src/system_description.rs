//! A system with everything the planner needs to know about it.

use std::path::Path;

use nalgebra::{Matrix3, Rotation3, Vector3};
use righting_multibody as multibody;
use righting_multibody::{ModelError, Part, Quaternion, System};

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Document, FileKind, Location, Number};
use crate::system_or_scenario::SystemOrScenario;

/// The most joints an arm may have.
pub const MAX_JOINTS: usize = 32;

const MASS_KG: Bounds = Bounds::Between(0.0, 1e9);
const BODY_MASS_KG: Bounds = Bounds::Above(0.0, 1e9);
const LENGTH_M: Bounds = Bounds::Between(-1e4, 1e4);
const SIZE_M: Bounds = Bounds::Above(0.0, 1e4);
const RADIUS_M: Bounds = Bounds::Between(0.0, 1e4);
const INERTIA_KG_M2: Bounds = Bounds::Between(-1e15, 1e15);
const DH_ANGLE_DEG: Bounds = Bounds::Between(-360.0, 360.0);
const JOINT_ANGLE_DEG: Bounds = Bounds::Between(-36_000.0, 36_000.0);
const RATE_DEG_S: Bounds = Bounds::Above(0.0, 36_000.0);
const ACCELERATION_DEG_S2: Bounds = Bounds::Above(0.0, 360_000.0);

/// A free-floating base with an arm: masses and geometry, joint limits and keep-out sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemDescription {
    /// Name of the system.
    pub name: String,
    /// Masses and geometry.
    pub model: System,
    /// Radius of the sphere about the base's center of mass that links keep out of, m.
    pub keep_out_radius_m: f64,
    /// Limits, one a joint.
    pub joint_limits: Vec<JointLimits>,
    /// Whether a link is part of the mount and so may be inside the keep-out sphere; one a link.
    pub body_exempt: Vec<bool>,
}

/// What a joint can do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits {
    /// Smallest angle, rad; −∞ if there is none.
    pub angle_min_rad: f64,
    /// Largest angle, rad; +∞ if there is none.
    pub angle_max_rad: f64,
    /// Largest rate in magnitude, rad/s.
    pub rate_max_rad_s: f64,
    /// Largest acceleration in magnitude, rad/s².
    pub acceleration_max_rad_s2: f64,
}

impl SystemDescription {
    /// Reads and checks a system file.
    ///
    /// # Errors
    /// Those of reading, and [`Error::Field`] for a field that is wrong.
    pub fn read(file: &Path) -> Result<Self, Error> {
        Self::from_file(&read_system(file)?, &Location::root(file))
    }

    /// Number of joints j, which is also the number of links.
    pub fn joint_count(&self) -> usize {
        self.joint_limits.len()
    }

    /// Checks a system that was read from `place`.
    pub(crate) fn from_file(system: &file::System, place: &Location) -> Result<Self, Error> {
        if system.name.trim().is_empty() {
            return Err(place.key("name").refuse("\"\"", "a name"));
        }
        let (base, keep_out_radius_m) = base(&system.base, &place.key("base"))?;
        let mount = mount(&system.mount, &place.key("mount"))?;
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
        for (index, row) in system.links.iter().enumerate() {
            let place = links_place.index(index);
            links.push(link(row, &place)?);
            joint_limits.push(limits(row, &place)?);
        }
        let payload = match &system.payload {
            Some(payload) => Some(self::payload(payload, &place.key("payload"))?),
            None => None,
        };
        let model = System::new(base, mount, convention, links, payload)
            .map_err(|error| refuse_model(error, place))?;
        Ok(Self {
            name: system.name.clone(),
            model,
            keep_out_radius_m,
            joint_limits,
            body_exempt: system.links.iter().map(|link| link.body_exempt).collect(),
        })
    }
}

/// The system of a system file or of a scenario file.
///
/// # Errors
/// As reading either.
pub fn read_system_or_scenario(file: &Path) -> Result<SystemDescription, Error> {
    Ok(SystemOrScenario::read(file)?.system().clone())
}

/// Reads a system file without checking its values.
pub(crate) fn read_system(file: &Path) -> Result<file::System, Error> {
    Document::read(file, FileKind::System)?.decode()
}

/// A unit quaternion w, x, y, z, if it is one to within a millionth.
pub(crate) fn unit_quaternion(wxyz: [f64; 4], place: &Location) -> Result<Quaternion<f64>, Error> {
    place.all_within(wxyz, Bounds::Between(-2.0, 2.0))?;
    let [w, x, y, z] = wxyz;
    let quaternion = Quaternion::from_array(wxyz);
    let norm = quaternion.norm_squared().sqrt();
    if (norm - 1.0).abs() > 1e-6 {
        let allowed = format!("a unit quaternion w, x, y, z (this one's norm is {norm})");
        return Err(place.refuse(format!("[{w}, {x}, {y}, {z}]"), allowed));
    }
    Ok(quaternion.normalized())
}

fn base(base: &file::Base, place: &Location) -> Result<(multibody::Base, f64), Error> {
    let mass_kg = place.key("mass_kg").within(base.mass_kg, BODY_MASS_KG)?;
    let cube_place = place.key("cube_side_m");
    let radius_place = place.key("keep_out_radius_m");
    match (base.cube_side_m, &base.inertia_kg_m2, base.keep_out_radius_m) {
        (Some(_), Some(_), _) => {
            let place = place.key("inertia_kg_m2");
            Err(place.refuse("both cube_side_m and inertia_kg_m2", "one of them"))
        }
        (Some(side_m), None, radius_m) => {
            let side_m = cube_place.within(side_m, SIZE_M)?;
            let radius_m = match radius_m {
                Some(radius_m) => radius_place.within(radius_m, RADIUS_M)?,
                None => side_m * 3.0_f64.sqrt() / 2.0,
            };
            let body = multibody::Base::uniform_cube(mass_kg, side_m)
                .map_err(|_| cube_place.refuse(Number(side_m), SIZE_M))?;
            Ok((body, radius_m))
        }
        (None, Some(inertia), Some(radius_m)) => {
            let inertia_kg_m2 = matrix(inertia, &place.key("inertia_kg_m2"))?;
            let radius_m = radius_place.within(radius_m, RADIUS_M)?;
            Ok((multibody::Base { mass_kg, inertia_kg_m2 }, radius_m))
        }
        (None, Some(_), None) => Err(radius_place
            .missing("the radius of the keep-out sphere, which goes with inertia_kg_m2")),
        (None, None, _) => {
            Err(cube_place.missing("the side of a cube, or inertia_kg_m2 with keep_out_radius_m"))
        }
    }
}

fn mount(mount: &file::Mount, place: &Location) -> Result<multibody::Mount, Error> {
    let position_m = vector(mount.position_m, &place.key("position_m"))?;
    let rotation = match mount.rotation {
        Some(wxyz) => {
            let rotation = unit_quaternion(wxyz, &place.key("rotation"))?.rotation_matrix();
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

fn limits(row: &file::Link, place: &Location) -> Result<JointLimits, Error> {
    let angle = |name: &str, value: Option<f64>, none: f64| match value {
        Some(value) => place.key(name).within(value, JOINT_ANGLE_DEG),
        None => Ok(none),
    };
    let min_deg = angle("angle_min_deg", row.angle_min_deg, f64::NEG_INFINITY)?;
    let max_deg = angle("angle_max_deg", row.angle_max_deg, f64::INFINITY)?;
    if min_deg >= max_deg {
        let allowed = format!("less than angle_max_deg, {}", Number(max_deg));
        return Err(place.key("angle_min_deg").refuse(Number(min_deg), allowed));
    }
    let rate_place = place.key("rate_max_deg_s");
    let acceleration_place = place.key("acceleration_max_deg_s2");
    let rate_max_deg_s = rate_place.within(row.rate_max_deg_s, RATE_DEG_S)?;
    let acceleration_max_deg_s2 =
        acceleration_place.within(row.acceleration_max_deg_s2, ACCELERATION_DEG_S2)?;
    Ok(JointLimits {
        angle_min_rad: min_deg.to_radians(),
        angle_max_rad: max_deg.to_radians(),
        rate_max_rad_s: rate_max_deg_s.to_radians(),
        acceleration_max_rad_s2: acceleration_max_deg_s2.to_radians(),
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

/// Says where in the file a model's fault lies.
fn refuse_model(error: ModelError, place: &Location) -> Error {
    let at = |part: Part| match part {
        Part::Base => place.key("base"),
        Part::Mount => place.key("mount"),
        Part::Link(index) => place.key("links").index(index),
        Part::Payload => place.key("payload"),
    };
    match error {
        ModelError::NotSymmetric { part, row, column, upper, lower } => {
            let entry = at(part).key("inertia_kg_m2").index(row).index(column);
            let allowed = format!(
                "{}, the entry [{column}][{row}]: an inertia matrix is symmetric",
                Number(lower)
            );
            entry.refuse(Number(upper), allowed)
        }
        ModelError::NotPositive { part, smallest_kg_m2, zero_allowed } => {
            let least = if zero_allowed { "zero or more" } else { "more than zero" };
            let value = format!("a smallest principal moment of {}", Number(smallest_kg_m2));
            at(part).key("inertia_kg_m2").refuse(value, least)
        }
        ModelError::TriangleInequality { part, largest_kg_m2, others_kg_m2 } => {
            let value = format!("a largest principal moment of {}", Number(largest_kg_m2));
            let allowed = format!("at most the sum of the other two, {}", Number(others_kg_m2));
            at(part).key("inertia_kg_m2").refuse(value, allowed)
        }
        ModelError::InertiaWithoutMass { part } => {
            at(part).key("inertia_kg_m2").refuse("an inertia", "none for a link without mass")
        }
        ModelError::NotFinite { part, quantity, value } => {
            at(part).key(quantity).refuse(value, "a finite number")
        }
        ModelError::NegativeMass { part, mass_kg } => {
            at(part).key("mass_kg").refuse(Number(mass_kg), MASS_KG)
        }
        ModelError::Overflow { part } => {
            at(part).refuse("a mass or length this large", "numbers whose products are finite")
        }
        ModelError::EmptyChain => place.key("links").refuse("[]", "at least one link"),
        ModelError::MasslessBase => place.key("base").key("mass_kg").refuse(0, "more than 0"),
        ModelError::CubeSide { side_m } => {
            place.key("base").key("cube_side_m").refuse(Number(side_m), SIZE_M)
        }
        ModelError::NotARotation { .. } => {
            place.key("mount").key("rotation").refuse("a reflection", "a unit quaternion")
        }
    }
}
