//! A free-floating base with its arms: the validated model.

use crate::bodies::{Placement, RigidBody};
use crate::error::ModelError;
use crate::jointed_body::{Bodies, JointKind, JointedBody};
use crate::parts::{Base, DhConvention, Link, Mount, Payload};
use crate::rows::Rows;
use crate::tree::Tree;

/// A free-floating base and the joints on it, checked once and immutable.
///
/// Joint coordinates are in the order of the rows, or of the bodies that have one: angles in rad, and of
/// joints that slide travels in m.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    base: Base,
    pub(crate) arm: Arm,
    pub(crate) tree: Tree,
}

/// How what is on the base was described.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Arm {
    Rows(Rows),
    Bodies(Bodies),
}

impl System {
    /// Checks the model of a serial arm that rows of Denavit-Hartenberg parameters describe, and prepares
    /// its constants.
    ///
    /// # Errors
    /// [`ModelError`] names the part, the value and what is allowed: no links, a number that is not
    /// finite, a negative mass, a base without mass, an inertia that is not symmetric, not positive
    /// (zero is allowed for links and payload), or beyond the triangle inequality by more than one
    /// part in 10⁹, a link whose mass is in a frame that the convention does not allow or in which
    /// nothing says where it is, a mount that is not rotated by a rotation.
    pub fn new(
        base: Base,
        mount: Mount,
        convention: DhConvention,
        links: Vec<Link>,
        payload: Option<Payload>,
    ) -> Result<Self, ModelError> {
        base.check()?;
        let rows = Rows { mount, convention, links, payload };
        rows.check()?;
        Self::assembled(base, Arm::Rows(rows))
    }

    /// Checks the model of a tree of bodies, and prepares its constants.
    ///
    /// # Errors
    /// As [`new`](Self::new); also no joint that moves, a body that does not lead to the base, an axis
    /// without a direction.
    pub fn of_bodies(base: Base, bodies: Vec<JointedBody>) -> Result<Self, ModelError> {
        base.check()?;
        Self::assembled(base, Arm::Bodies(Bodies::new(bodies)?))
    }

    /// From parts that were checked.
    pub(crate) fn assembled(base: Base, arm: Arm) -> Result<Self, ModelError> {
        let tree = match &arm {
            Arm::Rows(rows) => rows.tree(&base)?,
            Arm::Bodies(bodies) => bodies.tree(&base)?,
        };
        Ok(Self { base, arm, tree })
    }

    /// What the coordinate of each joint is.
    pub fn joint_kinds(&self) -> Vec<JointKind> {
        let mut kinds = vec![JointKind::Revolute; self.joint_count()];
        for joint in &self.tree.joints {
            kinds[joint.coordinate] = joint.kind;
        }
        kinds
    }

    /// Number of joints j.
    pub fn joint_count(&self) -> usize {
        self.tree.joints.len()
    }

    /// Number of parts that have a mass and a place of their own: links, or bodies.
    pub fn part_count(&self) -> usize {
        self.tree.centers.len()
    }

    /// Mass of the whole system, kg.
    pub fn total_mass(&self) -> f64 {
        self.tree.total_mass
    }

    /// The base body.
    pub fn base(&self) -> &Base {
        &self.base
    }

    /// The rows that describe a serial arm; none of a system of bodies.
    pub fn rows(&self) -> Option<&Rows> {
        match &self.arm {
            Arm::Rows(rows) => Some(rows),
            Arm::Bodies(_) => None,
        }
    }

    /// The bodies of a tree; none of a system of rows.
    pub fn bodies(&self) -> Option<&[JointedBody]> {
        match &self.arm {
            Arm::Rows(_) => None,
            Arm::Bodies(bodies) => Some(bodies.list()),
        }
    }

    /// The body of a tree that a joint turns, by its place in the list; none of a system of rows.
    pub fn body_of(&self, joint: usize) -> Option<usize> {
        match &self.arm {
            Arm::Rows(_) => None,
            Arm::Bodies(bodies) => bodies.coordinates().iter().position(|at| *at == Some(joint)),
        }
    }

    /// Length of an arm in rows: of all links together, m. Of bodies, as [`size_m`](Self::size_m).
    pub fn length_m(&self) -> f64 {
        self.rows().map_or_else(|| self.size_m(), Rows::length_m)
    }

    /// The length that the system is measured by: that of the arm stretched out, mount and all, or the
    /// farthest that a joint or a centre of mass can be from the body-frame origin, m. Never zero.
    pub fn size_m(&self) -> f64 {
        let size_m = match &self.arm {
            Arm::Rows(rows) => rows.mount.position_m.norm() + rows.length_m(),
            Arm::Bodies(bodies) => bodies.reach_m(),
        };
        match size_m > 0.0 {
            true => size_m,
            false => 1.0,
        }
    }

    /// Length of what is between two links or bodies (counted from zero) together, m: the two are never
    /// farther apart. Zero for those that share a joint, and for one and itself; infinite where a joint
    /// between two bodies slides that neither shares.
    pub fn length_between_m(&self, a: usize, b: usize) -> f64 {
        match &self.arm {
            Arm::Rows(rows) => rows.length_between_m(a, b),
            Arm::Bodies(bodies) => bodies.length_between_m(a, b),
        }
    }

    /// The same system with the lengths of its links multiplied by `length` and their masses by `mass`;
    /// base, mount and payload stay, and so do the places of joints on the base.
    ///
    /// # Errors
    /// [`ModelError::Overflow`] when a number is then beyond any number.
    pub fn with_links_scaled(&self, length: f64, mass: f64) -> Result<Self, ModelError> {
        let inertia = mass * length * length;
        let arm = match &self.arm {
            Arm::Rows(rows) => {
                let link = |link: &Link| Link {
                    mass_kg: link.mass_kg * mass,
                    a_m: link.a_m * length,
                    d_m: link.d_m * length,
                    center_of_mass_m: link.center_of_mass_m.map(|center| center * length),
                    inertia_kg_m2: link.inertia_kg_m2.map(|moments| moments * inertia),
                    ..link.clone()
                };
                Arm::Rows(Rows { links: rows.links.iter().map(link).collect(), ..rows.clone() })
            }
            Arm::Bodies(bodies) => Arm::Bodies(bodies.changed(|body| {
                let Placement { position_m, rotation } = body.placement;
                let on_base = body.parent.is_none();
                let position_m = if on_base { position_m } else { position_m * length };
                let RigidBody { mass_kg, center_of_mass_m, inertia_kg_m2 } = body.body;
                JointedBody {
                    placement: Placement { position_m, rotation },
                    body: RigidBody {
                        mass_kg: mass_kg * mass,
                        center_of_mass_m: center_of_mass_m * length,
                        inertia_kg_m2: inertia_kg_m2 * inertia,
                    },
                    ..*body
                }
            })),
        };
        Self::assembled(self.base.clone(), arm)
    }
}
