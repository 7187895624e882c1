//! Robots as URDF: trees that mostly make sense, with numbers and names that do not.

use std::fmt::Write;

use arbitrary::{Result, Unstructured};
use righting_scenario::file::SystemOptions;
use righting_scenario::{SystemFile, import_urdf};

use crate::hostile;
use crate::json::change_bytes;
use crate::refusal::{same_twice, well_said};
use crate::target::Outcome;
use crate::workspace::Workspace;

const JOINT_TYPES: [&str; 7] =
    ["revolute", "continuous", "fixed", "prismatic", "floating", "planar", "hinge"];
const NUMBERS: [&str; 12] =
    ["0", "1", "-1", "0.1", "1e308", "-1e-308", "inf", "NaN", "", "1,5", "0x10", "1 2"];

fn number(u: &mut Unstructured<'_>) -> Result<String> {
    match u.int_in_range(0..=399)? {
        0 => Ok((*u.choose(&NUMBERS)?).to_owned()),
        1 => Ok(hostile::number(u)?.to_string()),
        _ => Ok((f64::from(u.arbitrary::<u8>()?) / 64.0 + 0.01).to_string()),
    }
}

fn signed(u: &mut Unstructured<'_>) -> Result<String> {
    let number = number(u)?;
    Ok(if u.arbitrary()? { format!("-{number}") } else { number })
}

fn vector(u: &mut Unstructured<'_>) -> Result<String> {
    let [x, y, z] = [signed(u)?, signed(u)?, signed(u)?];
    Ok(match u.int_in_range(0..=199)? {
        0 => format!("{x} {y}"),
        1 => format!("{x} {y} {z} {x}"),
        _ => format!("{x} {y} {z}"),
    })
}

/// A name of a link or joint, seldom another than the one meant.
fn name(u: &mut Unstructured<'_>, prefix: &str, number: usize) -> Result<String> {
    Ok(match u.int_in_range(0..=399)? {
        0 => hostile::text(u)?.replace(['<', '&', '"'], "_"),
        1 => format!("{prefix}{}", number + 1),
        _ => format!("{prefix}{number}"),
    })
}

fn origin(u: &mut Unstructured<'_>, xml: &mut String) -> Result<()> {
    if u.ratio(2, 3)? {
        let (xyz, rpy) = (vector(u)?, vector(u)?);
        let _ = write!(xml, r#"<origin xyz="{xyz}" rpy="{rpy}"/>"#);
    }
    Ok(())
}

fn link(u: &mut Unstructured<'_>, number_of: usize, xml: &mut String) -> Result<()> {
    let name = name(u, "l", number_of)?;
    let _ = write!(xml, r#"<link name="{name}">"#);
    if u.ratio(9, 10)? {
        xml.push_str("<inertial>");
        origin(u, xml)?;
        let mass = number(u)?;
        let _ = write!(xml, r#"<mass value="{mass}"/>"#);
        let moment = number(u)?;
        let product = if u.ratio(1, 8)? { signed(u)? } else { "0".to_owned() };
        let _ = write!(
            xml,
            r#"<inertia ixx="{moment}" iyy="{moment}" izz="{moment}" ixy="{product}" ixz="0" iyz="0"/></inertial>"#
        );
    }
    if u.ratio(1, 3)? {
        xml.push_str("<collision>");
        origin(u, xml)?;
        let (a, b) = (number(u)?, number(u)?);
        let shape = match u.int_in_range(0..=3)? {
            0 => format!(r#"<sphere radius="{a}"/>"#),
            1 => format!(r#"<cylinder radius="{a}" length="{b}"/>"#),
            2 => format!(r#"<box size="{a} {b} {a}"/>"#),
            _ => r#"<mesh filename="package://none/none.stl"/>"#.to_owned(),
        };
        let _ = write!(xml, "<geometry>{shape}</geometry></collision>");
    }
    xml.push_str("</link>");
    Ok(())
}

fn joint(u: &mut Unstructured<'_>, child: usize, xml: &mut String) -> Result<()> {
    // Most joints hang on the link before: chains, with a branch here and there.
    let parent = match u.ratio(4, 5)? {
        true => child - 1,
        false => u.int_in_range(0..=child - 1)?,
    };
    let kind = match u.ratio(15, 16)? {
        true => "revolute",
        false => *u.choose(&JOINT_TYPES)?,
    };
    let [joint, parent, child] =
        [name(u, "j", child)?, name(u, "l", parent)?, name(u, "l", child)?];
    let _ = write!(
        xml,
        r#"<joint name="{joint}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>"#
    );
    origin(u, xml)?;
    if u.ratio(7, 8)? {
        let axis = vector(u)?;
        let _ = write!(xml, r#"<axis xyz="{axis}"/>"#);
    }
    if u.ratio(15, 16)? {
        let [lower, upper, velocity, effort] = [number(u)?, number(u)?, number(u)?, number(u)?];
        let _ = write!(
            xml,
            r#"<limit lower="-{lower}" upper="{upper}" velocity="{velocity}" effort="{effort}"/>"#
        );
    }
    if u.ratio(1, 12)? {
        let _ = write!(xml, r#"<mimic joint="j1" multiplier="{}"/>"#, signed(u)?);
    }
    xml.push_str("</joint>");
    Ok(())
}

fn urdf(u: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    let mut xml = r#"<robot name="r">"#.to_owned();
    let links = u.int_in_range(1..=13)?;
    for number in 0..links {
        link(u, number, &mut xml)?;
    }
    for child in 1..links {
        joint(u, child, &mut xml)?;
    }
    xml.push_str("</robot>");
    let mut bytes = xml.into_bytes();
    if u.ratio(1, 8)? {
        change_bytes(u, &mut bytes)?;
    }
    Ok(bytes)
}

/// Imports a robot with any of its links as the base; what is accepted is a system file that is accepted.
pub(crate) fn check(
    u: &mut Unstructured<'_>,
    workspace: &Workspace,
) -> std::result::Result<Outcome, String> {
    let shown = |error: arbitrary::Error| error.to_string();
    let base = u.ratio(1, 3).and_then(|any| match any {
        true => Ok(Some(format!("l{}", u.int_in_range(0..=12)?))),
        false => Ok(Some("l0".to_owned())),
    });
    let options = SystemOptions {
        base: base.map_err(shown)?,
        rate_max_deg_s: Some(10.0),
        acceleration_max_deg_s2: Some(10.0),
        point_masses: u.arbitrary().map_err(shown)?,
        project_inertias: u.arbitrary().map_err(shown)?,
        ..SystemOptions::default()
    };
    let file = workspace.write("robot.urdf", &urdf(u).map_err(shown)?);
    let read = || import_urdf(&file, &options).map_err(|error| error.to_string());
    match same_twice(read(), read())? {
        Err(message) => {
            // What is wrong with the options is said of them.
            well_said(
                &message,
                if message.starts_with('/') { file.display().to_string() } else { String::new() },
            )?;
            Ok(Outcome::Refused)
        }
        Ok(system) => {
            let printed =
                serde_json::to_string(&system.resolved).map_err(|error| error.to_string())?;
            match SystemFile::parse(&printed, &file) {
                Ok(again) if again.resolved == system.resolved => Ok(Outcome::Accepted),
                Ok(_) => Err(format!("an imported system is read as another: {printed}")),
                Err(message) => Err(format!("an imported system is refused: {message}: {printed}")),
            }
        }
    }
}
