//! Serial arms in rows of Denavit–Hartenberg parameters, from a system file.

use nalgebra::Rotation3;
use righting_multibody as multibody;

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Location, Number};
use crate::system_description::{
    BODY_MASS_KG, LENGTH_M, MASS_KG, MAX_JOINTS, matrix, unit_quaternion, vector,
};

const DH_ANGLE_DEG: Bounds = Bounds::Between(-360.0, 360.0);

/// The rows of a system that was read from `place`, with the default convention filled in.
pub(crate) fn rows(
    system: &mut file::System,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<multibody::Rows, Error> {
    let links_place = place.key("links");
    let Some(mount) = &system.mount else {
        return Err(place.key("mount").missing("where frame 0 of the arm sits on the base"));
    };
    let mount = self::mount(mount, &place.key("mount"), notes)?;
    let convention = match system.dh_convention.get_or_insert_default() {
        file::DhConvention::Standard => multibody::DhConvention::Standard,
        file::DhConvention::Modified => multibody::DhConvention::Modified,
    };
    let allowed = format!("an array of 1 to {MAX_JOINTS} links");
    if system.links.is_empty() {
        return Err(links_place.missing(allowed));
    }
    if system.links.len() > MAX_JOINTS {
        return Err(links_place.refuse(format!("{} links", system.links.len()), allowed));
    }
    let rows = system.links.iter().enumerate();
    let links = rows.map(|(index, row)| link(row, &links_place.index(index)));
    let links = links.collect::<Result<_, _>>()?;
    let payload_place = place.key("payload");
    let payload = system.payload.as_ref().map(|payload| self::payload(payload, &payload_place));
    Ok(multibody::Rows { mount, convention, links, payload: payload.transpose()? })
}

/// A remark on a file that looks as if its inertials were in other frames than they are taken in:
/// those of a Craig table are in the links' own frames, and nobody means to fix link 1 to the base.
pub(crate) fn doubt_about_frames(system: &file::System, links: &Location) -> Option<String> {
    let is_modified = system.dh_convention == Some(file::DhConvention::Modified);
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

fn mount(
    mount: &file::Mount,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<multibody::Mount, Error> {
    let position_m = vector(mount.position_m, &place.key("position_m"))?;
    let rotation = match mount.rotation {
        Some(wxyz) => {
            let rotation = unit_quaternion(wxyz, &place.key("rotation"), notes)?;
            Rotation3::from_matrix_unchecked(rotation.rotation_matrix())
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
