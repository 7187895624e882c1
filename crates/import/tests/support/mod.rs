//! Random robots, and an account of where their links are that shares nothing with the crate.

// Each test uses its own part.
#![allow(dead_code)]

use std::collections::BTreeMap;
use std::fmt::Write;

use nalgebra::{Matrix3, Matrix4, Rotation3, Unit, Vector3};
use proptest::prelude::*;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Turning,
    Sliding,
    Fixed,
}

#[derive(Clone, Debug)]
pub struct RandomLink {
    pub name: String,
    pub mass_kg: f64,
    pub center_m: Vector3<f64>,
    /// About the center of mass, axes of the link's frame.
    pub inertia_kg_m2: Matrix3<f64>,
    /// The same in the axes of its `<inertial>`, and roll, pitch and yaw of these.
    own_inertia: Matrix3<f64>,
    own_rpy: [f64; 3],
    pub sphere_m: Vector3<f64>,
}

#[derive(Clone, Debug)]
pub struct RandomJoint {
    pub name: String,
    pub kind: Kind,
    pub parent: usize,
    pub child: usize,
    position_m: Vector3<f64>,
    rpy: [f64; 3],
    axis: Vector3<f64>,
}

/// A tree whose root is link 0; joint k moves link k + 1.
#[derive(Clone, Debug)]
pub struct RandomRobot {
    pub links: Vec<RandomLink>,
    pub joints: Vec<RandomJoint>,
    /// Coordinates of joints that shall be held.
    pub held: BTreeMap<String, f64>,
    /// Whether the file has its elements the other way around.
    pub is_reversed: bool,
}

type Numbers = Vec<f64>;

pub fn random_robot() -> impl Strategy<Value = RandomRobot> {
    let link = prop::collection::vec(-1.0..1.0_f64, 24);
    let choice = (any::<prop::sample::Index>(), 0..5_usize, 0..4_usize);
    (1..9_usize, any::<bool>())
        .prop_flat_map(move |(count, is_reversed)| {
            let links = prop::collection::vec((link.clone(), choice.clone()), count);
            (links, Just(is_reversed))
        })
        .prop_map(|(parts, is_reversed)| {
            let links = parts.iter().enumerate().map(|(k, (n, _))| random_link(k, n)).collect();
            let mut joints: Vec<RandomJoint> = Vec::new();
            let mut held = BTreeMap::new();
            for (child, (numbers, (parent, kind, hold))) in parts.iter().enumerate().skip(1) {
                let joint = random_joint(child, parent.index(child), *kind, numbers);
                if joint.kind != Kind::Fixed && *hold == 0 {
                    held.insert(joint.name.clone(), numbers[23]);
                }
                joints.push(joint);
            }
            RandomRobot { links, joints, held, is_reversed }
        })
}

fn random_link(index: usize, n: &Numbers) -> RandomLink {
    // Points that are not in a line have an inertia that a body can have.
    let points: Vec<Vector3<f64>> =
        (0..3).map(|k| Vector3::from_row_slice(&n[3 * k..3 * k + 3])).collect();
    let own_inertia = points
        .iter()
        .map(|p| (Matrix3::identity() * p.norm_squared() - p * p.transpose()) * 0.1)
        .sum::<Matrix3<f64>>()
        + Matrix3::identity() * 0.01;
    let own_rpy = [n[9] * 3.0, n[10] * 3.0, n[11] * 3.0];
    let turn = Rotation3::from_euler_angles(own_rpy[0], own_rpy[1], own_rpy[2]).into_inner();
    RandomLink {
        name: format!("l{index}"),
        mass_kg: 1.5 + n[12],
        center_m: Vector3::new(n[13], n[14], n[15]) * 0.3,
        inertia_kg_m2: turn * own_inertia * turn.transpose(),
        own_inertia,
        own_rpy,
        sphere_m: Vector3::new(n[0], n[4], n[8]),
    }
}

fn random_joint(child: usize, parent: usize, kind: usize, n: &Numbers) -> RandomJoint {
    RandomJoint {
        name: format!("j{child}"),
        kind: [Kind::Turning, Kind::Turning, Kind::Turning, Kind::Sliding, Kind::Fixed][kind],
        parent,
        child,
        position_m: Vector3::new(n[16], n[17], n[18]),
        rpy: [n[19] * 3.0, n[20] * 3.0, n[21] * 3.0],
        axis: Vector3::new(n[1], n[5], n[22] + 2.0),
    }
}

impl RandomRobot {
    pub fn urdf(&self) -> String {
        let mut elements: Vec<String> = Vec::new();
        for link in &self.links {
            let i = &link.own_inertia;
            let ([x, y, z], [a, b, c]) = (three(&link.center_m), link.own_rpy);
            let [u, v, w] = three(&link.sphere_m);
            elements.push(format!(
                "<link name=\"{}\"><inertial><origin xyz=\"{x} {y} {z}\" rpy=\"{a} {b} {c}\"/>\
                 <mass value=\"{}\"/><inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" \
                 izz=\"{}\"/></inertial><collision><origin xyz=\"{u} {v} {w}\"/><geometry>\
                 <sphere radius=\"0.1\"/></geometry></collision></link>",
                link.name, link.mass_kg, i.m11, i.m12, i.m13, i.m22, i.m23, i.m33
            ));
        }
        for joint in &self.joints {
            let kind = match joint.kind {
                Kind::Turning => "revolute",
                Kind::Sliding => "prismatic",
                Kind::Fixed => "fixed",
            };
            let ([x, y, z], [a, b, c]) = (three(&joint.position_m), joint.rpy);
            let [u, v, w] = three(&joint.axis);
            elements.push(format!(
                "<joint name=\"{}\" type=\"{kind}\"><parent link=\"{}\"/><child link=\"{}\"/>\
                 <origin xyz=\"{x} {y} {z}\" rpy=\"{a} {b} {c}\"/><axis xyz=\"{u} {v} {w}\"/>\
                 <limit lower=\"-3\" upper=\"2\" velocity=\"1\" effort=\"10\"/></joint>",
                joint.name, self.links[joint.parent].name, self.links[joint.child].name
            ));
        }
        if self.is_reversed {
            elements.reverse();
        }
        let mut text = String::from("<?xml version=\"1.0\"?>\n<robot name=\"random\">\n");
        for element in elements {
            writeln!(text, "  {element}").unwrap();
        }
        text + "</robot>\n"
    }

    /// Coordinates of every joint that moves, spread by `seed`.
    pub fn coordinates(&self, seed: f64) -> BTreeMap<String, f64> {
        let movable = self.joints.iter().filter(|joint| joint.kind != Kind::Fixed);
        movable
            .enumerate()
            .map(|(k, joint)| (joint.name.clone(), (seed * (k + 1) as f64 * 2.7).sin()))
            .collect()
    }

    /// The frame of every link in that of link 0.
    pub fn link_frames(&self, coordinates: &BTreeMap<String, f64>) -> Vec<Matrix4<f64>> {
        let mut frames = vec![Matrix4::identity()];
        for joint in &self.joints {
            let [a, b, c] = joint.rpy;
            let [about_x, about_y, about_z] =
                [(a, Vector3::x()), (b, Vector3::y()), (c, Vector3::z())]
                    .map(|(angle, axis)| turn(&axis, angle));
            let origin = homogeneous(&(about_z * about_y * about_x), &joint.position_m);
            let at = coordinates.get(&joint.name).copied().unwrap_or(0.0);
            frames.push(frames[joint.parent] * origin * motion(joint.kind, &joint.axis, at));
        }
        frames
    }

    /// Whether `link` is `other` or hangs on it.
    pub fn hangs_on(&self, link: usize, other: usize) -> bool {
        link == other || link > 0 && self.hangs_on(self.joints[link - 1].parent, other)
    }
}

fn three(vector: &Vector3<f64>) -> [f64; 3] {
    [vector.x, vector.y, vector.z]
}

/// Rodrigues' formula.
fn turn(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    let cross = Unit::new_normalize(*axis).cross_matrix();
    Matrix3::identity() + cross * angle.sin() + cross * cross * (1.0 - angle.cos())
}

pub fn motion(kind: Kind, axis: &Vector3<f64>, at: f64) -> Matrix4<f64> {
    match kind {
        Kind::Turning => homogeneous(&turn(axis, at), &Vector3::zeros()),
        Kind::Sliding => homogeneous(&Matrix3::identity(), &(axis.normalize() * at)),
        Kind::Fixed => Matrix4::identity(),
    }
}

pub fn homogeneous(rotation: &Matrix3<f64>, position: &Vector3<f64>) -> Matrix4<f64> {
    let mut frame = Matrix4::identity();
    frame.fixed_view_mut::<3, 3>(0, 0).copy_from(rotation);
    frame.fixed_view_mut::<3, 1>(0, 3).copy_from(position);
    frame
}

/// ∫ (x, 1)(x, 1)ᵀ dm of a rigid body.
pub fn moments(
    mass_kg: f64,
    center_m: &Vector3<f64>,
    inertia_kg_m2: &Matrix3<f64>,
) -> Matrix4<f64> {
    let second = Matrix3::identity() * (inertia_kg_m2.trace() / 2.0) - inertia_kg_m2
        + center_m * center_m.transpose() * mass_kg;
    let mut moments = Matrix4::zeros();
    moments.fixed_view_mut::<3, 3>(0, 0).copy_from(&second);
    moments.fixed_view_mut::<3, 1>(0, 3).copy_from(&(center_m * mass_kg));
    moments.fixed_view_mut::<1, 3>(3, 0).copy_from(&(center_m * mass_kg).transpose());
    moments[(3, 3)] = mass_kg;
    moments
}
