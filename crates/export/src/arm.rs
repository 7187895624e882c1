//! The arm as other programs take it: named bodies on named hinges.

use righting_multibody::{Placement, RigidBody};
use righting_scenario::{JointLimits, SystemDescription};

/// Name of the base.
pub(crate) const BASE: &str = "base";
/// Name of the last frame, beyond the last body.
pub(crate) const TIP: &str = "tip";

/// A base with the bodies of its arm.
pub(crate) struct Arm {
    pub base: RigidBody,
    pub hinges: Vec<Hinge>,
    /// The last frame in the frame of the last body.
    pub tip: Placement,
}

/// A body and the hinge that turns it about its z axis.
pub(crate) struct Hinge {
    /// Name of the joint.
    pub joint: String,
    /// Name of the body.
    pub link: String,
    /// At joint angle zero, in the frame of the body before.
    pub placement: Placement,
    pub body: RigidBody,
    pub limits: JointLimits,
    /// Whether the hinge turns no inertia.
    pub is_idle: bool,
    /// The angle that it holds, if it does not turn.
    pub held_rad: Option<f64>,
}

impl Arm {
    /// The arm of a system; locked joints hold their angle.
    pub fn new(system: &SystemDescription) -> Self {
        let bodies = system.model.hinged_bodies();
        let hinges = bodies.into_iter().zip(&system.joint_limits).enumerate();
        let hinge = |(index, (hinged, limits)): (usize, (_, &JointLimits))| {
            let righting_multibody::HingedBody { placement, body, is_idle } = hinged;
            Hinge {
                joint: joint_name(index),
                link: format!("link_{}", index + 1),
                placement,
                body,
                limits: *limits,
                is_idle,
                held_rad: limits.is_locked().then_some(limits.angle_min_rad),
            }
        };
        Self {
            base: system.model.base_body(),
            hinges: hinges.map(hinge).collect(),
            tip: system.model.last_frame(),
        }
    }
}

impl Hinge {
    /// Where the body is, its joint at zero or held.
    pub fn placed(&self) -> Placement {
        match self.held_rad {
            Some(angle_rad) => self.placement.turned_about_z(angle_rad),
            None => self.placement,
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
        (is_on_axis && next.held_rad.is_none() && !next.is_idle)
            .then_some(rotation[(2, 2)].signum())
    }
}

/// Name of a joint, counted from zero at the base.
pub(crate) fn joint_name(index: usize) -> String {
    format!("joint_{}", index + 1)
}
