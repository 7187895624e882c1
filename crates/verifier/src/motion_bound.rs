//! How far the arm can move in a stretch of time, from its lengths and the joints' rates alone.
//!
//! With o_j a point on the axis e_j of joint j, a point p of a link that joints 0…b move has
//!
//! ```text
//! ṗ = Σ_j q̇_j e_j × (p − o_j)
//! p̈ = Σ_j q̈_j e_j × (p − o_j) + Σ_ij q̇_i q̇_j e_min × (e_max × (p − o_max))    min, max of i and j
//! ```
//!
//! and |p − o_j| ≤ R_j, the lengths of the links from joint j to the end of that one, or to the frame that p
//! moves with and from there to p. So |ṗ| is at most Σ R_j |q̇_j|, and |p̈| at most Σ R_j |q̈_j| + (Σ |q̇_j|) (Σ R_j |q̇_j|).
//!
//! A joint that slides adds q̇_j e_j to ṗ, and q̈_j e_j + 2 Σ_i q̇_i q̇_j e_i × e_j to p̈, over the joints that
//! turn it: its R_j is 1, it does not count in the sum of the |q̇_j|, and counts twice in what that multiplies.
//! The lengths then hold its farthest travel too.

use nalgebra::Vector3;
use righting_scenario::bodies::ArmPart;
use righting_scenario::file::{self, JointKind, JointType};

use crate::bodies::{Axis, Solid};
use crate::lineage::Lineage;

/// The R_j of every solid.
#[derive(Clone, Debug)]
pub(super) struct Reach {
    /// Of each solid: the joints that move it, from the base outward, and the R_j of each, m.
    of_solids: Vec<Vec<(usize, f64)>>,
    /// Which joints slide.
    slides: Vec<bool>,
}

impl Reach {
    pub fn new(system: &file::System, solids: &[Solid]) -> Self {
        let of_solid = |solid: &Solid| match solid.piece.part {
            ArmPart::Body(body) => of_body(system, body, &solid.axis),
            ArmPart::Link(_) | ArmPart::Payload => of_row(system, &solid.axis),
        };
        let kinds = system.joint_kinds();
        Self {
            of_solids: solids.iter().map(of_solid).collect(),
            slides: kinds.into_iter().map(|kind| kind == JointKind::Prismatic).collect(),
        }
    }
}

fn of_row(system: &file::System, axis: &Axis) -> Vec<(usize, f64)> {
    let lengths_m: Vec<f64> = system.links.iter().map(|link| link.a_m.hypot(link.d_m)).collect();
    // The axis of joint i goes through the inboard end of link i, which it moves, or, by Craig's
    // convention, through its outboard end, and the first link that it moves is the next.
    let first_moved = match system.dh_convention.unwrap_or_default() {
        file::DhConvention::Standard => 0,
        file::DhConvention::Modified => 1,
    };
    let (joints, last, beyond_m) = match axis {
        Axis::Link(link) => (link + 1 - first_moved, link + 1, 0.0),
        Axis::InFrame(frame, ends) => (*frame, *frame, farthest_m(ends)),
    };
    let to_frame = |joint: usize| lengths_m.get(joint + first_moved..last).unwrap_or_default();
    (0..joints).map(|joint| (joint, to_frame(joint).iter().sum::<f64>() + beyond_m)).collect()
}

fn of_body(system: &file::System, body: usize, axis: &Axis) -> Vec<(usize, f64)> {
    let bodies = system.bodies.as_deref().unwrap_or_default();
    let lineage = Lineage::new(system);
    let mut beyond_m = match axis {
        Axis::InFrame(_, ends) => farthest_m(ends),
        Axis::Link(_) => 0.0,
    };
    let mut reach = Vec::new();
    for body in lineage.way_from_base(body).into_iter().rev() {
        let joint = &bodies[body].joint;
        let slides = joint.kind == JointType::Prismatic;
        if slides {
            let ends =
                [joint.travel_min_m, joint.travel_max_m].map(|end| end.map_or(0.0, f64::abs));
            beyond_m += ends[0].max(ends[1]);
        }
        let farthest = if slides { 1.0 } else { beyond_m };
        reach.extend(lineage.joint(body).map(|joint| (joint, farthest)));
        beyond_m += Vector3::from(joint.position_m.unwrap_or_default()).norm();
    }
    reach.reverse();
    reach
}

fn farthest_m([start, end]: &[Vector3<f64>; 2]) -> f64 {
    start.norm().max(end.norm())
}

/// The joints' motion over a stretch of time.
pub(super) struct Stretch<'a> {
    pub reach: &'a Reach,
    /// Largest magnitude of each joint's rate, rad/s.
    pub rates: &'a [f64],
    /// Largest magnitude of each joint's acceleration, rad/s².
    pub accelerations: &'a [f64],
    pub duration_s: f64,
}

impl Stretch<'_> {
    /// The most that a point of a solid moves as seen from another one, or from the base, m: seen from what
    /// carries both, the sum of what the two move.
    pub fn travel_m(&self, solid: usize, seen_from: Option<usize>) -> f64 {
        let solid = &self.reach.of_solids[solid];
        let other = seen_from.map_or(&[][..], |other| &self.reach.of_solids[other]);
        let shared = solid.iter().zip(other).take_while(|(a, b)| a.0 == b.0).count();
        let apart = solid[shared..].iter().chain(&other[shared..]);
        self.duration_s * apart.map(|(joint, reach_m)| self.rates[*joint] * reach_m).sum::<f64>()
    }

    /// The most that a point of a solid is off the straight way between where it is at the beginning and
    /// at the end, gone at constant speed, as seen from the base, m: the error of linear interpolation,
    /// max |p̈| Δt²/8.
    pub fn bend_m(&self, solid: usize) -> f64 {
        let reach = &self.reach.of_solids[solid];
        let (mut acceleration, mut turning, mut moving) = (0.0, 0.0, 0.0);
        for (joint, reach_m) in reach {
            let moved = self.rates[*joint] * reach_m;
            acceleration += self.accelerations[*joint] * reach_m;
            match self.reach.slides[*joint] {
                true => moving += 2.0 * moved,
                false => {
                    turning += self.rates[*joint];
                    moving += moved;
                }
            }
        }
        acceleration += turning * moving;
        acceleration * self.duration_s.powi(2) / 8.0
    }
}
