//! A free-floating base with an arm: the validated model.

use crate::chain::Chain;
use crate::error::{ModelError, Part};
use crate::parts::{Base, DhConvention, Link, Mount, Payload};

/// A free-floating base and its chain of revolute joints, checked once and immutable.
///
/// Joint i of the chain is element i−1 of every slice of joint coordinates; angles in rad.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    base: Base,
    mount: Mount,
    convention: DhConvention,
    links: Vec<Link>,
    payload: Option<Payload>,
    pub(crate) chain: Chain,
}

impl System {
    /// Checks a model and prepares its constants.
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
        mount.check()?;
        if links.is_empty() {
            return Err(ModelError::EmptyChain);
        }
        for (index, link) in links.iter().enumerate() {
            link.check(Part::Link(index), convention)?;
        }
        if let Some(payload) = &payload {
            payload.check()?;
        }
        Self::assembled(base, mount, convention, links, payload)
    }

    /// From parts that were checked.
    pub(crate) fn assembled(
        base: Base,
        mount: Mount,
        convention: DhConvention,
        links: Vec<Link>,
        payload: Option<Payload>,
    ) -> Result<Self, ModelError> {
        let chain = Chain::new(&base, &mount, convention, &links, payload.as_ref())?;
        Ok(Self { base, mount, convention, links, payload, chain })
    }

    /// Number of joints j, which is also the number of links.
    pub fn joint_count(&self) -> usize {
        self.links.len()
    }

    /// Mass of base, links and payload, kg.
    pub fn total_mass(&self) -> f64 {
        self.chain.total_mass
    }

    /// The base body.
    pub fn base(&self) -> &Base {
        &self.base
    }

    /// Where the arm is fixed.
    pub fn mount(&self) -> &Mount {
        &self.mount
    }

    /// How the rows of parameters are read.
    pub fn convention(&self) -> DhConvention {
        self.convention
    }

    /// The links, from the base outward.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// What the arm holds.
    pub fn payload(&self) -> Option<&Payload> {
        self.payload.as_ref()
    }

    /// Length of the arm: of all links together, m.
    pub fn length_m(&self) -> f64 {
        self.links.iter().map(Link::length_m).sum()
    }

    /// The length that the system is measured by: that of the arm stretched out, mount and all, m. Never
    /// zero.
    pub fn size_m(&self) -> f64 {
        let size_m = self.mount.position_m.norm() + self.length_m();
        match size_m > 0.0 {
            true => size_m,
            false => 1.0,
        }
    }

    /// Length of the links between two links (counted from zero) together, m: the two are never
    /// farther apart. Zero for neighbours, and for a link and itself.
    pub fn length_between_m(&self, a: usize, b: usize) -> f64 {
        let (inboard, outboard) = (a.min(b), a.max(b));
        let between = self.links.get(inboard + 1..outboard).unwrap_or_default();
        between.iter().map(Link::length_m).sum()
    }
}
