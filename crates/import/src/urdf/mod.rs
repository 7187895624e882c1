//! URDF, the Unified Robot Description Format of ROS, as its reader `urdfdom` understands it.

mod geometry;
mod inertial;
mod joint;
mod link;

use std::collections::HashMap;
use std::path::PathBuf;

use righting_multibody::Placement;

use crate::document::{Element, Source};
use crate::error::{ImportError, quoted};
use crate::notes::Notes;
use crate::robot::{Joint, Link, Mimic, Robot};
use crate::{tree, units};

/// The most links that are read; public robots have up to two hundred.
const MAX_LINKS: usize = 10_000;

/// Longer than any robot, m.
const FARTHEST_M: f64 = 1000.0;

/// How a file is read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The folder from which files of meshes are looked for; without it no mesh is read.
    pub folder: Option<PathBuf>,
    /// A link with a mass and no inertia, or one of zero, is a point mass; otherwise it is refused.
    pub point_masses: bool,
    /// An inertia that no rigid body has is replaced by the nearest one that a body has; otherwise it is
    /// refused.
    pub project_inertias: bool,
}

impl Robot {
    /// Reads a robot from the text of a URDF file, in which macros are expanded.
    ///
    /// A capsule stands for each mesh that can be read. Elements that URDF does not know are passed over, as its other
    /// readers do.
    ///
    /// # Errors
    /// [`ImportError::NotXml`]; [`ImportError::Refused`] with the line of what is wrong.
    pub fn from_urdf(text: &str, options: &ReadOptions) -> Result<Self, ImportError> {
        let source = Source::parse(text)?;
        let root = source.root();
        if root.tag() != "robot" {
            return Err(root.place().refuse(format!("<{}>", root.tag()), "<robot>: a URDF file"));
        }
        if let Some(call) = root.macro_call() {
            let expected =
                "no macros: expand the file first, with `xacro robot.xacro > robot.urdf`";
            return Err(call.place().refuse(format!("<xacro:{}>", call.tag()), expected));
        }
        let mut notes = Notes::default();
        let mut links = links(root, options, &mut notes)?;
        let joints = joints(root, &mut links, &mut notes)?;
        let root_link = tree::root(&links, &joints, &root.place())?;
        units::check(&links, &joints)?;
        let name = root.text("name").unwrap_or("robot").to_owned();
        Ok(Self { name, links, joints, root: root_link, notes: notes.into_lines() })
    }
}

fn links(
    robot: Element<'_>,
    options: &ReadOptions,
    notes: &mut Notes,
) -> Result<Vec<Link>, ImportError> {
    let mut links: Vec<Link> = Vec::new();
    let mut index_of: HashMap<&str, usize> = HashMap::new();
    for element in robot.children("link") {
        let name = element.required_text("name")?;
        if let Some(before) = index_of.insert(name, links.len()) {
            let found = format!("the name of the link in line {} again", links[before].place.line);
            return Err(element.place().refuse(found, "a name of its own"));
        }
        if links.len() == MAX_LINKS {
            return Err(element.place().refuse("one more link", format!("at most {MAX_LINKS}")));
        }
        links.push(link::link(element, options, notes)?);
    }
    Ok(links)
}

fn joints(
    robot: Element<'_>,
    links: &mut [Link],
    notes: &mut Notes,
) -> Result<Vec<Joint>, ImportError> {
    let index_of: HashMap<String, usize> =
        links.iter().enumerate().map(|(index, link)| (link.name.clone(), index)).collect();
    let mut joints: Vec<Joint> = Vec::new();
    let mut joint_of: HashMap<&str, usize> = HashMap::new();
    // A joint may mimic one that comes later in the file.
    let mut mimics: Vec<(usize, Element<'_>)> = Vec::new();
    // Transmissions and simulators name joints too, in elements of their own.
    for element in robot.children("joint") {
        let joint = joint::joint(element, &index_of, notes)?;
        let name = element.required_text("name")?;
        if let Some(before) = joint_of.insert(name, joints.len()) {
            let found =
                format!("the name of the joint in line {} again", joints[before].place.line);
            return Err(element.place().refuse(found, "a name of its own"));
        }
        if let Some(before) = links[joint.child].parent_joint {
            let found = format!(
                "the link {}, which joint {} has as its child already",
                quoted(&links[joint.child].name),
                quoted(&joints[before].name)
            );
            return Err(element.place().refuse(found, "a child of no other joint"));
        }
        links[joint.child].parent_joint = Some(joints.len());
        links[joint.parent].child_joints.push(joints.len());
        if let Some(mimic) = element.child("mimic")? {
            mimics.push((joints.len(), mimic));
        }
        joints.push(joint);
    }
    for (index, element) in mimics {
        let name = element.required_text("joint")?;
        let Some(&other) = joint_of.get(name) else {
            return Err(element.place_of("joint").refuse(quoted(name), "the name of a joint"));
        };
        joints[index].mimic = Some(Mimic {
            joint: other,
            multiplier: element.number("multiplier")?.unwrap_or(1.0),
            offset: element.number("offset")?.unwrap_or(0.0),
        });
    }
    Ok(joints)
}

/// An `<origin>`, or the identity where there is none.
fn origin(parent: Element<'_>) -> Result<Placement, ImportError> {
    let Some(element) = parent.child("origin")? else {
        return Ok(Placement::identity());
    };
    let position_m = element.vector("xyz")?.unwrap_or_default();
    if let Some(value) = position_m.iter().find(|value| value.abs() > FARTHEST_M) {
        let expected = format!("at most {FARTHEST_M}: URDF is in m");
        return Err(element.place_of("xyz").refuse(value, expected));
    }
    let angles_rad = element.vector("rpy")?.unwrap_or_default();
    Ok(Placement::from_roll_pitch_yaw(position_m.into(), angles_rad))
}
