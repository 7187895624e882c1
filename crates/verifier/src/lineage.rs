//! Which body of a tree carries which, from the system file.

use std::collections::HashMap;

use righting_scenario::file::{self, JointType};

/// The bodies of a system by their places in its list; none where it has rows.
#[derive(Clone, Debug)]
pub(super) struct Lineage {
    /// Who carries each; none for the base.
    parents: Vec<Option<usize>>,
    /// The joint coordinate of each; none where it is fixed.
    joints: Vec<Option<usize>>,
    /// Which slide.
    slides: Vec<bool>,
}

impl Lineage {
    /// Of a system that was checked when its scenario was read.
    pub fn new(system: &file::System) -> Self {
        let bodies = system.bodies.as_deref().unwrap_or_default();
        let places: HashMap<&str, usize> =
            bodies.iter().enumerate().map(|(place, body)| (body.name.as_str(), place)).collect();
        let mut count = 0;
        let joint = |body: &file::Body| {
            let is_fixed = body.joint.kind == JointType::Fixed;
            count += usize::from(!is_fixed);
            (!is_fixed).then(|| count - 1)
        };
        Self {
            parents: bodies.iter().map(|body| places.get(body.parent.as_str()).copied()).collect(),
            joints: bodies.iter().map(joint).collect(),
            slides: bodies.iter().map(|body| body.joint.kind == JointType::Prismatic).collect(),
        }
    }

    /// Who carries a body; none for the base.
    pub fn parent(&self, body: usize) -> Option<usize> {
        self.parents[body]
    }

    /// The joint coordinate of a body; none where it is fixed.
    pub fn joint(&self, body: usize) -> Option<usize> {
        self.joints[body]
    }

    /// Whether a body slides on the one that carries it.
    pub fn slides(&self, body: usize) -> bool {
        self.slides[body]
    }

    /// The bodies from the one on the base to this one.
    pub fn way_from_base(&self, body: usize) -> Vec<usize> {
        let mut way: Vec<usize> =
            std::iter::successors(Some(body), |&body| self.parents[body]).collect();
        way.reverse();
        way
    }

    /// Those of them whose joints move.
    pub fn moving(&self, body: usize) -> Vec<usize> {
        self.way_from_base(body).into_iter().filter(|&body| self.joints[body].is_some()).collect()
    }

    /// All bodies, every one after the one that carries it.
    pub fn outward(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.parents.len()).collect();
        order.sort_by_key(|&body| self.way_from_base(body).len());
        order
    }
}
