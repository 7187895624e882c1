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
    /// The angle that it holds, if it does not turn.
    pub held_rad: Option<f64>,
}

impl Arm {
    /// The arm of a system; locked joints hold their angle.
    pub fn new(system: &SystemDescription) -> Self {
        let bodies = system.model.hinged_bodies();
        let hinges = bodies.into_iter().zip(&system.joint_limits).enumerate();
        let hinge = |(index, (hinged, limits)): (usize, (_, &JointLimits))| {
            let righting_multibody::HingedBody { placement, body, .. } = hinged;
            Hinge {
                joint: joint_name(index),
                link: format!("link_{}", index + 1),
                placement,
                body,
                limits: *limits,
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

/// Name of a joint, counted from zero at the base.
pub(crate) fn joint_name(index: usize) -> String {
    format!("joint_{}", index + 1)
}
