//! How far a detumble can go.

use nalgebra::Matrix3;
use righting_scenario::collision::CollisionModel;
use righting_scenario::halton::Halton;
use righting_scenario::scenario::Scenario;
use righting_scenario::system_description::SystemDescription;
use righting_scenario::wheels::{Wheel, stored_at_start};

use crate::zonotope::Zonotope;

/// Arm postures looked at to begin with.
const SAMPLES: usize = 1024;
/// The best of them from which to climb.
const CLIMBS: usize = 4;
/// The climb ends when its step is below this part of a joint's range.
const FINEST: f64 = 1e-7;

/// The least angular rate that a base can have when its arm stands still where it may end, rad/s.
///
/// Momentum h₀ is conserved, and with the joints at rest h = Ĩ(q) ω, so
///
/// ```text
/// ‖ω‖ ≥ ‖h₀‖ / max_q λ_max(Ĩ(q)),
/// ```
///
/// the maximum over the postures within the joints' limits that keep their clearances, with the joints whose end is
/// given where that says. It is found
/// from evenly spread postures and the start by climbing from the best of them, the same way every time.
/// Wheels take as much of h₀ as they can store in the best direction. Whether the arm can get there, and in the
/// time there is, does not count: a bound may be out of reach.
pub fn rate_bound_rad_s(scenario: &Scenario) -> f64 {
    let initial = scenario.initial();
    let (failed, working): (Vec<Wheel>, Vec<Wheel>) =
        scenario.wheels().iter().partition(|wheel| wheel.failed);
    let in_store = initial.attitude.to_inertial(&stored_at_start(scenario.wheels()));
    let total = (initial.angular_momentum_n_m_s + in_store).norm();
    let most = match working.is_empty() {
        true => 0.0,
        false => Zonotope::momenta(&working).radii().max,
    };
    (total - most - stored_at_start(&failed).norm()).max(0.0) / largest_inertia_kg_m2(scenario)
}

/// max_q λ_max(Ĩ(q)) of [`rate_bound_rad_s`], kg m².
pub fn largest_inertia_kg_m2(scenario: &Scenario) -> f64 {
    let start = &scenario.initial().joint_angles_rad;
    Postures::at_the_end(scenario).highest(Some(start), largest_moment)
}

/// The smallest and the largest principal inertia of the whole system with its joints held, over the
/// postures within the joints' limits that keep their clearances, kg m².
///
/// A base that spins about the axis of the one at the same momentum as about that of the other does so
/// faster by their ratio: no detumble divides a rate by more.
pub fn inertia_range_kg_m2(system: &SystemDescription, collision: &CollisionModel) -> [f64; 2] {
    let smallest = |inertia: &Matrix3<f64>| -inertia.symmetric_eigenvalues().min();
    let postures = Postures { system, collision, given_rad: &vec![None; system.joint_count()] };
    [-postures.highest(None, smallest), postures.highest(None, largest_moment)]
}

/// Whether some posture looked at in which the arm may end leaves less than `rate_rad_s` with the arm at rest.
pub(crate) fn some_posture_is_slower(scenario: &Scenario, rate_rad_s: f64) -> bool {
    let postures = Postures::at_the_end(scenario);
    let needed = scenario.initial().angular_momentum_n_m_s.norm() / rate_rad_s;
    let is_slower = |unit: &Vec<f64>| {
        postures.measured(unit, largest_moment) > needed && postures.are_clear(unit)
    };
    Halton::new(scenario.system().joint_count()).take(SAMPLES).any(|unit| is_slower(&unit))
}

/// The postures of an arm, as points of the unit cube.
#[derive(Clone, Copy)]
struct Postures<'a> {
    system: &'a SystemDescription,
    collision: &'a CollisionModel,
    /// The coordinates that joints have in all of them, rad or m; none where a joint is free.
    given_rad: &'a [Option<f64>],
}

impl<'a> Postures<'a> {
    /// Those in which a maneuver may end.
    fn at_the_end(scenario: &'a Scenario) -> Self {
        Self {
            system: scenario.system(),
            collision: scenario.collision(),
            given_rad: scenario.end_angles_rad(),
        }
    }

    fn at(&self, unit: &[f64]) -> Vec<f64> {
        let free = self.system.joint_angles_at(unit).into_iter();
        free.zip(self.given_rad).map(|(free, given)| given.unwrap_or(free)).collect()
    }

    fn measured(&self, unit: &[f64], measure: impl Fn(&Matrix3<f64>) -> f64) -> f64 {
        measure(&self.system.model.locked_inertia(&self.at(unit)))
    }

    fn are_clear(&self, unit: &[f64]) -> bool {
        let posture = self.system.model.kinematics(&self.at(unit));
        let mut clearances = self.collision.clearances(&posture);
        clearances.all(|clearance| clearance.distance_m >= clearance.least_m)
    }

    /// The highest that a measure of Ĩ(q) gets over those that keep their clearances; where none is found that does,
    /// over all.
    fn highest(&self, start_rad: Option<&[f64]>, measure: impl Fn(&Matrix3<f64>) -> f64) -> f64 {
        let joints = self.system.joint_count();
        let height = |unit: &[f64]| self.measured(unit, &measure);
        let start = start_rad.map(|angles| unit_of(self.system, angles));
        let mut samples: Vec<(f64, Vec<f64>)> = Halton::new(joints)
            .take(SAMPLES)
            .chain(start)
            .map(|unit| (height(&unit), unit))
            .collect();
        samples.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let highest = |tops: Vec<(f64, Vec<f64>)>| {
            let highest = tops.into_iter().max_by(|(a, _), (b, _)| a.total_cmp(b));
            highest.expect("the climbs start from some sample")
        };
        let starts = samples.iter().take(CLIMBS).cloned();
        let axes = directions(joints, false);
        let (top, unit) = highest(starts.map(|start| climb(start, &axes, height)).collect());
        if self.are_clear(&unit) {
            return top;
        }
        let starts: Vec<_> =
            samples.into_iter().filter(|(_, unit)| self.are_clear(unit)).take(CLIMBS).collect();
        if starts.is_empty() {
            return top;
        }
        // Along the edge of what is clear, a step along one axis leads into a collision or downhill.
        let diagonals = directions(joints, true);
        let clear =
            |unit: &[f64]| if self.are_clear(unit) { height(unit) } else { f64::NEG_INFINITY };
        highest(starts.into_iter().map(|start| climb(start, &diagonals, clear)).collect()).0
    }
}

fn largest_moment(inertia: &Matrix3<f64>) -> f64 {
    inertia.symmetric_eigenvalues().max()
}

/// The point of the unit cube at which the joints have these angles, whole turns of a joint without limits
/// left out.
fn unit_of(system: &SystemDescription, angles_rad: &[f64]) -> Vec<f64> {
    let ranges = system.joint_limits.iter().zip(angles_rad);
    ranges
        .map(|(limits, angle)| {
            let (low, high) = limits.angle_range_rad();
            let is_limited = limits.angle_min_rad.is_finite() && limits.angle_max_rad.is_finite();
            match (high > low, is_limited) {
                (false, _) => 0.0,
                (true, true) => ((angle - low) / (high - low)).clamp(0.0, 1.0),
                (true, false) => ((angle - low) / (high - low)).rem_euclid(1.0),
            }
        })
        .collect()
}

/// Both ways along every axis, and along the diagonals of every two if asked for.
fn directions(dimensions: usize, with_diagonals: bool) -> Vec<Vec<(usize, f64)>> {
    let ways = [1.0, -1.0];
    let mut directions: Vec<Vec<(usize, f64)>> =
        (0..dimensions).flat_map(|axis| ways.map(|way| vec![(axis, way)])).collect();
    if with_diagonals {
        for a in 0..dimensions {
            for b in a + 1..dimensions {
                directions.extend(ways.iter().flat_map(|&x| ways.map(|y| vec![(a, x), (b, y)])));
            }
        }
    }
    directions
}

/// Compass search within the unit cube: steps in each direction while they go up, then shorter ones.
fn climb(
    (mut highest, mut unit): (f64, Vec<f64>),
    directions: &[Vec<(usize, f64)>],
    height: impl Fn(&[f64]) -> f64,
) -> (f64, Vec<f64>) {
    let mut step = 0.1;
    while step > FINEST {
        let before = highest;
        for direction in directions {
            let mut there = unit.clone();
            for &(axis, way) in direction {
                there[axis] = (there[axis] + way * step).clamp(0.0, 1.0);
            }
            let found = height(&there);
            if found > highest {
                (highest, unit) = (found, there);
            }
        }
        if highest <= before {
            step *= 0.5;
        }
    }
    (highest, unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_climb_follows_the_edge_of_what_is_clear() {
        // Highest at (1, 0.2), where x + y = 1.2 meets the side of the square.
        let height = |p: &[f64]| match p[0] + p[1] <= 1.2 {
            true => 2.0 * p[0] + p[1],
            false => f64::NEG_INFINITY,
        };
        let start = || (height(&[0.4, 0.5]), vec![0.4, 0.5]);
        let (along_axes, _) = climb(start(), &directions(2, false), height);
        let (highest, point) = climb(start(), &directions(2, true), height);
        assert!((highest - 2.2).abs() < 1e-5 && (point[0] - 1.0).abs() < 1e-5, "{point:?}");
        assert!(along_axes < highest, "{along_axes}");
    }
}
