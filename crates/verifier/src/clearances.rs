//! The distances that are kept, from the system file.

use nalgebra::Vector3;
use righting_scenario::bodies::ArmPart;
use righting_scenario::collision::Between;
use righting_scenario::file;
use righting_scenario::ignored_pairs::Named;

use crate::bodies::{Fixed, ROUNDING, Solid, solids};
use crate::ledger::{Subject, Worst};
use crate::lineage::Lineage;
use crate::model::{Cuboid, Model, Pose, Segment};

/// Which solids of the arm keep how far from the base and from each other.
///
/// Two links along their segments, of which the arm between is no longer than what they have to keep, can
/// never be that far apart: they share a joint. So it is with a payload that is a sphere. Shapes that are
/// given keep apart unless their parts share a joint.
#[derive(Clone, Debug)]
pub(super) struct Clearances {
    pub solids: Vec<Solid>,
    pairs: Vec<Pair>,
}

/// Two things that keep apart.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    pub between: Between,
    /// Place among the solids of the one that is farther out.
    pub outer: usize,
    pub inner: Inner,
    /// What radii take of the distance between the segments, m.
    covered_m: f64,
    /// Least distance, m: between surfaces, or of one from the origin of the body frame.
    pub least_m: f64,
}

/// What a solid of the arm keeps away from.
#[derive(Clone, Debug)]
pub(super) enum Inner {
    /// A segment of the base, or the origin of the body frame as one.
    Segment(Segment),
    /// A box of the base.
    Cuboid(Cuboid),
    /// Another solid, by its place among them.
    Solid(usize),
}

/// The two things of a pair in a posture, without their radii.
#[derive(Clone, Copy, Debug)]
pub(super) struct Situation {
    inner: Shape,
    outer: Segment,
    covered_m: f64,
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    Segment(Segment),
    Cuboid(Cuboid),
}

impl Clearances {
    pub fn new(system: &file::System, model: &Model, clearance_m: f64) -> Self {
        let solids = solids(system);
        let named: Vec<[Named; 2]> = system
            .ignored_pairs
            .iter()
            .flatten()
            .filter_map(|[a, b]| Some([Named::parse(a)?, Named::parse(b)?]))
            .collect();
        let mut pairs = base_pairs(system, &solids, clearance_m);
        match &system.bodies {
            Some(_) => pairs.extend(pairs_of_bodies(system, model, &solids, clearance_m)),
            None => pairs.extend(pairs_of_links(system, &solids, clearance_m)),
        }
        pairs.retain(|pair| !named.iter().any(|names| pair.between.is_named(names)));
        Self { solids, pairs }
    }

    /// Every distance that is kept.
    pub fn all(&self) -> &[Pair] {
        &self.pairs
    }

    /// Whether no distance is kept.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// A pair where the arm's frames are these, in body axes.
    pub fn situation(&self, pair: &Pair, frames: &[Pose]) -> Situation {
        let inner = match &pair.inner {
            Inner::Segment(segment) => Shape::Segment(*segment),
            Inner::Cuboid(cuboid) => Shape::Cuboid(*cuboid),
            Inner::Solid(inboard) => Shape::Segment(self.solids[*inboard].segment(frames)),
        };
        let outer = self.solids[pair.outer].segment(frames);
        Situation { inner, outer, covered_m: pair.covered_m }
    }

    /// Looks at every distance in a posture of the arm, given by its frames in body axes: `body` and
    /// `links` are the worst places so far.
    pub fn look(&self, frames: &[Pose], time_s: f64, body: &mut Worst, links: &mut Worst) {
        for pair in &self.pairs {
            let worst = if pair.is_with_base() { &mut *body } else { &mut *links };
            let distance_m = self.situation(pair, frames).distance_m();
            let subject = Some(Subject::Clearance(pair.between));
            worst.at_least(distance_m, pair.least_m, subject, Some(time_s));
        }
    }
}

impl Pair {
    /// Whether one of the two is the base.
    pub fn is_with_base(&self) -> bool {
        self.between.off_base().is_some()
    }
}

impl Situation {
    /// Distance of the surfaces, m; where segments or box and segment meet, minus the radii.
    pub fn distance_m(&self) -> f64 {
        let of_axes_m = match &self.inner {
            Shape::Segment(inner) if inner.start == inner.end => {
                self.outer.distance_to_point(&inner.start)
            }
            Shape::Segment(inner) => inner.distance_to_segment(&self.outer),
            Shape::Cuboid(cuboid) => cuboid.shortest_to_segment(&self.outer).norm(),
        };
        of_axes_m - self.covered_m
    }

    /// What the distance of the surfaces never falls below, m: segments and boxes that meet are at zero.
    pub fn least_m(&self) -> f64 {
        -self.covered_m
    }

    /// The direction from the inner thing to the outer one where they are nearest; none where they meet.
    pub fn direction(&self) -> Option<Vector3<f64>> {
        let way = match &self.inner {
            Shape::Segment(inner) => inner.shortest_to_segment(&self.outer),
            Shape::Cuboid(cuboid) => cuboid.shortest_to_segment(&self.outer),
        };
        way.try_normalize(0.0)
    }

    /// How far the outer thing lies beyond the inner one along a direction, m; negative where it does not.
    pub fn gap_m(&self, direction: &Vector3<f64>) -> f64 {
        let of_segment = |segment: &Segment| {
            let (start, end) = (segment.start.dot(direction), segment.end.dot(direction));
            [start.min(end), start.max(end)]
        };
        let [_, top] = match &self.inner {
            Shape::Segment(inner) => of_segment(inner),
            Shape::Cuboid(cuboid) => cuboid.extent(direction),
        };
        let [bottom, _] = of_segment(&self.outer);
        bottom - top - self.covered_m
    }
}

/// Pairs with the base: the keep-out sphere's first, then those of one shape after the other.
fn base_pairs(system: &file::System, solids: &[Solid], clearance_m: f64) -> Vec<Pair> {
    let base = &system.base;
    let lineage = Lineage::new(system);
    let kept: Vec<usize> = (0..solids.len())
        .filter(|&solid| match solids[solid].piece.part {
            ArmPart::Link(link) => !system.links[link].body_exempt,
            // What no joint moves is a part of the base.
            ArmPart::Body(body) => {
                let is_exempt = system.bodies.as_ref().is_some_and(|all| all[body].body_exempt);
                !is_exempt && !lineage.moving(body).is_empty()
            }
            ArmPart::Payload => true,
        })
        .collect();
    let mut pairs = Vec::new();
    // Half the space diagonal of a cube, if nothing else is said.
    let circumscribed_m = |side_m: f64| Vector3::repeat(side_m / 2.0).norm();
    let of_cube_m = base.cube_side_m.filter(|_| base.keep_out.is_none()).map(circumscribed_m);
    if let Some(radius_m) = base.keep_out_radius_m.or(of_cube_m) {
        let center = Segment { start: Vector3::zeros(), end: Vector3::zeros() };
        pairs.extend(kept.iter().map(|&outer| Pair {
            between: Between::Body(solids[outer].piece),
            outer,
            inner: Inner::Segment(center),
            covered_m: solids[outer].radius_m,
            least_m: radius_m + clearance_m,
        }));
    }
    for (place, shape) in base.keep_out.iter().flatten().enumerate() {
        let (inner, radius_m) = match Fixed::new(shape) {
            Some(Fixed::Capsule(segment, radius_m)) => (Inner::Segment(segment), radius_m),
            Some(Fixed::Cuboid(cuboid)) => (Inner::Cuboid(cuboid), 0.0),
            None => continue,
        };
        pairs.extend(kept.iter().map(|&outer| Pair {
            between: Between::KeepOut(solids[outer].piece, place),
            outer,
            inner: inner.clone(),
            covered_m: solids[outer].radius_m + radius_m,
            least_m: clearance_m,
        }));
    }
    pairs
}

/// Pairs of solids of the arm that do not share a joint.
fn pairs_of_links(system: &file::System, solids: &[Solid], clearance_m: f64) -> Vec<Pair> {
    let lengths_m: Vec<f64> = system.links.iter().map(|link| link.a_m.hypot(link.d_m)).collect();
    let rounding_m = ROUNDING * lengths_m.iter().sum::<f64>();
    let place = |solid: &Solid| match solid.piece.part {
        ArmPart::Link(link) => link,
        ArmPart::Body(_) | ArmPart::Payload => lengths_m.len(),
    };
    let mut pairs = Vec::new();
    for (inner, inboard) in solids.iter().enumerate() {
        for (outer, outboard) in solids.iter().enumerate() {
            if place(inboard) >= place(outboard) {
                continue;
            }
            let between_m: f64 = lengths_m[place(inboard) + 1..place(outboard)].iter().sum();
            let covered_m = inboard.radius_m + outboard.radius_m;
            let is_on_line = inboard.piece.shape.is_none() && outboard.piece.shape.is_none();
            let is_apart = !is_on_line || between_m > clearance_m + covered_m;
            if is_apart && between_m > rounding_m {
                pairs.push(Pair {
                    between: Between::Pieces(inboard.piece, outboard.piece),
                    outer,
                    inner: Inner::Solid(inner),
                    covered_m,
                    least_m: clearance_m,
                });
            }
        }
    }
    pairs
}

/// Pairs of solids of bodies that do not share a joint: where the way from one to the other has a length
/// over the joints between them. Seen from the body that two neighbouring joints are on, their distance is
/// the same in every posture.
fn pairs_of_bodies(
    system: &file::System,
    model: &Model,
    solids: &[Solid],
    clearance_m: f64,
) -> Vec<Pair> {
    let lineage = Lineage::new(system);
    let mut frames = vec![Pose::identity(); model.frame_count()];
    model.frames(&vec![0.0; model.joint_count()], &mut frames);
    let rounding_m = ROUNDING * frames.iter().map(|frame| frame.origin.norm()).sum::<f64>();
    let distance_m = |a: usize, b: usize| (frames[a + 1].origin - frames[b + 1].origin).norm();
    let body = |solid: &Solid| match solid.piece.part {
        ArmPart::Body(body) | ArmPart::Link(body) => body,
        ArmPart::Payload => 0,
    };
    let mut pairs = Vec::new();
    for (inner, one) in solids.iter().enumerate() {
        for (outer, other) in solids.iter().enumerate() {
            if body(one) >= body(other) {
                continue;
            }
            let [a, b] = [one, other].map(|solid| lineage.moving(body(solid)));
            let shared = a.iter().zip(&b).take_while(|(a, b)| a == b).count();
            let mut way: Vec<usize> = a[shared..].to_vec();
            way.reverse();
            way.extend(&b[shared..]);
            let between_m: f64 =
                way.windows(2).map(|joints| distance_m(joints[0], joints[1])).sum();
            // A joint between the two slides that neither shares.
            let slides_apart = [&a[shared..], &b[shared..]].into_iter().any(|way| {
                let before_last = &way[..way.len().saturating_sub(1)];
                before_last.iter().any(|&body| lineage.slides(body))
            });
            if slides_apart || between_m > rounding_m {
                pairs.push(Pair {
                    between: Between::Pieces(one.piece, other.piece),
                    outer,
                    inner: Inner::Solid(inner),
                    covered_m: one.radius_m + other.radius_m,
                    least_m: clearance_m,
                });
            }
        }
    }
    pairs
}
