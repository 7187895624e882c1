//! Arms described by rows of Denavit-Hartenberg parameters.
//!
//! A standard row i gives the offset (a, 0, d) from K(i) to K(i+1) and its body in K(i); its frame i is
//! K(i) carried through offset and twist. A modified row i gives offset (a, −d sin α, d cos α), all of it
//! between K(i−1) and K(i), and its frame i is K(i); its mass is body i−1 or body i, as its inertial
//! frame says. See [`Tree`] for the frames K.

use crate::bodies::Placement;
use crate::error::{ModelError, Part};
use crate::inertia::{MassMoments, rod_inertia};
use crate::parts::{Base, DhConvention, InertialFrame, Link, Mount, Payload};
use crate::tree::{Carried, Joint, Tree, snapped};
use crate::turn::Turn;
use nalgebra::{Matrix3, Vector3};

/// A serial arm: where it is fixed, its rows and what it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Rows {
    /// Where the arm is fixed.
    pub mount: Mount,
    /// How the rows of parameters are read.
    pub convention: DhConvention,
    /// The links, from the base outward; one a joint.
    pub links: Vec<Link>,
    /// What the arm holds.
    pub payload: Option<Payload>,
}

impl Rows {
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        self.mount.check()?;
        if self.links.is_empty() {
            return Err(ModelError::EmptyChain);
        }
        for (index, link) in self.links.iter().enumerate() {
            link.check(Part::Link(index), self.convention)?;
        }
        self.payload.as_ref().map_or(Ok(()), Payload::check)
    }

    /// Length of the arm: of all links together, m.
    pub(crate) fn length_m(&self) -> f64 {
        self.links.iter().map(Link::length_m).sum()
    }

    /// Length of the links between two links (counted from zero) together, m.
    pub(crate) fn length_between_m(&self, a: usize, b: usize) -> f64 {
        let (inboard, outboard) = (a.min(b), a.max(b));
        let between = self.links.get(inboard + 1..outboard).unwrap_or_default();
        between.iter().map(Link::length_m).sum()
    }

    pub(crate) fn tree(&self, base: &Base) -> Result<Tree, ModelError> {
        let Self { mount, convention, links, payload } = self;
        let mount_rotation = mount.rotation.matrix().map(snapped);
        let on_mount = Placement { position_m: mount.position_m, rotation: mount_rotation };
        let rows: Vec<Row> = links.iter().map(|link| Row::new(link, *convention)).collect();
        let angles = links.iter().map(|link| Turn::new(link.theta_rad));
        let mut tree = Tree::of_base(base);
        tree.root_rotation = mount_rotation;
        tree.root_position = mount.position_m;
        tree.mount_position = mount.position_m;
        tree.frames.push(Carried { joint: None, placement: on_mount });
        let held = payload.as_ref().map_or_else(MassMoments::zero, held_moments);
        match convention {
            DhConvention::Standard => {
                for (k, (angle, row)) in angles.zip(rows).enumerate() {
                    tree.centers.push((Some(k), row.center));
                    let joint = Joint::new(k, Part::Link(k), angle);
                    let joint =
                        Joint { body: row.body, offset: row.offset, twist: row.twist, ..joint };
                    tree.frames.push(Carried { joint: Some(k), placement: joint.outboard() });
                    tree.joints.push(joint);
                }
                if let Some(last) = tree.joints.last_mut() {
                    let held = held.placed(&last.twist.about_x(), &last.offset);
                    last.body = last.body.joined(&held);
                }
            }
            DhConvention::Modified => {
                let fixed = &rows[0];
                tree.root_rotation = (mount_rotation * fixed.twist.about_x()).map(snapped);
                tree.root_position = mount.position_m + mount_rotation * fixed.offset;
                let mut bodies = vec![MassMoments::zero(); rows.len()];
                for (k, row) in rows.iter().enumerate() {
                    let joint = match row.inertial_frame {
                        InertialFrame::Own => Some(k),
                        InertialFrame::Previous => k.checked_sub(1),
                    };
                    match joint {
                        Some(joint) => {
                            bodies[joint] = bodies[joint].joined(&row.body);
                            tree.centers.push((Some(joint), row.center));
                        }
                        None => {
                            let body = row.body.placed(&mount_rotation, &mount.position_m);
                            tree.base = tree.base.joined(&body);
                            tree.foot = tree.foot.joined(&body);
                            let center = mount.position_m + mount_rotation * row.center;
                            tree.centers.push((None, center));
                        }
                    }
                }
                if let Some(last) = bodies.last_mut() {
                    *last = last.joined(&held);
                }
                for (k, (angle, body)) in angles.zip(bodies).enumerate() {
                    let (offset, twist) = rows
                        .get(k + 1)
                        .map_or((Vector3::zeros(), Turn::NONE), |row| (row.offset, row.twist));
                    let joint = Joint::new(k, Part::Link(k), angle);
                    tree.joints.push(Joint { body, offset, twist, ..joint });
                    let placement = Placement::identity();
                    tree.frames.push(Carried { joint: Some(k), placement });
                }
            }
        }
        tree.coupled()
    }
}

/// What one row of parameters says.
struct Row {
    /// The segment, in K of the joint that moves it.
    offset: Vector3<f64>,
    twist: Turn,
    inertial_frame: InertialFrame,
    /// The mass, in K of the joint that moves it.
    body: MassMoments,
    center: Vector3<f64>,
}

impl Row {
    fn new(link: &Link, convention: DhConvention) -> Self {
        let twist = Turn::new(link.alpha_rad);
        let (sin, cos) = twist.sin_cos();
        let inertial_frame = link.inertial_frame.unwrap_or(convention.inertial_frame());
        // The frame that the mass is in, seen from the K that it moves with: a standard link's is its
        // outboard frame, beyond offset and twist; a modified row's are the frames K themselves.
        let (offset, own_rotation, own_position) = match convention {
            DhConvention::Standard => {
                let offset = Vector3::new(link.a_m, 0.0, link.d_m);
                (offset, twist.about_x(), offset)
            }
            DhConvention::Modified => {
                let offset = Vector3::new(link.a_m, -sin * link.d_m + 0.0, cos * link.d_m + 0.0);
                (offset, Matrix3::identity(), Vector3::zeros())
            }
        };
        let middle = match inertial_frame == convention.inertial_frame() {
            true => offset / 2.0,
            // Seen from here the segment moves: only a link without mass has no center of its own.
            false => Vector3::zeros(),
        };
        let center =
            link.center_of_mass_m.map_or(middle, |center| own_position + own_rotation * center);
        let body = if link.center_of_mass_m.is_none() && link.inertia_kg_m2.is_none() {
            MassMoments::of_rod(link.mass_kg, offset)
        } else {
            let inertia = link.inertia_kg_m2.map_or_else(
                || rod_inertia(link.mass_kg, &offset),
                |inertia| own_rotation * inertia * own_rotation.transpose(),
            );
            MassMoments::of_body(link.mass_kg, center, &inertia)
        };
        Self { offset, twist, inertial_frame, body, center }
    }
}

fn held_moments(payload: &Payload) -> MassMoments {
    let inertia = payload.inertia_kg_m2.unwrap_or_else(Matrix3::zeros);
    MassMoments::of_body(payload.mass_kg, Vector3::zeros(), &inertia)
}
