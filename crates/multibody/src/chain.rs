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
//! and K(i), and its frame i is K(i).

use crate::error::{ModelError, Part};
use crate::inertia::MassMoments;
use crate::system::{Base, DhConvention, Link, Mount, Payload};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::FRAC_PI_2;

/// Everything constant about the system.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chain {
    pub total_mass: f64,
    /// The base with all that is fixed to it, about the body-frame origin.
    pub base: MassMoments,
    /// Turns vectors of the frame that joint 1 turns in into body axes.
    pub root_rotation: Matrix3<f64>,
    /// Origin of K(1), body axes.
    pub root_position: Vector3<f64>,
    /// How the base takes in the arm, in the axes that joint 1 turns in.
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

/// How the moments of what lies beyond joint k change on the way from the origin of K(k+1) to that
/// of K(k), where they take in body k.
///
/// Counting every mass relative to the system's centre of mass (the barycentric or augmented-body
/// form: S̃ = S − F Fᵀ/M with F the first moment, M the total mass) leaves the recursion as cheap as
/// it was and saves the correction at the end:
///
/// ```text
/// F' = F + g,                       g = M(k+1) o + f
/// S̃' = S̃ + F bᵀ + b Fᵀ + C,         b = o − g/M,   C = M(k+1) o oᵀ + s − g gᵀ/M
/// ```
///
/// with M(k+1) the mass beyond, o the offset, f and s the body's own moments. For a body whose mass
/// lies along its offset C = κ b bᵀ, so that S̃' = S̃ + G bᵀ + b Gᵀ with G = F + κ b/2.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Coupling {
    /// g, kg m.
    pub first: Vector3<f64>,
    /// b, m.
    pub arm: Vector3<f64>,
    /// κ b/2, kg m; zero where the body's mass does not lie along its offset.
    pub half: Vector3<f64>,
    /// C, kg m²; none where κ b bᵀ is all of it.
    pub rest: Option<Matrix3<f64>>,
    /// g/b where both are parallel, kg.
    pub first_over_arm: Option<f64>,
}

/// How the base takes in the arm: a [`Coupling`] without the part of its arm b that lies along joint 1.
///
/// That part may be taken in before joint 1 turns, so joint 1's coupling has it. Where the joint's
/// axis passes through the base's centre of mass it is all there is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RootCoupling {
    /// g in body axes, kg m.
    pub first: Vector3<f64>,
    /// C of the whole base, body axes, kg m².
    pub second: Matrix3<f64>,
    /// b across joint 1, in the axes that joint 1 turns in, m.
    pub across: Vector3<f64>,
}

/// Where a link's centre of mass is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LinkCenter {
    /// In body axes, from the body-frame origin.
    OnBase(Vector3<f64>),
    /// In K of the joint that moves the link, counted from zero.
    OnJoint(usize, Vector3<f64>),
}

/// A constant angle, kept so that multiples of a right angle have exact sine and cosine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Turn {
    pub quarters: i64,
    pub rest_rad: f64,
}

impl Turn {
    pub const NONE: Self = Self { quarters: 0, rest_rad: 0.0 };

    pub fn new(angle_rad: f64) -> Self {
        let turns = angle_rad / FRAC_PI_2;
        let nearest = turns.round();
        // Beyond this size a right angle is below the resolution of the number.
        let exact = nearest.abs() < 1e9
            && (turns - nearest).abs() <= 4.0 * f64::EPSILON * nearest.abs().max(1.0);
        if exact {
            Self { quarters: (nearest as i64).rem_euclid(4), rest_rad: 0.0 }
        } else {
            Self { quarters: 0, rest_rad: angle_rad }
        }
    }

    pub fn plus(self, other: Self) -> Self {
        Self {
            quarters: (self.quarters + other.quarters).rem_euclid(4),
            rest_rad: self.rest_rad + other.rest_rad,
        }
    }

    pub fn is_none(self) -> bool {
        self == Self::NONE
    }

    pub fn sin_cos(self) -> (f64, f64) {
        let (sin, cos) = self.rest_rad.sin_cos();
        match self.quarters {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    /// Rotation about x by this angle.
    pub fn about_x(self) -> Matrix3<f64> {
        let (sin, cos) = self.sin_cos();
        Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos).map(|entry| entry + 0.0)
    }
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
        let base_body = MassMoments::of_body(base.mass_kg, Vector3::zeros(), &base.inertia_kg_m2);
        let payload_moments = |twist: Turn, position: &Vector3<f64>| {
            payload.map_or_else(MassMoments::zero, |payload| {
                let inertia = payload.inertia_kg_m2.unwrap_or_else(Matrix3::zeros);
                MassMoments::of_body(payload.mass_kg, Vector3::zeros(), &inertia)
                    .placed(&twist.about_x(), position)
            })
        };
        let rows: Vec<Row> = links.iter().map(|link| Row::new(link, convention)).collect();
        let angles = links.iter().map(|link| Turn::new(link.theta_rad));
        let last = links.len() - 1;
        let mut chain = Self {
            total_mass: 0.0,
            base: base_body,
            root_rotation: mount_rotation,
            root_position: mount.position_m,
            root: RootCoupling::none(),
            joints: Vec::new(),
            link_centers: Vec::new(),
        };
        match convention {
            DhConvention::Standard => {
                for (k, (angle, row)) in angles.zip(rows).enumerate() {
                    let mut body = row.body;
                    if k == last {
                        body = body.joined(&payload_moments(row.twist, &row.offset));
                    }
                    chain.joints.push(Joint::new(angle, body, row.offset, row.twist));
                    chain.link_centers.push(LinkCenter::OnJoint(k, row.center));
                }
            }
            DhConvention::Modified => {
                let fixed = &rows[0];
                let center = mount.position_m + mount_rotation * fixed.center;
                chain.link_centers.push(LinkCenter::OnBase(center));
                chain.base =
                    chain.base.joined(&fixed.body.placed(&mount_rotation, &mount.position_m));
                chain.root_rotation = (mount_rotation * fixed.twist.about_x()).map(snapped);
                chain.root_position = mount.position_m + mount_rotation * fixed.offset;
                for (k, angle) in angles.enumerate() {
                    let joint = match rows.get(k + 1) {
                        Some(row) => {
                            chain.link_centers.push(LinkCenter::OnJoint(k, row.center));
                            Joint::new(angle, row.body.clone(), row.offset, row.twist)
                        }
                        None => {
                            let held = payload_moments(Turn::NONE, &Vector3::zeros());
                            Joint::new(angle, held, Vector3::zeros(), Turn::NONE)
                        }
                    };
                    chain.joints.push(joint);
                }
            }
        }
        chain.coupled()
    }

    fn coupled(mut self) -> Result<Self, ModelError> {
        let moved: f64 = self.joints.iter().map(|joint| joint.body.mass).sum();
        self.total_mass = self.base.mass + moved;
        let base_is_finite = self.base.is_finite() && self.total_mass.is_finite();
        if !base_is_finite || !self.root_position.iter().all(|value| value.is_finite()) {
            return Err(ModelError::Overflow { part: Part::Base });
        }
        let mut beyond = 0.0;
        for (k, joint) in self.joints.iter_mut().enumerate().rev() {
            let (first, arm, second) =
                barycentric(&joint.body, &joint.offset, beyond, self.total_mass);
            joint.coupling = Coupling::new(first, arm, second);
            beyond += joint.body.mass;
            if !(joint.body.is_finite() && joint.coupling.is_finite()) {
                return Err(ModelError::Overflow { part: Part::Link(k) });
            }
        }
        let (first, arm, second) =
            barycentric(&self.base, &self.root_position, beyond, self.total_mass);
        let arm = (self.root_rotation.transpose() * arm).map(|entry| entry + 0.0);
        self.root = RootCoupling { first, second, across: Vector3::new(arm.x, arm.y, 0.0) };
        self.joints[0].take_in_along_axis(arm.z, self.total_mass, moved);
        if !(self.root.is_finite() && self.joints[0].coupling.is_finite()) {
            return Err(ModelError::Overflow { part: Part::Base });
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
        Self { angle, body, offset, twist, coupling: Coupling::none() }
    }

    /// Shifts the point to which the coupling leads by `along` down the joint's axis.
    fn take_in_along_axis(&mut self, along: f64, total: f64, moved: f64) {
        let (first, arm, second) =
            barycentric(&self.body, &self.offset, moved - self.body.mass, total);
        let shift = Vector3::new(0.0, 0.0, along);
        let mixed = first * shift.transpose();
        self.coupling = Coupling::new(first, arm + shift, second + mixed + mixed.transpose());
    }
}

impl Coupling {
    fn none() -> Self {
        let zero = Vector3::zeros();
        Self { first: zero, arm: zero, half: zero, rest: None, first_over_arm: None }
    }

    fn new(first: Vector3<f64>, arm: Vector3<f64>, second: Matrix3<f64>) -> Self {
        let arm_squared = arm.norm_squared();
        let factor = if arm_squared > 0.0 {
            arm.dot(&(second * arm)) / (arm_squared * arm_squared)
        } else {
            0.0
        };
        let ratio = if arm_squared > 0.0 { first.dot(&arm) / arm_squared } else { 0.0 };
        let parallel = (first - arm * ratio).amax() <= 64.0 * f64::EPSILON * first.amax();
        let first_over_arm = parallel.then_some(ratio);
        let rounding = 64.0 * f64::EPSILON * second.amax();
        let rest = second - arm * arm.transpose() * factor;
        if rest.amax() <= rounding {
            return Self { first, arm, half: arm * (factor / 2.0), rest: None, first_over_arm };
        }
        let rest = second.map(|entry| if entry.abs() > rounding { entry } else { 0.0 });
        Self { first, arm, half: Vector3::zeros(), rest: Some(rest), first_over_arm }
    }

    fn is_finite(&self) -> bool {
        let vectors = [self.first, self.arm, self.half];
        vectors.iter().flatten().all(|value| value.is_finite())
            && self.rest.iter().flatten().all(|value| value.is_finite())
    }
}

/// g, b and C of [`Coupling`].
fn barycentric(
    body: &MassMoments,
    offset: &Vector3<f64>,
    beyond: f64,
    total: f64,
) -> (Vector3<f64>, Vector3<f64>, Matrix3<f64>) {
    let first = offset * beyond + body.first;
    let second =
        offset * offset.transpose() * beyond + body.second - first * first.transpose() / total;
    (first, offset - first / total, second)
}

impl RootCoupling {
    fn none() -> Self {
        let zero = Vector3::zeros();
        Self { first: zero, second: Matrix3::zeros(), across: zero }
    }

    fn is_finite(&self) -> bool {
        self.first.iter().chain(&self.across).chain(&self.second).all(|v| v.is_finite())
    }
}

/// What one row of parameters says, in the frame that the row's link moves with.
struct Row {
    body: MassMoments,
    offset: Vector3<f64>,
    twist: Turn,
    center: Vector3<f64>,
}

impl Row {
    fn new(link: &Link, convention: DhConvention) -> Self {
        let twist = Turn::new(link.alpha_rad);
        let (sin, cos) = twist.sin_cos();
        // Where the link's own frame sits in the one that carries it here: a standard link's is
        // its outboard frame, beyond offset and twist.
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
        let center = link
            .center_of_mass_m
            .map_or(offset / 2.0, |center| own_position + own_rotation * center);
        let rod = MassMoments::of_rod(link.mass_kg, offset);
        let body = if link.center_of_mass_m.is_none() && link.inertia_kg_m2.is_none() {
            rod
        } else {
            let inertia = link.inertia_kg_m2.map_or_else(
                || rod_inertia(link.mass_kg, &offset),
                |inertia| own_rotation * inertia * own_rotation.transpose(),
            );
            MassMoments::of_body(link.mass_kg, center, &inertia)
        };
        Self { body, offset, twist, center }
    }
}

/// m/12 (‖s‖² 1 − s sᵀ), about the centre of a slender rod.
fn rod_inertia(mass: f64, segment: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::from_diagonal_element(segment.norm_squared()) - segment * segment.transpose())
        * (mass / 12.0)
}

/// Rounding taken off the entries of a rotation matrix that are 0 or ±1.
fn snapped(entry: f64) -> f64 {
    let nearest = entry.round();
    if (entry - nearest).abs() < 1e-15 { nearest + 0.0 } else { entry }
}
