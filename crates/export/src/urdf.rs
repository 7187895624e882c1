//! The whole system as URDF: the base as root link, floating when the file is loaded.

use righting_multibody::{JointKind, Placement, RigidBody};
use righting_scenario::{JointLimits, SystemDescription};

use crate::arm::{Arm, BASE, Hinge, TIP};
use crate::xml::Element;

/// What stands for an angle or an effort without a limit: URDF has no infinity, and a joint that is
/// limited in rate must have an effort.
const UNLIMITED: f64 = 1e9;

/// The system as a URDF robot.
///
/// The root link `base` is the base; whoever loads the file lets it float (URDF itself has no free
/// root). Link i is the body that joint i moves, in the frame whose z axis is the axis of joint i; bodies
/// and joints with names of their own keep them. A payload is part of the last link, a body on a fixed joint
/// of the one that carries it, and what moves with no joint of the base. Joint angles are the plan's. Locked joints are `fixed`, joints without limits of angle `continuous`. A limit
/// that there is not stands as 1e9, that of the effort among them. Links without mass have no
/// `inertial`. The link `tip` is the last frame of an arm in rows.
pub fn urdf(system: &SystemDescription) -> String {
    let arm = Arm::new(system);
    let mut robot = Element::new("robot")
        .with("name", &system.name)
        .noting("SI units and radians. The root link floats freely; there is no gravity.")
        .holding(link(BASE, &arm.base));
    for hinge in &arm.hinges {
        let parent = hinge.parent.map_or(BASE, |parent| &arm.hinges[parent].link);
        robot.push(link(&hinge.link, &hinge.body));
        robot.push(joint(hinge, parent));
    }
    if let (Some(tip), Some(last)) = (&arm.tip, arm.hinges.last()) {
        robot.push(Element::new("link").with("name", TIP));
        robot.push(connection("tip_joint", "fixed", &last.link, TIP, tip));
    }
    robot.to_string()
}

fn link(name: &str, body: &RigidBody) -> Element {
    let link = Element::new("link").with("name", name);
    if body.mass_kg == 0.0 {
        return link;
    }
    let moment = |row, column| body.inertia_kg_m2[(row, column)];
    link.holding(
        Element::new("inertial")
            .holding(
                Element::new("origin")
                    .with_numbers("xyz", body.center_of_mass_m.iter().copied())
                    .with_numbers("rpy", [0.0; 3]),
            )
            .holding(Element::new("mass").with_number("value", body.mass_kg))
            .holding(
                Element::new("inertia")
                    .with_number("ixx", moment(0, 0))
                    .with_number("ixy", moment(0, 1))
                    .with_number("ixz", moment(0, 2))
                    .with_number("iyy", moment(1, 1))
                    .with_number("iyz", moment(1, 2))
                    .with_number("izz", moment(2, 2)),
            ),
    )
}

fn joint(hinge: &Hinge, parent: &str) -> Element {
    let JointLimits { angle_min_rad, angle_max_rad, rate_max_rad_s, torque_max_n_m, .. } =
        hinge.limits;
    let is_limited = angle_min_rad.is_finite() || angle_max_rad.is_finite();
    let kind = match (hinge.held_at, hinge.kind, is_limited) {
        (Some(_), _, _) => "fixed",
        (None, JointKind::Prismatic, _) => "prismatic",
        (None, JointKind::Revolute, true) => "revolute",
        (None, JointKind::Revolute, false) => "continuous",
    };
    let joint = connection(&hinge.joint, kind, parent, &hinge.link, &hinge.placed());
    if hinge.held_at.is_some() {
        return joint;
    }
    let mut limit = Element::new("limit");
    if is_limited {
        limit = limit
            .with_number("lower", angle_min_rad.max(-UNLIMITED))
            .with_number("upper", angle_max_rad.min(UNLIMITED));
    }
    limit = limit
        .with_number("velocity", rate_max_rad_s)
        .with_number("effort", torque_max_n_m.min(UNLIMITED));
    joint.holding(Element::new("axis").with_numbers("xyz", [0.0, 0.0, 1.0])).holding(limit)
}

fn connection(name: &str, kind: &str, parent: &str, child: &str, place: &Placement) -> Element {
    let origin = Element::new("origin")
        .with_numbers("xyz", place.position_m.iter().copied())
        .with_numbers("rpy", place.roll_pitch_yaw_rad());
    Element::new("joint")
        .with("name", name)
        .with("type", kind)
        .holding(Element::new("parent").with("link", parent))
        .holding(Element::new("child").with("link", child))
        .holding(origin)
}
