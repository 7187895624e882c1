//! Which links keep how far from the base and from each other.

use nalgebra::Vector3;
use righting_multibody::Kinematics;

use crate::error::Error;
use crate::halton::Halton;
use crate::json::Location;
use crate::system_description::SystemDescription;

/// How far inside its clearance a maneuver may start: rounding only.
const ROUNDING_M: f64 = 1e-9;

/// Arm configurations tried to see whether an exempt link can leave the keep-out sphere.
const SAMPLES: usize = 2000;

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
    /// Pairs of links that keep away from each other: those that share no joint, counted from zero,
    /// inboard link first.
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
        let links = system.model.links();
        let bodies: Vec<usize> =
            (0..links.len()).filter(|&link| links[link].length_m() > 0.0).collect();
        let link_pairs = bodies
            .iter()
            .flat_map(|&a| bodies.iter().map(move |&b| (a, b)))
            .filter(|&(a, b)| a < b && !system.model.links_meet(a, b))
            .collect();
        Self {
            clearance_m,
            body_distance_m: system.keep_out_radius_m + clearance_m,
            body_links: bodies.into_iter().filter(|&link| !system.body_exempt[link]).collect(),
            link_pairs,
        }
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

    /// Refuses a start with a link too close to something.
    pub(crate) fn check_start(
        &self,
        system: &SystemDescription,
        joint_angles_rad: &[f64],
        place: &Location,
    ) -> Result<(), Error> {
        let posture = system.model.kinematics(joint_angles_rad);
        let collision = self
            .clearances(&posture)
            .find(|clearance| clearance.distance_m < clearance.least_m - ROUNDING_M);
        let Some(Clearance { between, distance_m, least_m }) = collision else { return Ok(()) };
        let (value, allowed) = match between {
            Between::Links(a, b) => (
                format!("a start with links {} and {} {distance_m:.4} m apart", a + 1, b + 1),
                format!("at least the clearance, {least_m} m"),
            ),
            Between::LinkAndBody(link) => (
                format!(
                    "a start with link {} {distance_m:.4} m from the base's center of mass",
                    link + 1
                ),
                format!(
                    "at least {least_m:.4} m, keep-out radius and clearance (if link {} is part of \
                     the mount, set its body_exempt)",
                    link + 1
                ),
            ),
        };
        Err(place.refuse(value, allowed))
    }

    /// Refuses an exemption of a link that can be outside the keep-out sphere: only one that is
    /// always inside is part of the mount.
    pub(crate) fn check_exemptions(
        &self,
        system: &SystemDescription,
        joint_angles_rad: &[f64],
        links: &Location,
    ) -> Result<(), Error> {
        let model = &system.model;
        let exempt: Vec<usize> = (0..system.joint_count())
            .filter(|&link| system.body_exempt[link] && model.links()[link].length_m() > 0.0)
            .collect();
        if exempt.is_empty() {
            return Ok(());
        }
        let mut farthest = vec![0.0_f64; system.joint_count()];
        let mut look = |joint_angles_rad: &[f64]| {
            let posture = model.kinematics(joint_angles_rad);
            for &link in &exempt {
                farthest[link] = farthest[link].max(distance_to_body(&posture, link));
            }
        };
        look(joint_angles_rad);
        for sample in Halton::new(system.joint_count()).take(SAMPLES) {
            look(&system.joint_angles_at(&sample));
        }
        for link in exempt {
            if farthest[link] >= self.body_distance_m {
                let allowed = format!(
                    "false: link {} can be {:.4} m from the base's center of mass, outside the \
                     keep-out sphere with its clearance, {:.4} m",
                    link + 1,
                    farthest[link],
                    self.body_distance_m
                );
                return Err(links.index(link).key("body_exempt").refuse(true, allowed));
            }
        }
        Ok(())
    }
}

fn distance_to_body(posture: &Kinematics<f64>, link: usize) -> f64 {
    posture.segments[link].distance_to_point(&Vector3::zeros())
}
