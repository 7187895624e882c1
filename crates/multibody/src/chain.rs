//! The chain in one form for both Denavit-Hartenberg conventions, with its constants worked out.
//!
//! Joint k turns about the z axis of frame K(k), whose origin lies on the joint's axis. Between
//! neighbours the frames differ by constants and one angle:
//!
//! ```text
//! K(k+1) = K(k) · T(offset(k)) · Rx(twist(k)) · Rz(θ(k+1) + q(k+1))
//! ```
//!
//! A standard row i gives offset (a, 0, d) and body i in K(i); its frame i is K(i) carried through
//! offset and twist. A modified row i gives offset (a, −d sin α, d cos α), all of it between K(i−1)
//! and K(i), and its frame i is K(i); its mass is body i−1 or body i, as its inertial frame says.

use crate::coupling::{Barycentric, Coupling, RootCoupling};
use crate::error::{ModelError, Part};
use crate::inertia::{MassMoments, rod_inertia};
use crate::parts::{Base, DhConvention, InertialFrame, Link, Mount, Payload};
use crate::turn::Turn;
use nalgebra::{Matrix3, Vector3};

/// Everything constant about the system.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chain {
    pub total_mass: f64,
    /// The base with all that is fixed to it, about the body-frame origin.
    pub base: MassMoments,
    /// What of that lies beyond the mount, about the body-frame origin.
    pub foot: MassMoments,
    /// Turns vectors of the frame that joint 1 turns in into body axes.
    pub root_rotation: Matrix3<f64>,
    /// Origin of K(1), body axes.
    pub root_position: Vector3<f64>,
    pub root: RootCoupling,
    pub joints: Vec<Joint>,
    /// Centre of mass of each link, in the order of the rows.
    pub link_centers: Vec<LinkCenter>,
}

/// One joint with the rigid body that it turns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Joint {
    /// Angle of K(k) where the joint coordinate is zero.
    pub angle: Turn,
    /// The rigid body that turns with this joint, about the origin and in the axes of K(k).
    pub body: MassMoments,
    /// From the origin of K(k) to that of K(k+1), or to the last origin.
    pub offset: Vector3<f64>,
    /// From the axes of K(k) to those in which the next joint turns, or the last frame's.
    pub twist: Turn,
    pub coupling: Coupling,
}

/// Where a link's centre of mass is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LinkCenter {
    /// In body axes, from the body-frame origin.
    OnBase(Vector3<f64>),
    /// In K of the joint that moves the link, counted from zero.
    OnJoint(usize, Vector3<f64>),
}

impl Chain {
    pub fn new(
        base: &Base,
        mount: &Mount,
        convention: DhConvention,
        links: &[Link],
        payload: Option<&Payload>,
    ) -> Result<Self, ModelError> {
        let mount_rotation = mount.rotation.matrix().map(snapped);
        let rows: Vec<Row> = links.iter().map(|link| Row::new(link, convention)).collect();
        let angles = links.iter().map(|link| Turn::new(link.theta_rad));
        let mut chain = Self {
            total_mass: 0.0,
            base: MassMoments::of_body(base.mass_kg, Vector3::zeros(), &base.inertia_kg_m2),
            foot: MassMoments::zero(),
            root_rotation: mount_rotation,
            root_position: mount.position_m,
            root: RootCoupling::none(),
            joints: Vec::with_capacity(links.len()),
            link_centers: Vec::with_capacity(links.len()),
        };
        let held = payload.map_or_else(MassMoments::zero, held_moments);
        match convention {
            DhConvention::Standard => {
                for (k, (angle, row)) in angles.zip(rows).enumerate() {
                    chain.link_centers.push(LinkCenter::OnJoint(k, row.center));
                    chain.joints.push(Joint::new(angle, row.body, row.offset, row.twist));
                }
                if let Some(last) = chain.joints.last_mut() {
                    let held = held.placed(&last.twist.about_x(), &last.offset);
                    last.body = last.body.joined(&held);
                }
            }
            DhConvention::Modified => {
                let fixed = &rows[0];
                chain.root_rotation = (mount_rotation * fixed.twist.about_x()).map(snapped);
                chain.root_position = mount.position_m + mount_rotation * fixed.offset;
                let mut bodies = vec![MassMoments::zero(); rows.len()];
                for (k, row) in rows.iter().enumerate() {
                    let joint = match row.inertial_frame {
                        InertialFrame::Own => Some(k),
                        InertialFrame::Previous => k.checked_sub(1),
                    };
                    match joint {
                        Some(joint) => {
                            bodies[joint] = bodies[joint].joined(&row.body);
                            chain.link_centers.push(LinkCenter::OnJoint(joint, row.center));
                        }
                        None => {
                            let body = row.body.placed(&mount_rotation, &mount.position_m);
                            chain.base = chain.base.joined(&body);
                            chain.foot = chain.foot.joined(&body);
                            let center = mount.position_m + mount_rotation * row.center;
                            chain.link_centers.push(LinkCenter::OnBase(center));
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
                    chain.joints.push(Joint::new(angle, body, offset, twist));
                }
            }
        }
        chain.coupled()
    }

    fn coupled(mut self) -> Result<Self, ModelError> {
        let moved: f64 = self.joints.iter().map(|joint| joint.body.mass).sum();
        let total = self.base.mass + moved;
        self.total_mass = total;
        let base = Barycentric::new(&self.base, &self.root_position, moved, total);
        if !(base.is_finite() && total.is_finite()) {
            return Err(ModelError::Overflow { part: Part::Base });
        }
        let (root, along) = RootCoupling::new(&base, &self.root_rotation);
        self.root = root;
        let mut beyond = 0.0;
        for (k, joint) in self.joints.iter_mut().enumerate().rev() {
            let constants = Barycentric::new(&joint.body, &joint.offset, beyond, total);
            let constants = if k == 0 { constants.shifted(&along) } else { constants };
            if !constants.is_finite() {
                return Err(ModelError::Overflow { part: Part::Link(k) });
            }
            joint.coupling = Coupling::new(constants);
            beyond += joint.body.mass;
        }
        Ok(self)
    }

    /// Whether joint k turns about an axis parallel to that of joint k−1.
    pub fn continues_group(&self, k: usize) -> bool {
        0 < k && k < self.joints.len() && self.joints[k - 1].twist.is_none()
    }
}

impl Joint {
    fn new(angle: Turn, body: MassMoments, offset: Vector3<f64>, twist: Turn) -> Self {
        let none = Barycentric::new(&MassMoments::zero(), &Vector3::zeros(), 0.0, 1.0);
        Self { angle, body, offset, twist, coupling: Coupling::new(none) }
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

/// Rounding taken off the entries of a rotation matrix that are 0 or ±1.
fn snapped(entry: f64) -> f64 {
    let nearest = entry.round();
    if (entry - nearest).abs() < 1e-15 { nearest + 0.0 } else { entry }
}
