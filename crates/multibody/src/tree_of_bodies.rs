//! The tree that a list of bodies is.
//!
//! A joint's frame K gets the joint's axis as its z axis. Which way x points is free, and is chosen so that
//! the next joint's axis is turned about x from this one's, or, where the two are parallel, so that the
//! next joint lies on the x axis: constants then vanish as they do in a Denavit-Hartenberg table. Bodies
//! on fixed joints are parts of the bodies that carry them.

use crate::bodies::Placement;
use crate::coupling::Coupling;
use crate::error::{ModelError, Part};
use crate::jointed_body::Bodies;
use crate::parts::Base;
use crate::tree::{Branch, Carried, Joint, Tree, snapped};
use crate::turn::Turn;
use nalgebra::{Matrix3, Vector3};

/// Sine of an angle between axes that are parallel but for rounding.
const PARALLEL: f64 = 1e-12;

impl Bodies {
    pub fn tree(&self, base: &Base) -> Result<Tree, ModelError> {
        let mut tree = Tree::of_base(base);
        let coordinates = self.coordinates();
        let mut starts = Vec::new();
        // The frame of each body, in K of the joint that moves it.
        let mut carried: Vec<Carried> =
            vec![Carried { joint: None, placement: Placement::identity() }; self.list().len()];
        for (index, body) in self.outward() {
            let on_base = Carried { joint: None, placement: Placement::identity() };
            let parent = body.parent.map_or(on_base, |parent| carried[parent].clone());
            let in_parent = parent.placement.then(&body.placement);
            carried[index] = match body.joint.motion() {
                None => Carried { placement: in_parent, ..parent },
                Some((kind, axis)) => {
                    let to_axis = onto(&axis.normalize());
                    let rotation = (in_parent.rotation * to_axis).map(snapped);
                    starts.push(Placement { rotation, ..in_parent });
                    let coordinate = coordinates[index].unwrap_or_default();
                    let joint = Joint::new(coordinate, Part::Body(index), Turn::NONE);
                    tree.joints.push(Joint { kind, parent: parent.joint, ..joint });
                    let placement =
                        Placement { position_m: Vector3::zeros(), rotation: to_axis.transpose() };
                    Carried { joint: Some(tree.joints.len() - 1), placement }
                }
            };
            let Carried { joint, placement: Placement { position_m, rotation } } = &carried[index];
            let moments = body.body.moments().placed(rotation, position_m);
            match joint {
                Some(joint) => {
                    let whole = &mut tree.joints[*joint].body;
                    *whole = whole.joined(&moments);
                }
                None => {
                    tree.base = tree.base.joined(&moments);
                    tree.foot = tree.foot.joined(&moments);
                }
            }
        }
        place(&mut tree, &mut carried, starts);
        let body_frame = Carried { joint: None, placement: Placement::identity() };
        for (carried, body) in carried.iter().zip(self.list()) {
            let Placement { position_m, rotation } = &carried.placement;
            let center = position_m + rotation * body.body.center_of_mass_m;
            tree.centers.push((carried.joint, center));
        }
        tree.frames = std::iter::once(body_frame).chain(carried).collect();
        tree.coupled()
    }
}

/// Turns every K about its z axis to where it shall be, and says where each begins.
fn place(tree: &mut Tree, carried: &mut [Carried], mut starts: Vec<Placement>) {
    let on_base = tree.joints.iter().filter(|joint| joint.parent.is_none()).count();
    for k in 0..tree.joints.len() {
        let Placement { position_m, rotation } = starts[k];
        let parent = tree.joints[k].parent;
        let goes_on = match parent {
            Some(parent) => parent + 1 == k,
            None => on_base == 1,
        };
        let first = match (parent, goes_on) {
            // The joint before has its x axis there already.
            (Some(_), true) => Turn::NONE,
            _ => first_turn(&rotation, &Vector3::zeros()),
        };
        let [twist, last] = other_turns(&rotation, first);
        match (parent, goes_on) {
            (Some(parent), true) => {
                tree.joints[parent].offset = position_m;
                tree.joints[parent].twist = twist;
            }
            (None, true) => {
                tree.root_position = position_m;
                tree.root_rotation = (first.about_z() * twist.about_x()).map(snapped);
            }
            (_, false) => {
                let rotation = (first.about_z() * twist.about_x()).map(snapped);
                let coupling = Coupling::none();
                tree.joints[k].branch = Some(Branch { position: position_m, rotation, coupling });
            }
        }
        let is_carried = tree.joints.get(k + 1).is_some_and(|next| next.parent == Some(k));
        let toward = match is_carried {
            true => first_turn(&starts[k + 1].rotation, &starts[k + 1].position_m),
            false => toward(&tree.joints[k].body.first),
        };
        turn(tree, carried, &mut starts, k, toward);
        tree.joints[k].angle = last.plus(toward);
    }
}

/// Turns K of a joint about its z axis, and so all that is given in it the other way.
fn turn(tree: &mut Tree, carried: &mut [Carried], starts: &mut [Placement], k: usize, by: Turn) {
    let back = Placement { position_m: Vector3::zeros(), rotation: by.about_z().transpose() };
    let joint = &mut tree.joints[k];
    joint.body = joint.body.placed(&back.rotation, &Vector3::zeros());
    for frame in carried.iter_mut().filter(|frame| frame.joint == Some(k)) {
        frame.placement = back.then(&frame.placement).snapped();
    }
    for (start, joint) in starts.iter_mut().zip(&tree.joints) {
        if joint.parent == Some(k) {
            *start = back.then(start).snapped();
        }
    }
}

/// The first angle of a rotation Rz(first) Rx(twist) Rz(last) between two axes, the second of which passes
/// through `position`; along x where they are parallel.
fn first_turn(rotation: &Matrix3<f64>, position: &Vector3<f64>) -> Turn {
    match are_parallel(rotation) {
        true => toward(position),
        false => along(-rotation[(1, 2)], rotation[(0, 2)]),
    }
}

/// The others, once the first is known: together they are the rotation to rounding, whether it determines
/// each by itself or not.
fn other_turns(rotation: &Matrix3<f64>, first: Turn) -> [Turn; 2] {
    let rest = first.about_z().transpose() * rotation;
    let twist = match are_parallel(rotation) {
        true => (0.0_f64).atan2(rest[(2, 2)]),
        false => (-rest[(1, 2)]).atan2(rest[(2, 2)]),
    };
    [Turn::new(twist), Turn::new((-rest[(0, 1)]).atan2(rest[(0, 0)]))]
}

fn are_parallel(rotation: &Matrix3<f64>) -> bool {
    rotation[(0, 2)].hypot(rotation[(1, 2)]) <= PARALLEL
}

/// The angle about z at which a vector lies one way or the other; none if it lies along z.
fn toward(vector: &Vector3<f64>) -> Turn {
    match vector.xy().norm() > PARALLEL * vector.norm() {
        true => along(vector.x, vector.y),
        false => Turn::NONE,
    }
}

/// The angle of a line through the origin: no more than a right angle.
fn along(x: f64, y: f64) -> Turn {
    let sign = if x < 0.0 { -1.0 } else { 1.0 };
    Turn::new((sign * y).atan2(sign * x))
}

/// A rotation that turns z into `axis`, the shortest one.
fn onto(axis: &Vector3<f64>) -> Matrix3<f64> {
    let sin = Vector3::z().cross(axis);
    if sin.norm() <= PARALLEL {
        return Turn::new(if axis.z > 0.0 { 0.0 } else { std::f64::consts::PI }).about_x();
    }
    let mixed = sin.cross_matrix();
    (Matrix3::identity() + mixed + mixed * mixed / (1.0 + axis.z)).map(snapped)
}
