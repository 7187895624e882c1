//! How fast an arm turns its base.

use nalgebra::{Matrix3, Vector3};
use righting_scenario::SystemDescription;

use super::motions::{Motions, Turn};
use super::turnable::{TurnableAxes, principal};
use crate::hull::{Mesh, convex_hull};

/// How many loops, and how many straight motions, are looked at.
const LOOPS: usize = 240;
const SWINGS: usize = 240;
/// A direction counts when loops turn the base so far about it, relative to the direction they turn it most
/// about.
const RELATIVE: f64 = 1e-6;
/// A component of an axis that is smaller does not count, as a slew may miss its target by as much.
const NEGLIGIBLE: f64 = 1e-3;

/// Turn rates of the base about three principal axes: the semi-axes of an ellipsoid.
#[derive(Clone, Debug, PartialEq)]
pub struct TurnRates {
    /// Unit vectors, body axes: loops turn the base farthest about the first.
    pub principal_axes: [Vector3<f64>; 3],
    /// How far a loop turns the base about each of them, root mean square, rad.
    pub turns_rad: [f64; 3],
    /// How fast the best mixture of loops turns the base about each of them, rad/s.
    pub rates_rad_s: [f64; 3],
    /// How long the slowest joint takes to its largest rate, s.
    pub run_up_s: f64,
    /// How many loops were looked at.
    pub loops: usize,
    /// Straight motions from the start.
    swings: Vec<Turn>,
    /// The convex hull of their rates.
    swing_rates: Mesh,
}

impl TurnRates {
    /// Of motions from the posture `start_rad` (one angle a joint, rad) within the joints' limits.
    ///
    /// # Panics
    /// `start_rad` does not have one angle a joint.
    pub fn new(system: &SystemDescription, start_rad: &[f64]) -> Self {
        let joints = TurnableAxes::new(system).effective_joints;
        let motions = Motions { system, start: start_rad, joints: &joints };
        let loops = motions.loops(LOOPS);
        let swings = motions.swings(SWINGS);
        let count = loops.len().max(1) as f64;
        let products = loops.iter().map(|l| l.turn_rad * l.turn_rad.transpose());
        let spread = products.sum::<Matrix3<f64>>() / count;
        let (principal_axes, turns_rad) = principal(&spread);
        let counts = |turn: f64| turn > 0.0 && turn > RELATIVE * turns_rad[0];
        // Every loop can be gone round either way.
        let rates: Vec<Vector3<f64>> =
            loops.iter().flat_map(|l| [1.0, -1.0].map(|way| l.rate_rad_s() * way)).collect();
        let rates_rad_s = if turns_rad.into_iter().all(counts) {
            let hull = convex_hull(&rates);
            principal_axes.map(|axis| mixture(&hull, &axis).map_or(0.0, |found| found.rate_rad_s))
        } else {
            [0, 1, 2].map(|k| match counts(turns_rad[k]) {
                true => rates.iter().map(|rate| rate.dot(&principal_axes[k])).fold(0.0, f64::max),
                false => 0.0,
            })
        };
        let limits = joints.iter().map(|&joint| &system.joint_limits[joint]);
        let run_ups = limits.map(|limits| limits.rate_max_rad_s / limits.acceleration_max_rad_s2);
        let swing_rates: Vec<_> = swings.iter().map(Turn::rate_rad_s).collect();
        Self {
            principal_axes,
            turns_rad,
            rates_rad_s,
            run_up_s: run_ups.fold(0.0, f64::max),
            loops: loops.len(),
            swing_rates: convex_hull(&swing_rates),
            swings,
        }
    }

    /// The ellipsoid's semi-axes, body axes, deg/s.
    pub fn semi_axes_deg_s(&self) -> [Vector3<f64>; 3] {
        [0, 1, 2].map(|k| self.principal_axes[k] * self.rates_rad_s[k].to_degrees())
    }

    /// The ellipsoid's radius along a unit vector (body axes): how fast loops turn the base about it, rad/s.
    pub fn about(&self, axis: &Vector3<f64>) -> f64 {
        let terms = self.principal_axes.iter().zip(self.rates_rad_s).map(|(principal, rate)| {
            match axis.dot(principal).abs() {
                component if component <= NEGLIGIBLE => 0.0,
                component => (component / rate).powi(2),
            }
        });
        1.0 / terms.sum::<f64>().sqrt()
    }

    /// A first estimate of the time that a turn by `angle_rad` about a unit vector (body axes) takes, rest
    /// to rest, s; none if neither loops nor straight motions turn the base about it.
    ///
    /// A slew's arm may end anywhere. So it first swings, in the best mixture of straight motions, as far as
    /// its joints go, and turns the base by the rest in loops. Rotations are added like vectors, and
    /// clearances are not looked at. Beside the shortest durations that `righting reach` finds with effort
    /// nearly free, the estimate is 1.0 (`slew_2dof`), 2.5 (`slew_4dof`), 4.2 (`slew_canadarm2_table`), 4.0
    /// (`slew75_4dof`) and 0.6 times (`slew_canadarm2`) as long: a plan's loops are better than those looked
    /// at, and a heavy arm on a light base turns it by angles that do not add up.
    pub fn duration_s(&self, axis: &Vector3<f64>, angle_rad: f64) -> Option<f64> {
        let axis = axis * angle_rad.signum();
        let angle_rad = angle_rad.abs();
        if angle_rad == 0.0 {
            return Some(0.0);
        }
        let round = self.about(&axis);
        let (swung_rad, swung_s) = match self.swing(&axis) {
            Some((rate_rad_s, longest_s)) if rate_rad_s > round => {
                let time_s = longest_s.min(angle_rad / rate_rad_s);
                (rate_rad_s * time_s, time_s)
            }
            _ => (0.0, 0.0),
        };
        let left_rad = angle_rad - swung_rad;
        match (left_rad > 1e-9 * angle_rad, round > 0.0) {
            (true, false) => None,
            (true, true) => Some(swung_s + left_rad / round + self.run_up_s),
            (false, _) => Some(swung_s + self.run_up_s),
        }
    }

    /// How fast a mixture of straight motions turns the base about a direction and about nothing else, rad/s,
    /// and how long it goes on, s. With shares x_k ≤ 1 in all, the joints stay within their limits.
    fn swing(&self, axis: &Vector3<f64>) -> Option<(f64, f64)> {
        let found = mixture(&self.swing_rates, axis)?;
        let time_s = |corner: &Vector3<f64>| {
            let of = self.swings.iter().find(|swing| swing.rate_rad_s() == *corner);
            of.map_or(f64::INFINITY, |swing| swing.time_s)
        };
        let a_second: f64 = found.shares.iter().map(|(corner, share)| share / time_s(corner)).sum();
        Some((found.rate_rad_s, 1.0 / a_second))
    }
}

/// What three rates come to.
struct Mixture {
    rate_rad_s: f64,
    /// Each with its share of the time.
    shares: [(Vector3<f64>, f64); 3],
}

/// How fast a mixture of motions turns the base about an axis and about nothing else, as far as rotations
/// add like vectors: where the axis leaves the convex hull of the motions' own rates.
fn mixture(hull: &Mesh, axis: &Vector3<f64>) -> Option<Mixture> {
    let leaving = |triangle: &[usize; 3]| {
        let corners = triangle.map(|i| hull.vertices[i]);
        let shares = Matrix3::from_columns(&corners).try_inverse()? * axis;
        let rate_rad_s = 1.0 / shares.sum();
        let is_crossed = shares.min() >= -1e-12 * shares.amax() && rate_rad_s > 0.0;
        let shared = [0, 1, 2].map(|i| (corners[i], shares[i] * rate_rad_s));
        is_crossed.then_some(Mixture { rate_rad_s, shares: shared })
    };
    let crossed = hull.triangles.iter().filter_map(leaving);
    crossed.max_by(|a, b| a.rate_rad_s.total_cmp(&b.rate_rad_s))
}
