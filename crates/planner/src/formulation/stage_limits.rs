//! Limits that are stated within the steps too, where the nodes alone let a motion pass them.
//!
//! Over a step of length Δt the joints' acceleration is held, so their angles are
//!
//! ```text
//! q(s) = q_k + s q̇_k + s²/2 u_k,   0 ≤ s ≤ Δt,
//! ```
//!
//! a quadratic Bézier curve with the control points q_k, q_k + Δt/2 q̇_k and q_{k+1}. It lies in their
//! hull: with the angles of the nodes within their limits, the middle point's being so is enough, and is
//! linear. It asks for up to Δt²/8 |u| more than is needed. So a long step is taken as m curves, one after
//! the other, with the middle points q(s) + Δt/2m q̇(s) at s = 0, Δt/m, …; these ask for 1/m² of that.
//! Where the jerk is held instead, the curves are cubic, with two middle points a third of Δt/m from the ends
//! of each, and the rates are the quadratic ones, with q̇(s) + Δt/2m q̈(s) in the middle.
//!
//! Distances and angles from cones are stated at places within the step, which x_k and u_k decide alone: the
//! posture exactly, the attitude by one Runge–Kutta step to there. So are loads, which have no other place: see
//! [`Loads`].

use std::collections::BTreeMap;

use righting_ocp::{ComponentBounds, Expr};
use righting_scenario::JointLimits;

use super::{Clearances, Cones, Coordinates, Loads, joined};

/// By how much more than needed a joint may be kept from its limit, rad …
const MOST_TOO_MUCH_RAD: f64 = 2e-3;
/// … if so many curves a step are enough for that.
const MOST_CURVES: usize = 4;

/// The joints, clearances, cones and loads whose limits are stated within the steps.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StageLimits {
    /// Joints, counted from zero, and the number of curves that each of their steps is taken as.
    pub(crate) joints: BTreeMap<usize, usize>,
    /// Clearances, by their place among those that the joints decide, and the number of equal parts of
    /// a step between which each is stated.
    pub(crate) clearances: BTreeMap<usize, usize>,
    /// Cones, by their place in the scenario, and the number of equal parts of a step between which each is
    /// stated.
    pub(crate) cones: BTreeMap<usize, usize>,
    /// The number of equal parts of a step at whose ends loads are stated.
    pub(crate) load_parts: usize,
}

impl StageLimits {
    /// Those of a problem as it is asked: loads at both ends of every step.
    pub(crate) fn asked() -> Self {
        Self {
            joints: BTreeMap::new(),
            clearances: BTreeMap::new(),
            cones: BTreeMap::new(),
            load_parts: 1,
        }
    }

    /// Whether none is stated beyond those asked.
    pub(crate) fn is_as_asked(&self) -> bool {
        *self == Self::asked()
    }

    /// How many curves a step of length `h` of a joint is taken as.
    pub(crate) fn curves(limits: &JointLimits, h: f64) -> usize {
        let too_much = limits.acceleration_max_rad_s2 * h * h / 8.0;
        ((too_much / MOST_TOO_MUCH_RAD).sqrt().ceil() as usize).clamp(1, MOST_CURVES)
    }

    /// Bounds of [`Self::values`].
    pub(super) fn bounds(
        &self,
        coordinates: &Coordinates,
        joint_limits: &[JointLimits],
        (clearances, loads, cones): (&Clearances, &Loads, &Cones),
    ) -> ComponentBounds {
        let (mut lower, mut upper) = (Vec::new(), Vec::new());
        for (&joint, &curves) in &self.joints {
            let JointLimits { angle_min_rad, angle_max_rad, rate_max_rad_s, .. } =
                joint_limits[joint];
            for _ in 0..curves {
                if coordinates.has_jerk() {
                    lower.extend([angle_min_rad, angle_min_rad, -rate_max_rad_s]);
                    upper.extend([angle_max_rad, angle_max_rad, rate_max_rad_s]);
                } else {
                    lower.push(angle_min_rad);
                    upper.push(angle_max_rad);
                }
            }
        }
        for (&clearance, &parts) in &self.clearances {
            for _ in 1..parts {
                lower.push(clearances.least(clearance));
                upper.push(f64::INFINITY);
            }
        }
        for (&cone, &parts) in &self.cones {
            for _ in 1..parts {
                let (least, most) = cones.bounds_of(cone);
                lower.push(least);
                upper.push(most);
            }
        }
        joined(ComponentBounds::new(lower, upper), loads.bounds(self.load_parts))
    }

    /// The middle control points of the joints' curves, then the distances, then the cosines of the
    /// angles from cones, then the loads within a step of length `h`.
    pub(super) fn values(
        &self,
        coordinates: &Coordinates,
        (clearances, loads, cones): (&Clearances, &Loads, &Cones),
        (x, u): (&[Expr], &[Expr]),
        h: Expr,
    ) -> Vec<Expr> {
        let mut values = Vec::new();
        for (&joint, &curves) in &self.joints {
            let share = 1.0 / curves as f64;
            for curve in 0..curves {
                let at = |place: f64| {
                    let s = h * (place * share);
                    let angle = coordinates.joint_angles_within(x, u, s)[joint];
                    (angle, coordinates.joint_rates_within(x, u, s)[joint])
                };
                let (angle, rate) = at(curve as f64);
                if coordinates.has_jerk() {
                    let third = h * (share / 3.0);
                    let (end, end_rate) = at((curve + 1) as f64);
                    let middle_rate = at(curve as f64 + 0.5).1 * 2.0 - (rate + end_rate) * 0.5;
                    values.extend([angle + third * rate, end - third * end_rate, middle_rate]);
                } else {
                    values.push(angle + h * (0.5 * share) * rate);
                }
            }
        }
        for (&clearance, &parts) in &self.clearances {
            for part in 1..parts {
                let s = h * (part as f64 / parts as f64);
                let posture = coordinates.joint_angles_within(x, u, s);
                values.push(clearances.distance(&posture, clearance));
            }
        }
        for (&cone, &parts) in &self.cones {
            for part in 1..parts {
                let there = coordinates.moved_on(x, u, h * (part as f64 / parts as f64));
                values.push(cones.cosine(coordinates, &there, cone));
            }
        }
        values.extend(loads.values(coordinates, (x, u), h, self.load_parts));
        values
    }
}
