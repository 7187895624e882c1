//! Rigid bodies in a tree, read from URDF or MJCF and moved as those formats say.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use roxmltree::{Document, Node};

type Vector = Vector3<f64>;
type Rotation = Rotation3<f64>;

/// All bodies, parents before their children.
pub struct Tree {
    bodies: Vec<Body>,
}

struct Body {
    parent: Option<usize>,
    position: Vector,
    rotation: Rotation,
    /// In the order in which they move the body.
    joints: Vec<Joint>,
    mass: f64,
    center: Vector,
    inertia: Matrix3<f64>,
}

struct Joint {
    /// In the body with the joint at zero.
    axis: Vector,
    /// A point on the axis, in the same frame.
    point: Vector,
    index: usize,
    slides: bool,
}

/// Sums over all bodies; the base's frame is the frame of reference.
pub struct Sums {
    pub mass_kg: f64,
    pub center_m: Vector,
    /// About the center of mass.
    pub momentum: Vector,
    pub energy_j: f64,
}

/// Place and motion of a body.
#[derive(Clone)]
struct Motion {
    position: Vector,
    rotation: Rotation,
    velocity: Vector,
    rate: Vector,
}

impl Tree {
    pub fn of_urdf(text: &str) -> Self {
        let document = Document::parse(text).expect("well formed");
        let robot = document.root_element();
        let all = |tag: &'static str| robot.children().filter(move |node| node.has_tag_name(tag));
        let links: Vec<_> = all("link").collect();
        let index = |name: &str| {
            links.iter().position(|link| link.attribute("name") == Some(name)).expect("a link")
        };
        let mut bodies: Vec<Body> = links.iter().map(|link| urdf_link(*link)).collect();
        for joint in all("joint") {
            let end = |tag| index(child(joint, tag).attribute("link").expect("a name"));
            let body = &mut bodies[end("child")];
            let origin = child(joint, "origin");
            body.parent = Some(end("parent"));
            body.position = vector(origin, "xyz");
            let rpy = vector(origin, "rpy");
            body.rotation = Rotation::from_euler_angles(rpy.x, rpy.y, rpy.z);
            if joint.attribute("type") != Some("fixed") {
                body.joints.push(Joint {
                    axis: vector(child(joint, "axis"), "xyz"),
                    point: Vector::zeros(),
                    index: joint_index(joint),
                    slides: joint.attribute("type") == Some("prismatic"),
                });
            }
        }
        Self { bodies }
    }

    pub fn of_mjcf(text: &str) -> Self {
        let document = Document::parse(text).expect("well formed");
        let world = child(document.root_element(), "worldbody");
        let mut bodies = Vec::new();
        mjcf_body(child(world, "body"), None, &mut bodies);
        Self { bodies }
    }

    /// Sums at joint angles and rates, the base moving.
    pub fn at(&self, q: &[f64], qdot: &[f64], velocity: &Vector, rate: &Vector) -> Sums {
        let mut motions: Vec<Motion> = Vec::new();
        let base = Motion {
            position: Vector::zeros(),
            rotation: Rotation::identity(),
            velocity: *velocity,
            rate: *rate,
        };
        for body in &self.bodies {
            let motion = match body.parent {
                Some(parent) => body.moved(&motions[parent], q, qdot),
                None => base.clone(),
            };
            motions.push(motion);
        }
        let parts: Vec<(f64, Vector, Vector, Matrix3<f64>, Vector)> = self
            .bodies
            .iter()
            .zip(&motions)
            .map(|(body, motion)| {
                let arm = motion.rotation * body.center;
                let turned = motion.rotation.matrix();
                let inertia = turned * body.inertia * turned.transpose();
                let velocity = motion.velocity + motion.rate.cross(&arm);
                (body.mass, motion.position + arm, velocity, inertia, motion.rate)
            })
            .collect();
        let mass_kg: f64 = parts.iter().map(|part| part.0).sum();
        let center_m = parts.iter().map(|part| part.1 * part.0).sum::<Vector>() / mass_kg;
        let momentum = parts
            .iter()
            .map(|(mass, center, velocity, inertia, rate)| {
                (center - center_m).cross(velocity) * *mass + inertia * rate
            })
            .sum();
        let energy_j = parts
            .iter()
            .map(|(mass, _, velocity, inertia, rate)| {
                0.5 * (mass * velocity.norm_squared() + rate.dot(&(inertia * rate)))
            })
            .sum();
        Sums { mass_kg, center_m, momentum, energy_j }
    }
}

impl Body {
    /// The body on its parent, moved by one joint after the other.
    fn moved(&self, parent: &Motion, q: &[f64], qdot: &[f64]) -> Motion {
        let arm = parent.rotation * self.position;
        let mut motion = Motion {
            position: parent.position + arm,
            rotation: parent.rotation * self.rotation,
            velocity: parent.velocity + parent.rate.cross(&arm),
            rate: parent.rate,
        };
        for Joint { axis, point, index: joint, slides } in &self.joints {
            let axis = motion.rotation * axis;
            if *slides {
                let travel = axis * q[*joint];
                motion.position += travel;
                motion.velocity += motion.rate.cross(&travel) + axis * qdot[*joint];
                continue;
            }
            let to_anchor = motion.rotation * point;
            let anchor = motion.position + to_anchor;
            let anchor_velocity = motion.velocity + motion.rate.cross(&to_anchor);
            let turn = Rotation::new(axis * q[*joint]);
            motion.rotation = turn * motion.rotation;
            motion.position = anchor - turn * to_anchor;
            motion.rate += axis * qdot[*joint];
            motion.velocity = anchor_velocity + motion.rate.cross(&(motion.position - anchor));
        }
        motion
    }
}

fn urdf_link(link: Node<'_, '_>) -> Body {
    let mut body = Body {
        parent: None,
        position: Vector::zeros(),
        rotation: Rotation::identity(),
        joints: Vec::new(),
        mass: 0.0,
        center: Vector::zeros(),
        inertia: Matrix3::zeros(),
    };
    if let Some(inertial) = link.children().find(|node| node.has_tag_name("inertial")) {
        let moments = child(inertial, "inertia");
        let moment = |name| numbers(moments, name)[0];
        let [xx, xy, xz] = ["ixx", "ixy", "ixz"].map(moment);
        let [yy, yz, zz] = ["iyy", "iyz", "izz"].map(moment);
        body.mass = numbers(child(inertial, "mass"), "value")[0];
        body.center = vector(child(inertial, "origin"), "xyz");
        assert_eq!(vector(child(inertial, "origin"), "rpy"), Vector::zeros());
        body.inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    }
    body
}

fn mjcf_body(node: Node<'_, '_>, parent: Option<usize>, bodies: &mut Vec<Body>) {
    let inertial = child(node, "inertial");
    let axes = quaternion(inertial);
    let principal = Matrix3::from_diagonal(&vector(inertial, "diaginertia"));
    let joints = node.children().filter(|child| child.has_tag_name("joint")).map(|joint| {
        let slides = joint.attribute("type") == Some("slide");
        assert!(slides || joint.attribute("type") == Some("hinge"));
        let [axis, point] = ["axis", "pos"].map(|name| vector(joint, name));
        Joint { axis, point, index: joint_index(joint), slides }
    });
    let is_base = parent.is_none();
    bodies.push(Body {
        parent,
        position: if is_base { Vector::zeros() } else { vector(node, "pos") },
        rotation: if is_base { Rotation::identity() } else { quaternion(node) },
        joints: joints.collect(),
        mass: numbers(inertial, "mass")[0],
        center: vector(inertial, "pos"),
        inertia: axes.matrix() * principal * axes.matrix().transpose(),
    });
    let own = bodies.len() - 1;
    for child in node.children().filter(|child| child.has_tag_name("body")) {
        mjcf_body(child, Some(own), bodies);
    }
}

fn child<'a, 'input>(node: Node<'a, 'input>, tag: &str) -> Node<'a, 'input> {
    let found = node.children().find(|child| child.has_tag_name(tag));
    found.unwrap_or_else(|| panic!("no {tag} in {}", node.tag_name().name()))
}

fn numbers(node: Node<'_, '_>, attribute: &str) -> Vec<f64> {
    let text = node.attribute(attribute).unwrap_or_else(|| panic!("no {attribute}"));
    text.split(' ').map(|cell| cell.parse().expect("a number")).collect()
}

fn vector(node: Node<'_, '_>, attribute: &str) -> Vector {
    Vector::from_iterator(numbers(node, attribute))
}

fn quaternion(node: Node<'_, '_>) -> Rotation {
    let [w, x, y, z] = numbers(node, "quat")[..] else { panic!("four numbers") };
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix()
}

/// Of joint_1 zero, and so on.
fn joint_index(joint: Node<'_, '_>) -> usize {
    let name = joint.attribute("name").expect("a name");
    name.strip_prefix("joint_")
        .and_then(|number| number.parse().ok())
        .map_or_else(|| panic!("{name}"), |number: usize| number - 1)
}
