//! The arms as other programs take them: named bodies on named hinges.

use righting_multibody::{HingedBody, JointKind, Placement, RigidBody};
use righting_scenario::{JointLimits, SystemDescription};

/// Name of the base.
pub(crate) const BASE: &str = "base";
/// Name of the last frame, beyond the last body.
pub(crate) const TIP: &str = "tip";

/// A base with the bodies of its arms.
pub(crate) struct Arm {
    pub base: RigidBody,
    /// Depth first from the base: each after the one that carries it.
    pub hinges: Vec<Hinge>,
    /// Of an arm in rows, the last frame in the frame of the last body.
    pub tip: Option<Placement>,
}

/// A body and the hinge that turns it about its z axis, or slides it along that.
pub(crate) struct Hinge {
    pub kind: JointKind,
    /// Name of the joint.
    pub joint: String,
    /// Name of the body.
    pub link: String,
    /// Place of the joint among the joint coordinates.
    pub coordinate: usize,
    /// The hinge of the body that carries it, by its place; none for the base.
    pub parent: Option<usize>,
    /// At joint coordinate zero, in the frame of the body that carries it.
    pub placement: Placement,
    pub body: RigidBody,
    pub limits: JointLimits,
    /// Whether the hinge moves no inertia.
    pub is_idle: bool,
    /// The angle or travel that it holds, if it does not move; rad or m.
    pub held_at: Option<f64>,
}

impl Arm {
    /// The arms of a system; locked joints hold their angle.
    pub fn new(system: &SystemDescription) -> Self {
        let bodies = system.model.hinged_bodies();
        let mut hinges: Vec<Hinge> = Vec::with_capacity(bodies.len());
        let mut ahead = carried_by(&bodies, None);
        while let Some(coordinate) = ahead.pop() {
            ahead.extend(carried_by(&bodies, Some(coordinate)));
            let HingedBody { kind, parent, placement, body, is_idle } = bodies[coordinate];
            let limits = system.joint_limits[coordinate];
            let place = |parent: usize| hinges.iter().position(|hinge| hinge.coordinate == parent);
            hinges.push(Hinge {
                kind,
                joint: joint_name(system, coordinate),
                link: link_name(system, coordinate),
                coordinate,
                parent: parent.and_then(place),
                placement,
                body,
                limits,
                is_idle,
                held_at: limits.is_locked().then_some(limits.angle_min_rad),
            });
        }
        let frames = system.model.carried_frames();
        let last = frames.last().map(|(_, placement)| *placement);
        let tip = last.filter(|_| system.model.rows().is_some());
        Self { base: system.model.base_body(), hinges, tip }
    }

    /// The hinges of the bodies that a body carries, the base if none.
    pub fn carried_by(&self, parent: Option<usize>) -> impl Iterator<Item = usize> + '_ {
        (0..self.hinges.len()).filter(move |&index| self.hinges[index].parent == parent)
    }

    /// The one hinge on a body; none if there are none or several.
    pub fn only_next(&self, index: usize) -> Option<&Hinge> {
        let mut next = self.carried_by(Some(index));
        let first = next.next()?;
        next.next().is_none().then(|| &self.hinges[first])
    }
}

/// The joints on a body, the last one first.
fn carried_by(bodies: &[HingedBody], parent: Option<usize>) -> Vec<usize> {
    (0..bodies.len()).rev().filter(|&index| bodies[index].parent == parent).collect()
}

impl Hinge {
    /// Where the body is, its joint at zero or held.
    pub fn placed(&self) -> Placement {
        match (self.held_at, self.kind) {
            (Some(angle_rad), JointKind::Revolute) => self.placement.turned_about_z(angle_rad),
            (Some(travel_m), JointKind::Prismatic) => self.placement.moved_along_z(travel_m),
            (None, _) => self.placement,
        }
    }
}

impl Hinge {
    /// Whether the body has no inertia about its hinge and the next hinge, which turns, has the same
    /// axis; then 1, or −1 where the two turn in opposite senses.
    pub fn shares_axis_with(&self, next: &Self) -> Option<f64> {
        /// Rounding of a direction, and of a mass that lies on an axis.
        const ROUNDING: f64 = 1e-14;
        let Placement { position_m, rotation } = &next.placement;
        let center = self.body.center_of_mass_m;
        let moments = self.body.inertia_kg_m2;
        let about_axis = self.body.mass_kg * center.xy().norm_squared() + moments[(2, 2)];
        let about_all = self.body.mass_kg * center.norm_squared() + moments.trace();
        let is_on_axis = about_axis <= ROUNDING * about_all
            && position_m.xy().norm() <= ROUNDING * position_m.norm()
            && (1.0 - rotation[(2, 2)].abs()) <= ROUNDING;
        let both_turn = [self.kind, next.kind] == [JointKind::Revolute; 2];
        (is_on_axis && both_turn && next.held_at.is_none() && !next.is_idle)
            .then_some(rotation[(2, 2)].signum())
    }
}

/// Name of a joint, counted from zero.
pub(crate) fn joint_name(system: &SystemDescription, joint: usize) -> String {
    match system.names.of_joint(joint) {
        Some(name) => name.to_owned(),
        None => format!("joint_{}", joint + 1),
    }
}

/// Name of the body that a joint turns.
fn link_name(system: &SystemDescription, joint: usize) -> String {
    let name = match system.model.rows() {
        Some(_) => None,
        None => system.model.body_of(joint).and_then(|body| system.names.of_body(body)),
    };
    name.map_or_else(|| format!("link_{}", joint + 1), str::to_owned)
}
