//! Which links keep how far from the base and from each other.

use nalgebra::Vector3;
use righting_multibody::{Kinematics, System};

use crate::system_description::SystemDescription;

/// A link shorter than this part of its arm has no length: rounding of what is meant as zero.
const NO_LENGTH: f64 = 1e-9;

/// The clearances of a system's links. A link is the straight segment between its two origins; one
/// without length collides with nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct CollisionModel {
    /// Smallest distance of links from the keep-out sphere and from each other d_min, m.
    pub clearance_m: f64,
    /// Smallest distance of links from the base's center of mass R_body + d_min, m.
    pub body_distance_m: f64,
    /// Links that keep away from the base, counted from zero.
    pub body_links: Vec<usize>,
    /// Pairs of links that keep away from each other, counted from zero, inboard link first: those
    /// that can be as far apart as the clearance. Links with no more than the clearance between them
    /// along the arm share a joint.
    pub link_pairs: Vec<(usize, usize)>,
}

/// One distance that a system keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Between what, links counted from zero.
    pub between: Between,
    /// The distance, m.
    pub distance_m: f64,
    /// The least that is allowed, m.
    pub least_m: f64,
}

/// The two things a clearance is between. Displayed with links counted from one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// A link and the base.
    LinkAndBody(usize),
    /// Two links, the inboard one first.
    Links(usize, usize),
}

impl std::fmt::Display for Between {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::LinkAndBody(link) => write!(f, "link {} and body", link + 1),
            Self::Links(a, b) => write!(f, "links {} and {}", a + 1, b + 1),
        }
    }
}

impl CollisionModel {
    /// The clearances of a system.
    pub fn new(system: &SystemDescription, clearance_m: f64) -> Self {
        let model = &system.model;
        let bodies: Vec<usize> =
            (0..model.joint_count()).filter(|&link| has_length(model, link)).collect();
        let farthest_neighbors_m = clearance_m.max(NO_LENGTH * model.length_m());
        let link_pairs = bodies
            .iter()
            .flat_map(|&a| bodies.iter().map(move |&b| (a, b)))
            .filter(|&(a, b)| a < b && model.length_between_m(a, b) > farthest_neighbors_m)
            .collect();
        Self {
            clearance_m,
            body_distance_m: system.keep_out_radius_m + clearance_m,
            body_links: bodies.into_iter().filter(|&link| !system.body_exempt[link]).collect(),
            link_pairs,
        }
    }

    /// Pairs of links that keep no clearance though there is an arm between them, since that is no
    /// longer than the clearance; with its length, m.
    pub(crate) fn neighbors_across_links(&self, system: &System) -> Vec<(usize, usize, f64)> {
        let bodies = (0..system.joint_count()).filter(|&link| has_length(system, link));
        let bodies: Vec<usize> = bodies.collect();
        let pairs = bodies.iter().flat_map(|&a| bodies.iter().map(move |&b| (a, b)));
        pairs
            .filter(|&(a, b)| a < b && !self.link_pairs.contains(&(a, b)))
            .map(|(a, b)| (a, b, system.length_between_m(a, b)))
            .filter(|&(.., between_m)| between_m > NO_LENGTH * system.length_m())
            .collect()
    }

    /// Every clearance of an arm posture, in a fixed order.
    pub fn clearances<'a>(
        &'a self,
        posture: &'a Kinematics<f64>,
    ) -> impl Iterator<Item = Clearance> + 'a {
        let body = self.body_links.iter().map(|&link| Clearance {
            between: Between::LinkAndBody(link),
            distance_m: distance_to_body(posture, link),
            least_m: self.body_distance_m,
        });
        let links = self.link_pairs.iter().map(|&(a, b)| Clearance {
            between: Between::Links(a, b),
            distance_m: posture.segments[a].distance_to_segment(&posture.segments[b]),
            least_m: self.clearance_m,
        });
        body.chain(links)
    }
}

/// Whether a link collides at all.
pub(crate) fn has_length(model: &System, link: usize) -> bool {
    model.links()[link].length_m() > NO_LENGTH * model.length_m()
}

/// Distance of a link from the base's center of mass, m.
pub(crate) fn distance_to_body(posture: &Kinematics<f64>, link: usize) -> f64 {
    posture.segments[link].distance_to_point(&Vector3::zeros())
}
