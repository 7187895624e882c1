//! What keeps how far from what.

use std::fmt;

use nalgebra::Vector3;
use righting_multibody::{Kinematics, Segment};

use crate::bodies::{ArmPart, KeepOut, NO_LENGTH, Piece, Solid};
use crate::system_description::SystemDescription;

/// The clearances of a system.
#[derive(Clone, Debug, PartialEq)]
pub struct CollisionModel {
    /// Smallest distance of the arm's solids from what the base keeps out and from each other d_min, m.
    pub clearance_m: f64,
    /// What keeps apart: solids of the arm from the keep-out sphere, then from the shapes of the base one
    /// after the other, then from each other.
    pub pairs: Vec<Pair>,
}

/// Two things that keep apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Between what.
    pub between: Between,
    /// The solid of the arm; of two the one farther out.
    pub solid: Solid,
    /// What it keeps away from.
    pub other: Other,
    /// The least distance that is allowed, m: the clearance, and from the keep-out sphere, whose center the
    /// distance is measured from, its radius and the clearance.
    pub least_m: f64,
}

/// What a solid of the arm keeps away from.
#[derive(Clone, Debug, PartialEq)]
pub enum Other {
    /// The origin of the body frame, for the keep-out sphere.
    Center,
    /// Something of the base.
    KeepOut(KeepOut),
    /// A solid farther in.
    Solid(Solid),
}

/// One distance that a system keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Between what.
    pub between: Between,
    /// The distance of the surfaces, m, negative where they cross; from the keep-out sphere that of the
    /// solid's surface from the origin of the body frame.
    pub distance_m: f64,
    /// The least that is allowed, m.
    pub least_m: f64,
}

/// The two things a clearance is between. Displayed counted from one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// A piece of the arm and the keep-out sphere.
    Body(Piece),
    /// A piece of the arm and a shape of the base, by its place in `base.keep_out`.
    KeepOut(Piece, usize),
    /// Two pieces of the arm, the inboard one first.
    Pieces(Piece, Piece),
}

impl Between {
    /// Two links along their segments, counted from zero, the inboard one first.
    pub fn links(inboard: usize, outboard: usize) -> Self {
        Self::Pieces(Piece::link(inboard), Piece::link(outboard))
    }

    /// The piece of the arm that keeps away from the base; none for two pieces of the arm.
    pub fn off_base(&self) -> Option<Piece> {
        match *self {
            Self::Body(piece) | Self::KeepOut(piece, _) => Some(piece),
            Self::Pieces(..) => None,
        }
    }

    /// Whether a shape or a payload has part in it, and not only links along their segments and the sphere.
    pub(crate) fn is_of_shapes(&self) -> bool {
        let is_shape = |piece: &Piece| piece.shape.is_some() || piece.part == ArmPart::Payload;
        match self {
            Self::Body(piece) => is_shape(piece),
            Self::KeepOut(..) => true,
            Self::Pieces(a, b) => is_shape(a) || is_shape(b),
        }
    }
}

impl fmt::Display for Between {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use ArmPart::Link;
        match self {
            Self::Body(piece) => write!(f, "{piece} and body"),
            Self::KeepOut(piece, k) => write!(f, "{piece} and keep-out {}", k + 1),
            Self::Pieces(
                Piece { part: Link(a), shape: None },
                Piece { part: Link(b), shape: None },
            ) => write!(f, "links {} and {}", a + 1, b + 1),
            Self::Pieces(a, b) => write!(f, "{a} and {b}"),
        }
    }
}

impl Pair {
    /// The part of the distance of the cores that the radii of capsules take, m.
    pub fn covered_m(&self) -> f64 {
        self.solid.radius_m
            + match &self.other {
                Other::KeepOut(KeepOut::Capsule { radius_m, .. }) => *radius_m,
                Other::Solid(solid) => solid.radius_m,
                Other::Center | Other::KeepOut(KeepOut::Cuboid(_)) => 0.0,
            }
    }

    /// The least distance of the cores that is allowed, m: radii and all.
    pub fn least_of_cores_m(&self) -> f64 {
        self.least_m + self.covered_m()
    }

    /// The distance in an arm posture.
    pub fn clearance(&self, posture: &Kinematics<f64>) -> Clearance {
        let core = posture.core(&self.solid.core);
        let of_cores_m = match &self.other {
            Other::Center => core.distance_to_point(&Vector3::zeros()),
            Other::KeepOut(KeepOut::Capsule { ends_m: [from_m, to_m], .. }) => {
                core.distance_to_segment(&Segment::new(*from_m, *to_m))
            }
            Other::KeepOut(KeepOut::Cuboid(cuboid)) => cuboid.signed_distance(&core),
            Other::Solid(inboard) => posture.core(&inboard.core).distance_to_segment(&core),
        };
        let distance_m = of_cores_m - self.covered_m();
        Clearance { between: self.between, distance_m, least_m: self.least_m }
    }
}

impl CollisionModel {
    /// The clearances of a system.
    ///
    /// Two capsules along the arm's own line keep apart if they can: if the arm between them is longer than
    /// what they have to keep. Links with no more than that between them share a joint. Shapes that are
    /// given are anywhere: those keep apart unless their parts share a joint.
    pub fn new(system: &SystemDescription, clearance_m: f64) -> Self {
        let is_kept =
            |pair: &Pair| !system.ignored_pairs.iter().any(|named| pair.between.is_named(named));
        let mut pairs = base_pairs(system, clearance_m, |solid| !is_exempt(system, solid));
        pairs.extend(
            arm_pairs(system, clearance_m)
                .filter(|(pair, between_m)| *between_m > farthest_neighbors_m(system, pair))
                .map(|(pair, _)| pair),
        );
        pairs.retain(is_kept);
        Self { clearance_m, pairs }
    }

    /// Links along the arm's own line that keep no clearance though there is an arm between them, since
    /// that is no longer than what they would have to keep; with its length, m.
    pub(crate) fn neighbors_across_links(&self, system: &SystemDescription) -> Vec<(Between, f64)> {
        let rounding_m = NO_LENGTH * system.model.length_m();
        arm_pairs(system, self.clearance_m)
            .filter(|(pair, between_m)| {
                *between_m > rounding_m && *between_m <= farthest_neighbors_m(system, pair)
            })
            .map(|(pair, between_m)| (pair.between, between_m))
            .collect()
    }

    /// Every clearance of an arm posture, in a fixed order.
    pub fn clearances<'a>(
        &'a self,
        posture: &'a Kinematics<f64>,
    ) -> impl Iterator<Item = Clearance> + 'a {
        self.pairs.iter().map(|pair| pair.clearance(posture))
    }
}

/// Solids of the arm that are chosen, and everything of the base.
pub(crate) fn base_pairs(
    system: &SystemDescription,
    clearance_m: f64,
    is_chosen: impl Fn(&Solid) -> bool,
) -> Vec<Pair> {
    let solids = || system.solids.iter().filter(|solid| is_chosen(solid));
    let sphere = system.keep_out_radius_m.into_iter().flat_map(|radius_m| {
        solids().map(move |solid| Pair {
            between: Between::Body(solid.piece),
            solid: solid.clone(),
            other: Other::Center,
            least_m: radius_m + clearance_m,
        })
    });
    let shapes = system.keep_out.iter().enumerate().flat_map(|(k, shape)| {
        solids().map(move |solid| Pair {
            between: Between::KeepOut(solid.piece, k),
            solid: solid.clone(),
            other: Other::KeepOut(shape.clone()),
            least_m: clearance_m,
        })
    });
    sphere.chain(shapes).collect()
}

/// Every two solids of different parts of the arm, with the length of the arm between these, m.
fn arm_pairs(
    system: &SystemDescription,
    clearance_m: f64,
) -> impl Iterator<Item = (Pair, f64)> + '_ {
    let place = |solid: &Solid| match solid.piece.part {
        ArmPart::Link(place) | ArmPart::Body(place) => place,
        ArmPart::Payload => system.model.part_count(),
    };
    system.solids.iter().flat_map(move |inboard| {
        let farther_out = system.solids.iter().filter(move |solid| place(solid) > place(inboard));
        farther_out.map(move |outboard| {
            let between_m = system.model.length_between_m(place(inboard), place(outboard));
            let pair = Pair {
                between: Between::Pieces(inboard.piece, outboard.piece),
                solid: outboard.clone(),
                other: Other::Solid(inboard.clone()),
                least_m: clearance_m,
            };
            (pair, between_m)
        })
    })
}

/// The longest arm between two solids that keep no clearance, m.
fn farthest_neighbors_m(system: &SystemDescription, pair: &Pair) -> f64 {
    let rounding_m = NO_LENGTH * system.model.length_m();
    match &pair.between {
        Between::Pieces(Piece { shape: None, .. }, Piece { shape: None, .. }) => {
            pair.least_of_cores_m().max(rounding_m)
        }
        _ => rounding_m,
    }
}

/// Whether a solid is of a link that may be inside what the base keeps out.
pub(crate) fn is_exempt(system: &SystemDescription, solid: &Solid) -> bool {
    match solid.piece.part {
        ArmPart::Link(link) => system.body_exempt[link],
        // What no joint moves is a part of the base.
        ArmPart::Body(body) => {
            system.body_exempt[body] || system.model.joints_moving(&solid.core).is_empty()
        }
        ArmPart::Payload => false,
    }
}
